#pragma once

#include "base/Error.h"

#include <QObject>
#include <QStringList>

#include <string>

namespace faintline {

class MainWindow;

/// What of a window can be looked at by itself, by name; and as a picture in a file that tells what it was made from.
class WindowViews : public QObject
{
    Q_OBJECT

public:
    explicit WindowViews(MainWindow &window); ///< whose child it is

    /// "window", "input", "output", "threshold", "events", "noise", "noisefit", "pd", "why", "compare", "sweep", "hand"; the states'
    /// "slice"; of a sonar's pings "map", "polar", "histories", "latency"; of sequential tests "sequential", "walk", "stopping",
    /// "posterior", "scan", "asn", "prior", "sectors".
    static const QStringList &names();
    /// Null where there is none of that name.
    QWidget *named(const QString &name) const;

    /// Asks where to, and saves it there.
    void exportPicture(const QString &name);
    /// As it is seen now, by the path's extension.
    void saveTo(const QString &name, const QString &path);

signals:
    void failed(const faintline::Error &error);

private:
    std::string withView(const QString &name, const std::string &provenance) const;

    MainWindow &m_window;
};

} // namespace faintline

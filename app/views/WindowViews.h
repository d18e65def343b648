#pragma once

#include "base/Error.h"

#include <QObject>
#include <QStringList>

#include <string>
#include <vector>

class QWidget;

namespace faintline {

class WindowParts;

/// Something of the window that can be looked at by itself: in a picture, in a lesson, on the sheets of keys and
/// equations.
struct WindowView {
    /// What it shows, where something else is open there is nothing to be seen in it.
    enum class Of { Recording, Pings, Scans, Survey };

    QString name;  ///< in `render`, lessons and sessions
    QString title; ///< in menus
    Of of;
    QWidget *(*widget)(const WindowParts &parts); ///< null: the whole window
};

/// The one table of views: menus, `render`, lessons and reports read it. A view is added by a line here.
const std::vector<WindowView> &windowViews();

/// A window's views by name; and as a picture in a file that tells what it was made from.
class WindowViews : public QObject
{
    Q_OBJECT

public:
    WindowViews(WindowParts &parts, QWidget *window); ///< child of the window

    /// Of all views.
    static const QStringList &names();
    /// Null where there is none of that name.
    QWidget *named(const QString &name) const;

    /// Asks where to, and saves it there.
    void exportPicture(const QString &name);
    /// As it is seen now, by the path's extension.
    void saveTo(const QString &name, const QString &path);

signals:
    void written(const QString &path);
    void failed(const faintline::Error &error);

private:
    std::string withView(const QString &name, const std::string &provenance) const;

    WindowParts &m_parts;
    QWidget *m_window;
};

} // namespace faintline

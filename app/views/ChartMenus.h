#pragma once

#include "base/Error.h"

#include <QObject>

#include <functional>
#include <string>

class QMenu;

namespace faintline {

class ChartPlot;
class ExceedancePlot;
class StripPlot;
class WindowParts;

/// Context menu of every chart and table of a window: *Save chart…* as SVG, PDF or PNG, in light colours with a caption
/// of the settings, or its numbers as CSV.
class ChartMenus : public QObject
{
    Q_OBJECT

public:
    /// Call after the window has created all its charts; charts with a menu of their own keep it.
    ChartMenus(WindowParts &parts, QWidget *window);

    /// The extension selects the format.
    void saveTo(QWidget &chart, const QString &path);

signals:
    void written(const QString &path);
    void failed(const faintline::Error &error);

private:
    void ask(QWidget &chart);
    QString captionFor(const QWidget &chart) const;

    WindowParts &m_parts;
    QWidget *m_window;
};

} // namespace faintline

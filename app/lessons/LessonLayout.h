#pragma once

#include <QList>

class QDockWidget;
class QMainWindow;
class QWidget;

namespace faintline {

class LessonPanel;
class WindowParts;

/// Where a lesson and the panels of its steps stand in the window. In a presentation only the panels that the step
/// needs are visible, and their sizes are chosen for an audience; its end restores the layout.
class LessonLayout
{
public:
    LessonLayout(QMainWindow &window, WindowParts &parts, LessonPanel &panel);

    QDockWidget *dock() const { return m_dock; } ///< of the lesson's panel
    bool isPresenting() const { return m_isPresenting; }
    void setPresenting(bool isPresenting);
    /// The forms of experiments, beside their charts.
    void setFormsVisible(bool isVisible);

    /// Shows the lesson's panel: at the left; at the right of a panel that has the place of the pictures, as of
    /// scans, in its area, since without pictures Qt gives a column of its own the room that the panel needs.
    void showDock(bool isOfScans);
    /// Raises a widget among its tabs.
    static void reveal(QWidget *widget);
    /// Reveals the parts that a step needs, the one to which it points in front of the `others`. `isForInput`: something
    /// is to be entered.
    void pointOut(QWidget *target, const QList<QWidget *> &others, bool isForInput);
    /// Chooses sizes again, once the panels have theirs.
    void fit(QWidget *target);

private:
    void shareColumn();
    void widenChart(QWidget *target);
    void putAway(const QWidget *target, const QList<QWidget *> &others);
    void takeOneColumn();

    QMainWindow &m_window;
    WindowParts &m_parts;
    LessonPanel &m_panel;
    QDockWidget *m_dock;
    bool m_isPresenting = false;
    bool m_isAlone = false; ///< beside a panel that has the place of the pictures
};

} // namespace faintline

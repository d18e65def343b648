#pragma once

#include "app/lessons/Lesson.h"

#include <QObject>
#include <QTimer>

class QDockWidget;
class QMainWindow;
class QWidget;

namespace faintline {

class LessonPanel;
class WindowParts;
class PointerFrame;

/// Leads through a lesson: opens what a step needs, sets its settings as one undoable step, brings its views to the
/// front, frames what is spoken of, and watches until the learner has done the task. It acts through what a user could
/// do as well.
///
/// Every step begins with the settings the lesson has up to it, whatever the learner tried before; so what it says is
/// true.
class LessonGuide : public QObject
{
    Q_OBJECT

public:
    LessonGuide(QMainWindow &window, WindowParts &parts); ///< child of the window

    void start(const Lesson &lesson, int step = 0);
    bool isRunning() const { return m_step >= 0; }
    bool isReady() const { return m_isReady; } ///< the window shows what the step is about
    int step() const { return m_step; }
    const Lesson &lesson() const { return m_lesson; }
    LessonPanel &panel() { return *m_panel; }
    QDockWidget *dock() { return m_dock; }
    PointerFrame &frame() { return *m_frame; }

    /// The widget that a lesson means by a name; null if there is none.
    QWidget *widgetNamed(const QString &name);

public slots:
    void goTo(int step);
    void present(bool isPresenting);
    void leave();
    void check(); ///< whether the task is done

signals:
    void ready(); ///< the step is set up
    void finished();
    void runningChanged(bool isRunning);

private:
    const LessonStep &now() const { return m_lesson.steps[std::size_t(m_step)]; }
    int openingStep() const; ///< the one whose recording is looked at
    std::vector<LessonStep> stepsNow() const;
    void set();
    void setScans(const QString &path);
    void arrange();
    void showPanel();
    void reveal(QWidget *widget);
    bool isBusy() const;

    QMainWindow &m_window;
    WindowParts &m_parts;
    Lesson m_lesson;
    int m_step = -1;
    QString m_opened; ///< by this lesson, and still open
    bool m_isReady = false;
    bool m_isRevealed = false; ///< what is spoken of; it finds its place before it is framed
    QDockWidget *m_dock;
    LessonPanel *m_panel;
    PointerFrame *m_frame;
    QTimer m_watch;
};

} // namespace faintline

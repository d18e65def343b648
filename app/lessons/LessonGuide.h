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

/// Guides through a lesson: opens the source of a step, sets its settings as one undoable step, brings its views to the
/// front, highlights the relevant part, and watches until the learner has completed the task. It uses only actions that
/// are available to the user.
///
/// Each step begins with the lesson's settings up to it, regardless of the learner's changes, so that its text applies.
class LessonGuide : public QObject
{
    Q_OBJECT

public:
    LessonGuide(QMainWindow &window, WindowParts &parts); ///< child of the window

    void start(const Lesson &lesson, int step = 0);
    bool isRunning() const { return m_step >= 0; }
    bool isReady() const { return m_isReady; } ///< the window shows the state of the step
    int step() const { return m_step; }
    const Lesson &lesson() const { return m_lesson; }
    LessonPanel &panel() { return *m_panel; }
    QDockWidget *dock() { return m_dock; }
    PointerFrame &frame() { return *m_frame; }

    /// The widget with a name used in lessons; null if there is none.
    QWidget *widgetNamed(const QString &name);

public slots:
    void goTo(int step);
    void present(bool isPresenting);
    void leave();
    void check(); ///< checks whether the task is done

signals:
    void ready(); ///< the step is set up
    void finished();
    void runningChanged(bool isRunning);

private:
    const LessonStep &now() const { return m_lesson.steps[std::size_t(m_step)]; }
    int openingStep() const; ///< the step that opened the current recording
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
    QString m_opened; ///< opened by this lesson, and still open
    bool m_isReady = false;
    bool m_isRevealed = false; ///< whether the highlighted widget was revealed before it is framed
    QDockWidget *m_dock;
    LessonPanel *m_panel;
    PointerFrame *m_frame;
    QTimer m_watch;
};

} // namespace faintline

#pragma once

#include "app/lessons/LessonAnswers.h"
#include "app/lessons/LessonLayout.h"
#include "base/Error.h"

#include <QMap>
#include <QObject>
#include <QTimer>

namespace faintline {

class PointerFrame;

/// Guides through a lesson: opens the source of a step, sets its settings as one undoable step, brings its views to the
/// front, highlights the relevant part, and watches until the learner has completed the task. It uses only actions that
/// are available to the user.
///
/// After the last step a page tells what was answered and done, saves it for a teacher, and leads to the next lesson.
///
/// Each step begins with the lesson's settings up to it, regardless of the learner's changes, so that its text applies.
class LessonGuide : public QObject
{
    Q_OBJECT

public:
    LessonGuide(QMainWindow &window, WindowParts &parts); ///< child of the window

    void start(const Lesson &lesson, int step = 0);
    bool isRunning() const { return m_step >= 0; }
    int step() const { return m_step; }
    const Lesson &lesson() const { return m_lesson; }
    /// Writes them as an HTML page. Throws Error.
    void writeAnswers(const QString &path, const QString &learner) const;
    LessonPanel &panel() { return *m_panel; }
    QDockWidget *dock() const { return m_layout.dock(); }
    PointerFrame &frame() { return *m_frame; }

    /// The widget with a name used in lessons; null if there is none.
    QWidget *widgetNamed(const QString &name);

public slots:
    void goTo(int step);
    void present(bool isPresenting);
    void leave();
    void check(); ///< checks whether the task is done

signals:
    void ready();                       ///< the step is set up
    void finished(const QString &path); ///< of the lesson
    void lessonRequested(int lesson);   ///< the next one: its number in `lessons()`
    void written(const QString &path);  ///< the answers
    void failed(const faintline::Error &error);
    void runningChanged(bool isRunning);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    const LessonStep &now() const { return m_lesson.steps[std::size_t(m_step)]; }
    AnalysisSettings settingsAtOpening() const;
    bool isOpen(const QString &path) const;
    void set();
    void end();
    void goOn();
    std::optional<int> following() const;
    void saveAnswers(const QString &learner);
    void recordTask();
    void setScans(const QString &path);
    void showExperiment();
    void arrange();
    void giveKeys();
    void keepInSight();
    QWidget *pointOut();
    bool isBusy() const;

    QMainWindow &m_window;
    WindowParts &m_parts;
    Lesson m_lesson;
    LessonAnswers m_answers;
    int m_step = -1;
    bool m_isAtEnd = false;
    QString m_opened;                 ///< opened by this lesson, and still open
    QMap<QString, int> m_experiments; ///< started by this lesson: ids by path
    bool m_isReady = false;
    bool m_isRevealed = false; ///< whether the highlighted widget was revealed before it is framed
    LessonPanel *m_panel;
    LessonLayout m_layout;
    PointerFrame *m_frame;
    QTimer m_watch;
};

} // namespace faintline

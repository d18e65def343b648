#pragma once

#include "app/lessons/LessonAnswers.h"

#include <QWidget>

#include <vector>

class QAbstractButton;
class QButtonGroup;
class QLabel;
class QKeyEvent;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QScrollArea;
class QVBoxLayout;

namespace faintline {

/// The page of a lesson: text, question with choices, task, and buttons for going back and on. It is independent of the
/// window.
///
/// The explanation of a question, and the text after a task, are shown only once the choice is made and the task is
/// done.
class LessonPanel : public QWidget
{
    Q_OBJECT

public:
    explicit LessonPanel(QWidget *parent = nullptr);

    void setStep(const Lesson &lesson, int step);
    /// The page after the last step. `next`: title of the lesson that follows; empty: none.
    void setEnd(const Lesson &lesson, const LessonAnswers &answers, const QString &next);
    void setDone(bool isDone);       ///< the task
    void setWaiting(bool isWaiting); ///< while the window is not ready
    /// Large text, for presentations.
    void setLarge(bool isLarge);

    int step() const { return m_step; }
    int choice() const; ///< -1: none yet
    bool isDone() const { return m_isDone; }
    QString text() const; ///< all visible text, for tests and screen readers

    QPushButton *next() const { return m_next; }
    QPushButton *leave() const { return m_leave; }
    /// Chooses the answer of a number key; whether there is one.
    bool chooseByKey(const QKeyEvent &key);
    /// Height in which a presented step is seen whole, in the smallest text of presentations.
    int presentedHeight();
    void takeKeys();                                 ///< the keyboard's focus
    QLineEdit *learner() const { return m_learner; } ///< at the end; null before

    QSize sizeHint() const override { return {310, 420}; }

signals:
    void backRequested();
    void nextRequested();
    void leaveRequested();
    void answered(int choice);
    void saveRequested(const QString &learner); ///< of the answers

protected:
    void changeEvent(QEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void fill();
    void fillQuestion(const LessonQuestion &question, QVBoxLayout &column);
    void fillEnd();
    QVBoxLayout *newPage();
    void showPage(QVBoxLayout &column);
    int pageHeight(int textSize, int width);
    void fitText();
    void keepLatestInSight();
    void fillHead();
    void showAnswer(int choice);
    void showState();
    QString choiceText(int i) const;
    QLabel *paragraph(const QString &text, bool isBold = false);
    QFont font(bool isBold) const;

    Lesson m_lesson;
    int m_step = -1;
    bool m_isDone = false;
    bool m_isWaiting = false;
    bool m_isLarge = false;
    int m_textSize; ///< px
    bool m_isAtEnd = false;
    LessonAnswers m_answers;
    QString m_following;   ///< title of the next lesson
    QString m_learnerName; ///< kept from lesson to lesson

    QLabel *m_title;
    QLabel *m_place;
    QProgressBar *m_progress;
    QScrollArea *m_area;
    QPushButton *m_back;
    QPushButton *m_next;
    QPushButton *m_leave;
    QButtonGroup *m_choices = nullptr; ///< for the current step; null without a question
    std::vector<QLabel *> m_words;     ///< of the choices
    QLabel *m_why = nullptr;
    QLabel *m_task = nullptr;
    QLabel *m_then = nullptr;
    QLineEdit *m_learner = nullptr;
    QPushButton *m_save = nullptr;
};

} // namespace faintline

// What is asked before unsaved work is lost, and what happens after each answer.

#include "app/base/filePath.h"
#include "app/lessons/LessonGuide.h"
#include "app/openWindow.h"
#include "exchange/Session.h"
#include "support/test.h"

#include <QAbstractButton>
#include <QApplication>
#include <QMessageBox>

using namespace faintline;
using namespace faintline::test;

class tst_unsaved : public WindowTest
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        const QByteArray scene = R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 20, "lines": []})";
        m_scene = writeFile(m_folder, "scene.json", scene);
        m_other = writeFile(m_folder, "other.json", scene);
        const QByteArray lesson = R"({"title": "t", "sentence": "s", "steps": [
        {"title": "one", "text": "x", "open": "%1", "settings": {"decide.falseAlarmsPerHour": 5}},
        {"title": "two", "text": "x", "settings": {"decide.falseAlarmsPerHour": 7}}]})";
        m_lesson = writeFile(m_folder, "lesson.json", QByteArray(lesson).replace("%1", "other.json"));
        m_second = writeFile(m_folder, "second.json", QByteArray(lesson).replace("%1", "scene.json"));
    }

    void init()
    {
        m_window = newWindow();
        m_window->setAsking(true);
        m_questions = 0;
        QVERIFY(openAndSettle(*m_window, m_scene));
    }

    void aLessonBeginsAfterDiscard()
    {
        m_window->controller().edit("decide.falseAlarmsPerHour", 3.0, "edit");
        QVERIFY(settle(*m_window));
        answer(QMessageBox::Discard);
        m_window->open(m_lesson);
        QVERIFY(waitForLesson());
        QCOMPARE(m_questions, 1);
        QVERIFY2(m_isSaveOffered, "something would be lost");
        QVERIFY(m_window->lessonGuide().isRunning());
        QCOMPARE(recording(), QStringLiteral("other.json"));
        QCOMPARE(m_window->document().settings().decide.falseAlarmsPerHour, 5.0);
    }

    void aLessonThatRunsStaysUntilTheAnswer()
    {
        m_window->open(m_lesson);
        QVERIFY(waitForLesson());
        QCOMPARE(m_questions, 0);
        m_window->controller().edit("decide.falseAlarmsPerHour", 3.0, "edit");
        QVERIFY(settle(*m_window));
        answer(QMessageBox::Cancel);
        m_window->open(m_second);
        QTest::qWait(400); // longer than it looks around
        QCOMPARE(m_questions, 1);
        QVERIFY(m_window->lessonGuide().isRunning());
        QCOMPARE(recording(), QStringLiteral("other.json"));
        answer(QMessageBox::Discard);
        m_window->open(m_second);
        QVERIFY(waitForLesson());
        QCOMPARE(m_questions, 2);
        QCOMPARE(recording(), QStringLiteral("scene.json"));
        QVERIFY(m_window->lessonGuide().isRunning());
    }

    void aLessonsSettingsAreNothingToSave()
    {
        m_window->open(m_lesson);
        QVERIFY(waitForLesson());
        QVERIFY(!m_window->document().isModified());
        m_window->lessonGuide().goTo(1);
        QVERIFY(waitForLesson());
        QCOMPARE(m_window->document().settings().decide.falseAlarmsPerHour, 7.0);
        QVERIFY(!m_window->document().isModified());
        answer(QMessageBox::Cancel);
        QVERIFY(openAndSettle(*m_window, m_scene));
        QCOMPARE(m_questions, 0);
        QCOMPARE(recording(), QStringLiteral("scene.json"));
    }

    void anothersChangesInALessonAre()
    {
        m_window->open(m_lesson);
        QVERIFY(waitForLesson());
        m_window->controller().edit("decide.falseAlarmsPerHour", 3.0, "edit");
        QVERIFY(settle(*m_window));
        m_window->lessonGuide().goTo(1);
        QVERIFY(waitForLesson());
        QVERIFY(m_window->document().isModified());
    }

    void savedFirst()
    {
        const QString session = m_folder.filePath("kept.faintline");
        m_window->document().setSaved(session); // where to save it is known
        m_window->controller().edit("decide.falseAlarmsPerHour", 3.0, "edit");
        QVERIFY(settle(*m_window));
        answer(QMessageBox::Save);
        m_window->open(m_lesson);
        QVERIFY(waitForLesson());
        QCOMPARE(m_questions, 1);
        QCOMPARE(readSession(pathBytes(session)).settings.decide.falseAlarmsPerHour, 3.0);
        QCOMPARE(recording(), QStringLiteral("other.json"));
        QVERIFY(m_window->lessonGuide().isRunning());
    }

    void closingAsks()
    {
        m_window->document().setSaved(m_folder.filePath("closed.faintline"));
        m_window->controller().edit("decide.falseAlarmsPerHour", 3.0, "edit");
        QVERIFY(settle(*m_window));
        answer(QMessageBox::Cancel);
        QVERIFY(!m_window->close());
        QVERIFY(m_window->isVisible());
        answer(QMessageBox::Save);
        m_window->close();
        QTRY_VERIFY(!m_window->isVisible());
        QCOMPARE(m_questions, 2);
        QCOMPARE(readSession(pathBytes(m_folder.filePath("closed.faintline"))).settings.decide.falseAlarmsPerHour, 3.0);
    }

private:
    /// Answers the next question; how often one was asked is counted.
    void answer(QMessageBox::StandardButton button)
    {
        QTimer::singleShot(0, this, [this, button] {
            auto *question = qobject_cast<QMessageBox *>(QApplication::activeModalWidget());
            if (!question)
                return;
            ++m_questions;
            m_words = question->text();
            m_isSaveOffered = question->button(QMessageBox::Save) != nullptr;
            question->button(button)->click();
        });
    }
    bool waitForLesson()
    {
        QSignalSpy ready(&m_window->lessonGuide(), &LessonGuide::ready);
        return ready.wait(patience);
    }
    QString recording() const { return m_window->document().sourceName(); }

    QString m_scene, m_other, m_lesson, m_second;
    int m_questions = 0;
    QString m_words;
    bool m_isSaveOffered = false;
};

FAINTLINE_WINDOW_TEST(tst_unsaved)
#include "tst_unsaved.moc"

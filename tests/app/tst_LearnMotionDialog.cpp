#include "app/features/settings/LearnMotionDialog.h"
#include "app/openWindow.h"
#include "support/test.h"

#include <QAction>
#include <QLabel>
#include <QPushButton>

using namespace faintline;
using namespace faintline::test;

/// "Learn motion from tracks": the law beside the present one, applied only if asked, one undoable step.
class tst_LearnMotionDialog : public QObject
{
    Q_OBJECT

private slots:
    void isShownAndApplied()
    {
        const auto window = newWindow();
        const QString scene = writeFile(m_folder, "line.json", R"({"sampleRateHz": 400, "durationSeconds": 120,
            "lines": [{"snrDb": 10, "frequencyHz": 80, "driftHzPerSecond": 0.1}]})");
        QVERIFY(openAndSettle(*window, scene,
                              [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.25; }));
        LearnMotionDialog *dialog = learned(*window);
        QVERIFY(dialog);
        const QString words = dialog->findChild<QLabel *>("learnedMotion")->text();
        QVERIFY2(words.contains("From 1 track") && words.contains("h(0) = 0.900")
                     && words.contains("for one of 100 frames"),
                 qPrintable(words));
        const AnalysisSettings before = window->document().settings();
        dialog->findChild<QPushButton *>("applyLearnedMotion")->click();
        QVERIFY(settle(*window));
        QVERIFY(window->document().settings().model.slopeChange.front() > before.model.slopeChange.front());
        QVERIFY(window->document().isCurrent());
        window->document().undoStack().undo();
        QVERIFY(settle(*window));
        QVERIFY(window->document().settings() == before);
    }

    void saysWhereThereIsNothing()
    {
        const auto window = newWindow();
        const QString scene = writeFile(m_folder, "noise.json",
                                        R"({"sampleRateHz": 200, "durationSeconds": 60, "noise": {"deviation": 1}})");
        QVERIFY(openAndSettle(*window, scene));
        LearnMotionDialog *dialog = learned(*window);
        QVERIFY(dialog);
        QVERIFY(dialog->findChild<QLabel *>("learnedMotion")->text().contains("no such track was found"));
        QVERIFY(!dialog->findChild<QPushButton *>("applyLearnedMotion")->isEnabled());
    }

private:
    static LearnMotionDialog *learned(MainWindow &window)
    {
        for (QAction *action : window.findChildren<QAction *>())
            if (action->text().startsWith("Learn &motion"))
                action->trigger();
        auto *dialog = window.findChild<LearnMotionDialog *>();
        return dialog && settle(*dialog) ? dialog : nullptr;
    }

    QTemporaryDir m_folder;
};

FAINTLINE_WINDOW_TEST(tst_LearnMotionDialog)
#include "tst_LearnMotionDialog.moc"

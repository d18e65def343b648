// Unsaved work survives: kept while it is unsaved, found again after the program was killed.

#include "app/base/MessageBar.h"
#include "app/base/filePath.h"
#include "app/document/Recovery.h"
#include "app/openWindow.h"
#include "app/window/Opener.h"
#include "exchange/Session.h"
#include "support/test.h"

#include <QApplication>
#include <QToolButton>

#include <cstdio>
#include <memory>

using namespace faintline;
using namespace faintline::test;

namespace {

QString writeScene(const QTemporaryDir &folder)
{
    return writeFile(folder, "scene.json",
                     R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 20, "lines": []})");
}

std::unique_ptr<MainWindow> openedWindow(const QString &scenePath, const QString &recoveryFolder)
{
    auto window = newWindow({1440, 900}, nullptr, recoveryFolder);
    openAndSettle(*window, scenePath);
    return window;
}

/// The program that is killed: it edits, tells that its work is kept, and waits for its end.
int beKilled(const QString &scenePath, const QString &recoveryFolder)
{
    const auto window = openedWindow(scenePath, recoveryFolder);
    QSignalSpy kept(&window->recovery(), &Recovery::kept);
    window->controller().edit("decide.falseAlarmsPerHour", 7.0, "false alarms");
    kept.wait(patience);
    // Unsaved already: what comes on top is kept as well.
    window->document().annotate({{}, {{1.0, 2.0, 10.0, 20.0, "drawn before the end", "", Verdict::None}}}, "annotate");
    kept.wait(patience);
    std::puts("kept");
    std::fflush(stdout);
    return QApplication::exec();
}

/// One edit after the other, each told of as soon as it is kept.
int editUntilKilled(const QString &scenePath, const QString &recoveryFolder)
{
    const auto window = openedWindow(scenePath, recoveryFolder);
    QSignalSpy kept(&window->recovery(), &Recovery::kept);
    for (int version = 2;; ++version) { // 1 is the default
        window->controller().edit("decide.falseAlarmsPerHour", double(version), "false alarms");
        do {
            if (!kept.wait(patience))
                return 1;
        } while (readSession(pathBytes(kept.last()[0].toString())).settings.decide.falseAlarmsPerHour != version);
        std::printf("%d\n", version);
        std::fflush(stdout);
    }
}

} // namespace

class tst_Recovery : public QObject
{
    Q_OBJECT

private slots:
    void keptAsLongAsItIsUnsaved();
    void survivesAKill();
    void editsSurviveKillsAtAnyMoment();
    void withoutAFolderNothingIsKept();
};

void tst_Recovery::keptAsLongAsItIsUnsaved()
{
    QTemporaryDir folder;
    const auto window = openedWindow(writeScene(folder), folder.filePath("recovery"));
    QSignalSpy kept(&window->recovery(), &Recovery::kept);
    window->controller().edit("model.snr", 0.7, "SNR");
    QVERIFY(kept.wait(patience));
    const QString session = kept[0][0].toString();
    QCOMPARE(readSession(pathBytes(session)).settings, window->document().settings());
    QVERIFY2(Recovery::leftBehind(folder.filePath("recovery")).isEmpty(), "of a program that still runs");
    window->document().undoStack().undo();
    QVERIFY(!QFile::exists(session));
}

void tst_Recovery::survivesAKill()
{
    QTemporaryDir folder;
    const QString scenePath = writeScene(folder);
    const QString recovery = folder.filePath("recovery");
    QProcess program;
    program.start(QCoreApplication::applicationFilePath(), {"tst_Recovery", "--be-killed", scenePath, recovery});
    QVERIFY(program.waitForReadyRead(patience));
    QCOMPARE(program.readLine().trimmed(), QByteArray("kept"));
    QVERIFY(Recovery::leftBehind(recovery).isEmpty());
    program.kill();
    QVERIFY(program.waitForFinished(patience));

    QCOMPARE(Recovery::leftBehind(recovery).size(), 1);
    MainWindow window(nullptr, recovery);
    window.setAsking(false);
    window.show();
    window.opener().offerRecovery(recovery);
    QVERIFY(window.messages().text().contains("Unsaved work"));
    QSignalSpy settled(&window.controller(), &AnalysisController::settled);
    QSignalSpy kept(&window.recovery(), &Recovery::kept);
    for (QToolButton *button : window.messages().findChildren<QToolButton *>())
        if (button->text() == "Restore")
            button->click();
    QVERIFY(settled.wait(patience));
    QCOMPARE(window.document().settings().decide.falseAlarmsPerHour, 7.0);
    QCOMPARE(window.document().annotations().boxes.size(), std::size_t(1));
    QCOMPARE(window.document().annotations().boxes.front().label, std::string("drawn before the end"));
    QVERIFY2(window.document().isModified(), "it is still unsaved");
    QVERIFY(window.document().sessionPath().isEmpty());
    QVERIFY(!kept.isEmpty() || kept.wait(patience));
    QVERIFY2(Recovery::leftBehind(recovery).isEmpty(), "it belongs to this program now");
}

void tst_Recovery::editsSurviveKillsAtAnyMoment()
{
    const int kills =
        qEnvironmentVariableIsSet("FAINTLINE_KILLS") ? qEnvironmentVariableIntValue("FAINTLINE_KILLS") : 2;
    QTemporaryDir folder;
    const QString scenePath = writeScene(folder);
    const QString recovery = folder.filePath("recovery");
    QRandomGenerator random(1);
    for (int kill = 0; kill < kills; ++kill) {
        QProcess program;
        program.start(QCoreApplication::applicationFilePath(),
                      {"tst_Recovery", "--edit-until-killed", scenePath, recovery});
        int version = 0;
        const auto listen = [&] {
            while (program.canReadLine())
                version = program.readLine().trimmed().toInt();
        };
        for (const int wanted = 2 + random.bounded(2); version < wanted; listen())
            QVERIFY(program.waitForReadyRead(patience));
        QTest::qSleep(random.bounded(1300)); // an edit is kept after a second
        program.kill();
        QVERIFY(program.waitForFinished(patience));
        listen();

        const QStringList left = Recovery::leftBehind(recovery);
        QCOMPARE(left.size(), 1);
        const double recovered = readSession(pathBytes(left.front())).settings.decide.falseAlarmsPerHour;
        QVERIFY2(recovered == version || recovered == version + 1, qPrintable(QString::number(recovered)));
        Recovery::discard(left.front());
    }
}

void tst_Recovery::withoutAFolderNothingIsKept()
{
    QTemporaryDir folder;
    const auto window = openedWindow(writeScene(folder), {});
    window->controller().edit("model.snr", 0.7, "SNR");
    QVERIFY(!isBusy(window->recovery()));
    QVERIFY(QDir(folder.path()).entryList({"*.faintline"}, QDir::Files).isEmpty());
}

static const faintline::test::Registration registered("tst_Recovery", [](int argc, char *argv[]) {
    QApplication application(argc, argv);
    Theme::apply(Theme::Kind::Light);
    if (argc == 4 && qstrcmp(argv[1], "--be-killed") == 0)
        return beKilled(QString::fromLocal8Bit(argv[2]), QString::fromLocal8Bit(argv[3]));
    if (argc == 4 && qstrcmp(argv[1], "--edit-until-killed") == 0)
        return editUntilKilled(QString::fromLocal8Bit(argv[2]), QString::fromLocal8Bit(argv[3]));
    tst_Recovery test;
    return QTest::qExec(&test, argc, argv);
});

#include "tst_Recovery.moc"

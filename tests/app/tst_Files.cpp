#include "app/base/MessageBar.h"
#include "app/base/distinctLabels.h"
#include "app/base/filePath.h"
#include "app/features/events/EventFiles.h"
#include "app/features/events/EventReviews.h"
#include "app/features/opening/recordingFiles.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "app/views/WindowViews.h"
#include "exchange/Session.h"
#include "scene/SimulatedRecording.h"
#include "signal/formats/writeRecording.h"
#include "support/recordings.h"
#include "support/test.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QDropEvent>
#include <QLineEdit>
#include <QMenu>
#include <QToolButton>

using namespace faintline;
using namespace faintline::test;

/// From file to file: what goes along, what does not, and how files of one name are told apart.
class tst_Files : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        LineScene scene;
        scene.sampleRateHz = 200.0;
        scene.durationSeconds = 30.0;
        QVERIFY(QDir(m_folder.path()).mkpath("site 2"));
        for (const char *name : {"night 2.wav", "night 10.wav", "site 2/night 2.wav"}) {
            writeRecording(SimulatedRecording(scene), path(name).toStdString());
            ++scene.seed;
        }
        writeFile(m_folder, "night 3.txt", "no recording");
    }

    void neighboursAreRecordingsInTheOrderOfTheirNumbers()
    {
        FileSequence files;
        QCOMPARE(files.neighbour(path("night 2.wav"), 1), path("night 10.wav"));
        QCOMPARE(files.neighbour(path("night 10.wav"), -1), path("night 2.wav"));
        QCOMPARE(files.neighbour(path("night 10.wav"), 1), QString());
        QCOMPARE(files.neighbour(":/scenarios/faint-line.json", 1), QString());
        files.setFiles({path("night 10.wav"), path("site 2/night 2.wav")});
        QCOMPARE(files.neighbour(path("night 10.wav"), 1), path("site 2/night 2.wav"));
        QCOMPARE(files.neighbour(path("night 2.wav"), 1), path("night 10.wav")); // none of the list: its folder
    }

    void openOffersRecordingsFirst()
    {
        QVERIFY(openFilter().startsWith("Recordings (*.wav "));
        QVERIFY(openFilter().endsWith("All files (*)"));
    }

    void namesAreToldApart()
    {
        QCOMPARE(distinctLabels({"/a/x/n.wav", "/a/y/n.wav", "/a/y/m.wav"}),
                 QStringList({"n.wav (x)", "n.wav (y)", "m.wav"}));
        QCOMPARE(distinctLabels({"/a/x/1/n.wav", "/a/y/1/n.wav"}), QStringList({"n.wav (x/1)", "n.wav (y/1)"}));
    }

    void settingsGoAlongFilterAndPartDoNot()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, path("night 2.wav"), [](AnalysisSettings &settings) {
            settings.spectrogram.windowSeconds = 0.5;
            settings.selection.fromSeconds = 10.0;
            settings.selection.highHz = 80.0;
        }));
        window->eventTable().filter()->setText("stat>5");
        window->workbench().selectEvent(3);
        QCOMPARE(window->workbench().output()->selectedEvent(), 3);
        bool isPlotEmpty = false;
        connect(&window->document(), &Document::opened, this,
                [&] { isPlotEmpty = !window->thresholdPlot().isAxisVisible(QwtAxis::XBottom); });
        QTest::keyClick(window.get(), Qt::Key_PageDown, Qt::ControlModifier);
        QVERIFY(settle(*window));
        QVERIFY(isPlotEmpty); // until the calibration of the new recording
        QVERIFY(window->thresholdPlot().isAxisVisible(QwtAxis::XBottom));
        QCOMPARE(window->document().sourcePath(), path("night 10.wav"));
        const AnalysisSettings &settings = window->document().settings();
        QCOMPARE(settings.spectrogram.windowSeconds, 0.5);
        QCOMPARE(settings.selection.highHz, 80.0);
        QCOMPARE(settings.selection.fromSeconds, 0.0);
        QCOMPARE(window->eventTable().filter()->text(), QString());
        QCOMPARE(window->workbench().output()->selectedEvent(), 0);
        QTest::keyClick(window.get(), Qt::Key_PageDown, Qt::ControlModifier);
        QVERIFY(window->messages().text().contains("This is the last recording of its folder."));
        QTest::keyClick(window.get(), Qt::Key_PageUp, Qt::ControlModifier);
        QVERIFY(settle(*window));
        QCOMPARE(window->document().sourcePath(), path("night 2.wav"));
    }

    void ofSeveralDroppedNoneIsLost()
    {
        const auto window = newWindow();
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(path("night 10.wav")), QUrl::fromLocalFile(path("site 2/night 2.wav"))});
        QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(window.get(), &enter);
        QDropEvent event(QPointF(50.0, 50.0), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(window.get(), &event);
        QVERIFY(settle(*window));
        QCOMPARE(window->document().sourcePath(), path("night 10.wav"));
        QTRY_VERIFY(window->messages().text().contains("2 files"));
        const auto buttons = window->messages().findChildren<QToolButton *>();
        QVERIFY(std::any_of(buttons.begin(), buttons.end(),
                            [](const QToolButton *button) { return button->text() == "Open as one recording"; }));
        QTest::keyClick(window.get(), Qt::Key_PageDown, Qt::ControlModifier);
        QVERIFY(settle(*window));
        QCOMPARE(window->document().sourcePath(), path("site 2/night 2.wav"));
    }

    void listsAreRelativeToTheirFolder()
    {
        const QStringList files{path("night 10.wav"), path("site 2/night 2.wav")};
        QCOMPARE(timelineText(files, path("a.timeline")), std::string("night 10.wav\nsite 2/night 2.wav\n"));
        QCOMPARE(timelineText(files, path("site 2/a.timeline")), std::string("../night 10.wav\nnight 2.wav\n"));
        QVERIFY(openFilter().contains("*.timeline"));
    }

    // A folder is one recording, and so it is in a session and in the window's tables.
    void foldersAreOneRecording()
    {
        QVERIFY(QDir(m_folder.path()).mkpath("site 3"));
        LineScene scene;
        scene.sampleRateHz = 200.0;
        scene.durationSeconds = 30.0;
        for (const char *name :
             {"site 3/20260101_000000.wav", "site 3/20260101_000030.wav", "site 3/20260101_000130.wav"})
            writeRecording(SimulatedRecording(scene), path(name).toStdString());
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, path("site 3")));
        QCOMPARE(window->document().recording()->info().sampleCount, Index(24000));
        QVERIFY(!window->document().recording()->isWhole(0, 24000));
        QCOMPARE(window->windowTitle(), QString("site 3[*] — Faintline"));
        writeSession(pathBytes(path("site 3.faintline")),
                     {window->document().source(), {}, window->document().settings()});
        const Session session = readSession(pathBytes(path("site 3.faintline")));
        QCOMPARE(recordingMismatch(session), std::string());
        writeRecording(SimulatedRecording(scene), path("site 3/20260101_000200.wav").toStdString());
        QVERIFY(!recordingMismatch(session).empty());
    }

    void titlesOfOneNameTellTheFolder()
    {
        const auto window =
            newWindow({1400, 900}, std::make_unique<QSettings>(path("memory.ini"), QSettings::IniFormat));
        QVERIFY(openAndSettle(*window, path("night 2.wav")));
        QCOMPARE(window->windowTitle(), QString("night 2.wav[*] — Faintline"));
        QVERIFY(openAndSettle(*window, path("site 2/night 2.wav")));
        QCOMPARE(window->windowTitle(), QString("night 2.wav (site 2)[*] — Faintline"));
        QStringList entries; // of the menu of recent files
        for (QMenu *menu : window->findChildren<QMenu *>()) {
            emit menu->aboutToShow();
            for (const QAction *action : menu->actions())
                if (action->text().startsWith("night 2.wav"))
                    entries << action->text();
        }
        QCOMPARE(entries, QStringList({"night 2.wav (site 2)",
                                       QString("night 2.wav (%1)").arg(QFileInfo(m_folder.path()).fileName())}));
    }

    void exportsReplaceNoInput()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, path("night 2.wav")));
        const QByteArray before = readBytes(path("night 2.wav").toStdString());
        QVERIFY(QFile::link(path("night 2.wav"), path("link.png")));
        QVERIFY(QFile::link(path("night 2.wav"), path("link.csv")));
        EventFiles &files = window->reviews().files();
        QVERIFY_THROWS_EXCEPTION(Error, files.exportTo(path("link.csv")));
        QVERIFY_THROWS_EXCEPTION(Error, files.exportTracksTo(path("link.csv")));
        window->views().saveTo("events", path("link.png"));
        QTRY_VERIFY2(window->messages().text().contains("is an input"), qPrintable(window->messages().text()));
        QCOMPARE(readBytes(path("night 2.wav").toStdString()), before);
        files.exportTo(path("own.csv")); // others are written
        QVERIFY(QFile::exists(path("own.csv")));
    }

    void exportsSayWhereTheyWrote()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, path("night 2.wav")));
        window->reviews().files().exportTo(path("out.csv"));
        QTRY_VERIFY2(window->messages().text().contains("out.csv"), qPrintable(window->messages().text()));
        window->messages().dismiss();
        window->views().saveTo("events", path("events.png"));
        QTRY_VERIFY2(window->messages().text().contains(path("events.png")), qPrintable(window->messages().text()));
    }

private:
    QString path(const char *name) const { return m_folder.filePath(QString::fromLatin1(name)); }

    QTemporaryDir m_folder;
};

FAINTLINE_WINDOW_TEST(tst_Files)
#include "tst_Files.moc"

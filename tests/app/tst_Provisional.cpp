#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "support/test.h"

#include <QLabel>
#include <QStatusBar>

#include <qwt_text.h>

using namespace faintline;
using namespace faintline::test;

/// What a changed detector makes of the visible part is seen before everything else is known.
class tst_Provisional : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;

    QString scene()
    {
        return writeFile(m_folder, "scene.json",
                         R"({"kind": "lines", "sampleRateHz": 400, "durationSeconds": 120, "lines": [{"snrDb": 5,
               "frequencyHz": 90}]})");
    }

private slots:
    /// What an earlier run of these tests calibrated is not known.
    void initTestCase() { qputenv("FAINTLINE_CACHE", m_folder.filePath("cache").toLocal8Bit()); }

    void seenAtOnceAndReplaced()
    {
        const auto own = newWindow({1200, 800});
        MainWindow &window = *own;
        QSignalSpy settled(&window.controller(), &AnalysisController::settled);
        window.open(scene(), {}, [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.5; });
        QVERIFY(settled.wait(patience));
        settled.clear();
        const auto before = window.document().analysis();
        window.document().viewport().zoomTo({30.0, 60.0}, {50.0, 150.0});

        // In the order in which they come: the preview, with the threshold and events there were, then the analysis.
        QStringList order;
        std::shared_ptr<const PeakPyramid> shown;
        QString title;
        connect(&window.document(), &Document::provisionalChanged, this, [&] {
            if (!window.document().provisional())
                return;
            order << "provisional";
            shown = window.document().provisional();
            title = window.workbench().output()->title().text();
            QCOMPARE(window.workbench().output()->picture(), shown);
            QCOMPARE(window.document().analysis(), before);
            QCOMPARE(window.document().shownThreshold(), before->threshold);
        });
        connect(&window.document(), &Document::analysisChanged, this, [&] { order << "analysis"; });
        window.controller().edit("model.snr", FieldValue(0.2718), "Change"); // never calibrated before
        QVERIFY(settled.wait(patience));
        QCOMPARE(order, (QStringList{"provisional", "analysis",
                                     "analysis"})); // a first estimate of the threshold, then the refined one
        QVERIFY(title.contains("provisional"));
        QVERIFY(shown->time().first >= 29.0 && shown->time().last() <= 61.0);
        QVERIFY(!window.document().provisional());
        QCOMPARE(window.workbench().output()->picture(), window.document().analysis()->statistic);
        QVERIFY(!window.workbench().output()->title().text().contains("provisional"));
        QVERIFY(window.document().isCurrent());
    }

    void aFirstEstimateIsSaidToBeOne()
    {
        const auto own = newWindow({1200, 800});
        MainWindow &window = *own;
        QSignalSpy settled(&window.controller(), &AnalysisController::settled);
        QSignalSpy refined(&window.controller(), &AnalysisController::refined);
        QStringList said;
        QList<double> thresholds;
        connect(&window.document(), &Document::shownEventsChanged, this, [&] {
            said << window.statusBar()->findChild<QLabel *>()->text();
            thresholds << window.document().analysis()->threshold;
        });
        window.open(scene(), {}, [](AnalysisSettings &settings) {
            settings.spectrogram.windowSeconds = 0.5;
            settings.model.snr = 0.3141; // never calibrated before
        });
        QVERIFY(settled.wait(patience));
        QCOMPARE(said.size(), 2);
        QVERIFY2(said[0].contains("first estimate") && said[0].contains("being refined"), qPrintable(said[0]));
        QCOMPARE(refined.size(), 1);
        QCOMPARE(refined.front().front().toDouble(), thresholds[0]);
        const QString last = window.statusBar()->findChild<QLabel *>()->text();
        QVERIFY2(last.contains("refined") && last.contains(QString::number(thresholds[0], 'f', 2)), qPrintable(last));
        QVERIFY(!window.document().analysis()->calibration->isFirstEstimate);

        // Known from now on.
        settled.clear();
        window.controller().run();
        QVERIFY(settled.wait(patience));
        QCOMPARE(said.size(), 3);
        QCOMPARE(refined.size(), 1);
    }

    void lookingFartherDropsIt()
    {
        MainWindow window;
        window.setAsking(false);
        window.show();
        QSignalSpy settled(&window.controller(), &AnalysisController::settled);
        window.open(scene(), {}, [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.5; });
        QVERIFY(settled.wait(patience));
        settled.clear();
        window.document().viewport().zoomTo({30.0, 60.0}, {50.0, 150.0});
        bool wasThere = false;
        connect(&window.document(), &Document::provisionalChanged, this, [&] {
            if (!window.document().provisional())
                return;
            wasThere = true;
            window.document().viewport().showAll();
            QVERIFY(!window.document().provisional());
            QCOMPARE(window.workbench().output()->picture(), window.document().analysis()->statistic);
        });
        window.controller().edit("model.snr", FieldValue(0.2718), "Change");
        QVERIFY(settled.wait(patience));
        QVERIFY(wasThere);
        QVERIFY(window.document().isCurrent());
    }

    void stoppedItGoesBack()
    {
        MainWindow window;
        window.setAsking(false);
        window.show();
        QSignalSpy settled(&window.controller(), &AnalysisController::settled);
        window.open(scene(), {}, [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.5; });
        QVERIFY(settled.wait(patience));
        settled.clear();
        connect(&window.document(), &Document::provisionalChanged, this, [&] {
            if (window.document().provisional())
                window.controller().stop();
        });
        window.controller().edit("model.snr", FieldValue(0.1618), "Change");
        QVERIFY(settled.wait(patience));
        QVERIFY(!window.document().provisional());
        QCOMPARE(window.workbench().output()->picture(), window.document().analysis()->statistic);
    }
};

FAINTLINE_WINDOW_TEST(tst_Provisional)
#include "tst_Provisional.moc"

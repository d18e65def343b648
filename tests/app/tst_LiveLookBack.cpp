// Looking back at a live run while it goes on.

#include "app/Feeder.h"
#include "app/features/inspect/WhyPanel.h"
#include "app/features/pictures/Workbench.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>
#include <csignal>

using namespace faintline;
using namespace faintline::test;

class tst_LiveLookBack : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { std::signal(SIGPIPE, SIG_IGN); }

    // 6800 frames of 8192 cells, of which the picture merges four: zoomed in on old ones they are single, as those of
    // the recording are in the end.
    void looksBackInDetail()
    {
        const QTemporaryDir folder;
        Feeder feeder(folder, someNoise(7'000'000));
        AnalysisSettings settings = liveSettings();
        settings.spectrogram.windowSeconds = 8.192;
        settings.spectrogram.stepsPerWindow = 8;
        settings.noise.blockWindows = 4.0;
        setSetting(settings, "detector.kind", "energy");
        setSetting(settings, "decide.thresholdNats", "1000");
        const auto window = listeningWindow(folder, feeder, settings);
        Document &document = window->document();
        const WaterfallView &input = *window->workbench().input();
        const WaterfallView &output = *window->workbench().output();
        feeder.allow(6900.0);
        QTRY_VERIFY_WITH_TIMEOUT(document.isLive() && document.live().time.last() > 6800.0, 5 * patience);
        QCOMPARE(input.picture()->framesPerRow(0), Index(4));
        const Span old{1000.0, 1080.0};
        const Span band = document.viewport().full().frequency;
        document.viewport().zoomTo(old, band);
        QVERIFY(!document.viewport().isFollowing());
        const auto areSingle = [&] {
            return input.shownPicture()->framesPerRow(0) == 1 && output.shownPicture()->framesPerRow(0) == 1;
        };
        QTRY_VERIFY_WITH_TIMEOUT(areSingle(), patience);
        feeder.allow(6950.0); // it stays while more comes in
        QTRY_VERIFY_WITH_TIMEOUT(document.live().time.last() > 6930.0, patience);
        QVERIFY(areSingle());
        const auto liveInput = input.shownPicture();
        const auto liveOutput = output.shownPicture();

        feeder.allowAll();
        QTRY_VERIFY_WITH_TIMEOUT(!document.isLive() && document.isCurrent() && settle(*window), 5 * patience);
        document.viewport().zoomTo(old, band);
        QTRY_VERIFY_WITH_TIMEOUT(areSingle(), patience);
        const auto haveSame = [&](const PeakPyramid &live, const PeakPyramid &file) {
            const Index shift = std::llround((old.low - live.time().first) / live.time().step);
            const Index fileShift = std::llround((old.low - file.time().first) / file.time().step);
            for (Index row = 0; row < 60; ++row)
                if (!std::ranges::equal(live.row(0, shift + row), file.row(0, fileShift + row)))
                    return false;
            return true;
        };
        QVERIFY(haveSame(*liveInput, *input.shownPicture()));
        QVERIFY(haveSame(*liveOutput, *output.shownPicture()));
    }

    // The terms add up to what the picture shows, while it goes on.
    void saysWhyMeanwhile()
    {
        const QTemporaryDir folder;
        Feeder feeder(folder, scene(150.0));
        const auto window = listeningWindow(folder, feeder, liveSettings());
        Document &document = window->document();
        feeder.allow(80.0);
        QTRY_VERIFY_WITH_TIMEOUT(document.isLive() && document.live().time.last() > 78.0, patience);
        window->showView("why");
        const auto *why = window->findChild<WhyPanel *>();
        document.viewport().setCursor({70.0, 290.0});
        QTRY_VERIFY_WITH_TIMEOUT(sentenceOf(*why).contains(QStringLiteral("add up to")), patience);
        QVERIFY2(sentenceOf(*why).startsWith(QStringLiteral("Followed by a track")), qPrintable(sentenceOf(*why)));
        feeder.allow(90.0);
        QTRY_VERIFY_WITH_TIMEOUT(document.live().time.last() > 88.0, patience);
        document.viewport().setCursor({86.0, 340.0}); // noise, and newer than what was looked at before
        QTRY_VERIFY_WITH_TIMEOUT(sentenceOf(*why).startsWith(QStringLiteral("Not detected")), patience);
        window->listening().run().stop();
        QTRY_VERIFY_WITH_TIMEOUT(!window->listening().run().isRunning(), patience);
    }
};

FAINTLINE_WINDOW_TEST(tst_LiveLookBack)
#include "tst_LiveLookBack.moc"

#include "refine/spreadTracks.h"
#include "support/test.h"

#include "analyse/analyse.h"
#include "scene/SimulatedRecording.h"
#include "support/lines.h"

using namespace faintline;

namespace {

constexpr double lineWindowSeconds = 0.25;

/// One line of 10 dB, for 50 s in 60 s of white noise.
Analysis withOneLine(const ModelSettings &law = {})
{
    LineScene scene = test::scene(1000.0, 60.0, 7);
    scene.lines = {test::line(200.0, 0.0, 5.0, 50.0, 10.0, lineWindowSeconds)};
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = lineWindowSeconds;
    settings.model = law;
    return *analyse(std::make_shared<SimulatedRecording>(scene), settings);
}

/// The same, as if the line's band were so many resolution cells wide and its power so many times the noise's.
Analysis withBand(Analysis analysis, double cells, float level)
{
    const double half = 0.5 * cells * analysis.frames->spectrogram()->binsPerCell();
    for (SmoothedPoint &point : analysis.tracks.at(0).smoothed)
        point = {point.position, float(point.position - half), float(point.position + half), 1.0f, level};
    return analysis;
}

bool isMoved(Analysis analysis)
{
    const std::size_t before = analysis.tracks.size();
    moveSpreadTracks(analysis);
    return analysis.tracks.size() < before && !analysis.areas.empty();
}

} // namespace

/// Paths through signals that are no lines.
class tst_spreadTracks : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        m_line = withOneLine();
        QCOMPARE(m_line.tracks.size(), std::size_t(1));
        QVERIFY(m_line.areas.empty());
    }

    void widthAndLevelDecide_data()
    {
        QTest::addColumn<double>("cells");
        QTest::addColumn<float>("level");
        QTest::addColumn<bool>("isSpread");
        QTest::newRow("a line") << 1.0 << 2.0f << false;
        QTest::newRow("a line that wanders") << 2.1 << 2.0f << false;
        QTest::newRow("spread") << 2.5 << 2.0f << true;
        QTest::newRow("fast and strong") << 2.5 << 4.5f << false;
        QTest::newRow("faint") << 2.5 << 0.5f << false; // up to 3.1 cells
        QTest::newRow("faint and spread") << 3.5 << 0.5f << true;
    }

    void widthAndLevelDecide()
    {
        QFETCH(double, cells);
        QFETCH(float, level);
        QFETCH(bool, isSpread);
        QCOMPARE(isMoved(withBand(m_line, cells, level)), isSpread);
    }

    void pausesDoNotCount()
    {
        Analysis keyed = withBand(m_line, 1.0, 2.0f);
        std::vector<SmoothedPoint> &points = keyed.tracks[0].smoothed;
        for (std::size_t i = 1; i < points.size(); i += 2)
            points[i] = {points[i].position, float(points[i].position - 20.0), float(points[i].position + 20.0), 0.1f,
                         2.0f};
        QVERIFY(!isMoved(keyed));
    }

    void whatMayBeNoiseStays()
    {
        Analysis faint = withBand(m_line, 3.0, 2.0f);
        faint.tracks[0].peakStatistic = faint.threshold + 3.0;
        QVERIFY(!isMoved(faint));
        faint.tracks[0].peakStatistic = faint.threshold + 3.6;
        QVERIFY(isMoved(faint));
    }

    void lawsWithoutInertiaKeepTheirs() { QVERIFY(!isMoved(withBand(withOneLine(laws::billon()), 3.0, 2.0f))); }

    void theAreaIsWhereTheTrackWas()
    {
        Analysis analysis = withBand(m_line, 3.0, 2.0f);
        const Track track = analysis.tracks[0];
        moveSpreadTracks(analysis);
        QVERIFY(analysis.tracks.empty());
        QCOMPARE(analysis.areas.front().firstFrame, track.onsetFrame);
        QCOMPARE(analysis.areas.back().lastFrame, track.endFrame);
        const double half = 1.5 * analysis.frames->spectrogram()->binsPerCell();
        for (const Area &area : analysis.areas) {
            QVERIFY(std::abs(area.level - 3.0) < 1e-6); // noise and signal
            for (std::size_t i = 0; i < track.points.size(); ++i) {
                const Index frame = track.points[i].frame;
                if (frame < area.firstFrame || frame > area.lastFrame)
                    continue;
                QVERIFY(double(area.firstCell) <= track.smoothed[i].position - half + 0.5);
                QVERIFY(double(area.lastCell) >= track.smoothed[i].position + half - 0.5);
            }
        }
    }

private:
    Analysis m_line;
};

FAINTLINE_TEST(tst_spreadTracks)
#include "tst_spreadTracks.moc"

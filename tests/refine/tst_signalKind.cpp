#include "refine/signalKind.h"
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
Analysis withBand(Analysis analysis, double bandCells, float level)
{
    const double half = 0.5 * bandCells * analysis.frames->spectrogram()->binsPerCell();
    for (SmoothedPoint &point : analysis.tracks.at(0).smoothed)
        point = {point.position, float(point.position - half), float(point.position + half), 1.0f, level};
    return analysis;
}

bool isSpread(const Analysis &analysis)
{
    return kindOf(analysis.tracks.at(0), analysis) == SignalKind::Spread;
}

} // namespace

/// Lines, keyed lines, and signals that are wider.
class tst_signalKind : public QObject
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
        QCOMPARE(::isSpread(withBand(m_line, cells, level)), isSpread);
    }

    void pausesDoNotCountInTheWidth()
    {
        Analysis keyed = withBand(m_line, 1.0, 2.0f);
        std::vector<SmoothedPoint> &points = keyed.tracks[0].smoothed;
        for (std::size_t i = 1; i < points.size(); i += 2)
            points[i] = {points[i].position, float(points[i].position - 20.0), float(points[i].position + 20.0), 0.1f,
                         2.0f};
        QCOMPARE(kindOf(keyed.tracks[0], keyed), SignalKind::Keyed);
    }

    void aKeyedLineHasTwoPausesOrMore()
    {
        Analysis analysis = m_line;
        std::vector<SmoothedPoint> &points = analysis.tracks.at(0).smoothed;
        for (SmoothedPoint &point : points)
            point.presence = 1.0f;
        const auto kindWithout = [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i <= last; ++i)
                points[i].presence = 0.1f;
            return nameOf(kindOf(analysis.tracks[0], analysis));
        };
        QCOMPARE(kindWithout(0, 1), "line"); // an end is no pause
        QCOMPARE(kindWithout(50, 70), "line");
        QCOMPARE(kindWithout(90, 92), "keyed");
    }

    void simulatedKeyingIsTold()
    {
        LineScene scene = test::scene(1000.0, 60.0, 7);
        for (const double start : {4.0, 15.0, 26.0, 37.0}) // pauses of 1 s
            scene.lines.push_back(test::line(200.0, 0.0, start, 10.0, 12.0, lineWindowSeconds));
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = lineWindowSeconds;
        const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene), settings);
        QCOMPARE(analysis->tracks.size(), std::size_t(1));
        QCOMPARE(nameOf(kindOf(analysis->tracks[0], *analysis)), "keyed");
        QCOMPARE(nameOf(kindOf(m_line.tracks[0], m_line)), "line");
    }

    void whatMayBeNoiseIsALine()
    {
        Analysis faint = withBand(m_line, 3.0, 2.0f);
        faint.tracks[0].peakStatistic = faint.threshold + 3.0;
        QVERIFY(!isSpread(faint));
        faint.tracks[0].peakStatistic = faint.threshold + 3.6;
        QVERIFY(isSpread(faint));
    }

    void linesOfLawsWithoutInertiaAreNotSpread() { QVERIFY(!isSpread(withBand(withOneLine(laws::billon()), 3.0, 2.0f))); }

    void withoutTheSecondPassItIsNotKnown()
    {
        Analysis analysis = m_line;
        analysis.tracks[0].smoothed.clear();
        QCOMPARE(nameOf(kindOf(analysis.tracks[0], analysis)), "");
    }

private:
    Analysis m_line;
};

FAINTLINE_TEST(tst_signalKind)
#include "tst_signalKind.moc"

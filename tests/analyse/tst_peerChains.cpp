#include "analyse/events.h"
#include "base/Random.h"
#include "calibrate/calibrate.h"
#include "plan/Analysis.h"
#include "plan/chain.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

namespace {

constexpr Index cellCount = 200;

Grid grid()
{
    return {{{"frequency", "Hz", 0.0, 1.0, cellCount, false}}};
}

AnalysisSettings settingsOf(std::size_t kind)
{
    AnalysisSettings settings;
    settings.detector = detectorOfKind(kind);
    if (auto *integrator = std::get_if<IntegratorSettings>(&settings.detector))
        integrator->durationWindows = 60.0;
    if (auto *blocks = std::get_if<BlockViterbiSettings>(&settings.detector))
        blocks->durationWindows = 40.0;
    return settings;
}

/// Noise, and a line of that power in cell 100 in a stretch of frames.
std::shared_ptr<const FrameArray> noiseWithLine(std::uint64_t seed, Index frames, float power = 0.0f, Index from = 0,
                                                Index to = 0)
{
    std::vector<float> y(std::size_t(frames * cellCount));
    Random(seed, 0).exponentials(y);
    for (Index frame = from; frame < to; ++frame)
        y[std::size_t(frame * cellCount + 100)] += power;
    return std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 1.0, frames, false}, grid(), std::move(y));
}

/// Few, so that it is quick; of the frames of a block only one decides.
double calibrationCellFrames(const DetectorSettings &detector)
{
    return framesPerDecision(detector, {}) > 1 ? 2e7 : 4e6;
}

/// An analysis ready to run its chain at a rate of false alarms per cell and frame.
Analysis prepared(std::size_t kind, std::shared_ptr<const FrameArray> frames, double eventsPerCellFrame)
{
    Analysis analysis;
    analysis.settings = settingsOf(kind);
    analysis.frames = std::move(frames);
    analysis.model = makeModel(analysis.settings.model, grid());
    analysis.calibration = calibrateOnIndependentCells(analysis.model, analysis.settings, {},
                                                       calibrationCellFrames(analysis.settings.detector));
    analysis.threshold = analysis.calibration->thresholdForEventRate(eventsPerCellFrame);
    return analysis;
}

float medianOf(std::vector<float> values)
{
    std::nth_element(values.begin(), values.begin() + cellCount / 2, values.end());
    return values[cellCount / 2];
}

void addKinds(std::size_t first = 0)
{
    QTest::addColumn<std::size_t>("kind");
    for (std::size_t kind = first; kind < detectorNames.size(); ++kind)
        QTest::newRow(detectorNames[kind].data()) << kind;
}

} // namespace

/// Every detector in a chain: what it forgets, what its tracks are measured in, how often it is wrong.
class tst_peerChains : public QObject
{
    Q_OBJECT

private slots:
    void aCrossingForgetsItsOwnPlace();
    void aWholeExcursionIsInhibitedInTheNextFrame();
    void theShoulderIsAboveTheNoise_data()
    {
        addKinds(1);
    } // what has branched off a path lies within 8 nat of it, whatever noise does
    void theShoulderIsAboveTheNoise();
    void tracksLeaveTheStatisticAsItIs_data() { addKinds(1); }
    void tracksLeaveTheStatisticAsItIs();
    void eventsHaveTheDetectorsUnit_data() { addKinds(); }
    void eventsHaveTheDetectorsUnit();
    void anOrderIsKept_data() { addKinds(); }
    void anOrderIsKept();
};

void tst_peerChains::aCrossingForgetsItsOwnPlace()
{
    // An integrator's statistic lies at 1, wherever its threshold: one crossing must not take the whole band with it.
    constexpr std::size_t integrator = 2;
    const Analysis analysis = prepared(integrator, noiseWithLine(5, 400, 1.5f, 150, 400), 1e-6);
    const auto chain = makeChain(analysis);
    std::vector<float> y(cellCount);
    std::vector<float> statistic(cellCount);
    std::vector<float> before;
    for (Index frame = 0; frame < 400; ++frame) {
        analysis.frames->read(frame, 1, y);
        before = statistic;
        const bool hasBegun = !chain->trackers().empty();
        chain->update(frame, y, statistic);
        if (!hasBegun)
            continue;
        QVERIFY(medianOf(before) > 0.9f);
        QVERIFY(medianOf(statistic) > 0.9f);
        const std::size_t taken = chain->inhibited().size();
        QVERIFY(taken > 0);
        Index changed = 0;
        for (Index cell = 0; cell < cellCount; ++cell) {
            const auto i = std::size_t(cell);
            if (std::abs(statistic[i] - before[i]) < 0.15f) // a frame is a sixtieth of the mean
                continue;
            ++changed;
            const auto &boxes = chain->inhibited();
            QVERIFY2(std::any_of(boxes.begin(), boxes.end(),
                                 [&](const CellBox &box) { return box.contains(grid(), {cell}); }),
                     qPrintable(QString("cell %1 was forgotten, but is not kept from the detector").arg(cell)));
        }
        QVERIFY(changed < 15);
        return;
    }
    QFAIL("the line was not found");
}

// A band wider than a track's box: its rim would start tracks of its own.
void tst_peerChains::aWholeExcursionIsInhibitedInTheNextFrame()
{
    constexpr std::size_t integrator = 2;
    constexpr Index frames = 300;
    std::vector<float> band(std::size_t(frames * cellCount));
    Random(6, 0).exponentials(band);
    for (Index frame = 150; frame < frames; ++frame)
        for (Index cell = 90; cell < 110; ++cell)
            band[std::size_t(frame * cellCount + cell)] += 4.0f;
    const Analysis analysis = prepared(
        integrator, std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 1.0, frames, false}, grid(), std::move(band)),
        1e-6);
    const auto chain = makeChain(analysis);
    std::vector<float> y(cellCount);
    std::vector<float> statistic(cellCount);
    std::vector<CellBox> forgotten;
    for (Index frame = 0; frame < frames; ++frame) {
        analysis.frames->read(frame, 1, y);
        chain->update(frame, y, statistic);
        if (!forgotten.empty()) {
            for (const CellBox &box : forgotten)
                box.forEachCell(grid(), [&](Index cell) {
                    QVERIFY2(std::ranges::any_of(chain->inhibited(),
                                                 [&](const CellBox &each) { return each.contains(grid(), {cell}); }),
                             QByteArray::number(cell));
                });
            return;
        }
        if (!chain->trackers().empty())
            forgotten.assign(chain->forgotten().begin(), chain->forgotten().end());
    }
    QFAIL("the band was not found");
}

void tst_peerChains::theShoulderIsAboveTheNoise()
{
    QFETCH(std::size_t, kind);
    // Found on other noise, without an event to disturb it.
    Analysis analysis = prepared(kind, noiseWithLine(6, 2000), 1e-6);
    const Index decision = framesPerDecision(analysis.settings.detector, {});
    const double shoulder = analysis.calibration->levelExceededBy(1e-3 / double(decision));
    QVERIFY(shoulder < analysis.threshold);
    const auto detector = makeDetector(analysis);
    std::vector<float> y(cellCount);
    std::vector<float> statistic(cellCount);
    double above = 0.0;
    double decided = 0.0;
    for (Index frame = 0; frame < 2000; ++frame) {
        analysis.frames->read(frame, 1, y);
        detector->update(y, statistic);
        if (frame < 300 || std::isinf(statistic.front()))
            continue;
        decided += cellCount;
        above +=
            double(std::count_if(statistic.begin(), statistic.end(), [&](float d) { return double(d) > shoulder; }));
    }
    // Nobody knows a thousandth of neighbouring cells and frames to better than a factor of two.
    QVERIFY2(above / decided < 2e-3, qPrintable(QString("%1 of %2").arg(above).arg(decided)));
}

void tst_peerChains::tracksLeaveTheStatisticAsItIs()
{
    QFETCH(std::size_t, kind);
    const Analysis analysis = prepared(kind, noiseWithLine(8, 500, 20.0f, 150, 250), 1e-6);
    const auto chain = makeChain(analysis);
    const auto alone = makeDetector(analysis);
    std::vector<float> y(cellCount);
    std::vector<float> statistic(cellCount);
    std::vector<float> expected(cellCount);
    Index followed = 0;
    for (Index frame = 0; frame < 500; ++frame) {
        analysis.frames->read(frame, 1, y);
        chain->update(frame, y, statistic);
        alone->update(y, expected);
        QCOMPARE(statistic, expected);
        followed += chain->trackers().empty() ? 0 : 1;
    }
    QVERIFY(followed > 50);
}

void tst_peerChains::eventsHaveTheDetectorsUnit()
{
    QFETCH(std::size_t, kind);
    // So strong a line for so long has hundreds of nats, but not hundreds of times the noise.
    Analysis analysis = prepared(kind, noiseWithLine(7, 600, 20.0f, 200, 400), 1e-6);
    const auto chain = makeChain(analysis);
    std::vector<float> y(cellCount);
    std::vector<float> statistic(cellCount);
    float largest = 0.0f;
    for (Index frame = 0; frame < 600; ++frame) {
        analysis.frames->read(frame, 1, y);
        chain->update(frame, y, statistic);
        largest = std::max(largest, *std::max_element(statistic.begin(), statistic.end()));
    }
    chain->finish();
    analysis.tracks = chain->takeJoinedTracks();
    const std::vector<Event> found = events(analysis);
    QVERIFY(!found.empty());
    const auto strongest = std::max_element(found.begin(), found.end(),
                                            [](const Event &a, const Event &b) { return a.statistic < b.statistic; });
    QVERIFY(std::abs(strongest->position.front() - 100.0) <= 1.0);
    QVERIFY(strongest->statistic > analysis.threshold);
    QVERIFY(strongest->statistic <= double(largest) * 1.000001);
    if (statisticUnit(analysis.settings.detector) == "nat")
        return;
    QVERIFY2(largest < 60.0f, qPrintable(QString::number(double(largest))));
    QVERIFY(analysis.tracks.front().peakStatistic > 100.0);
}

void tst_peerChains::anOrderIsKept()
{
    QFETCH(std::size_t, kind);
    constexpr Index frames = 20000;
    constexpr double ordered = 60.0;
    const double rate = ordered / (double(frames) * cellCount);
    const Analysis analysis = prepared(kind, noiseWithLine(900 + kind, frames), rate);
    const auto chain = makeChain(analysis, makePathDetector(analysis), false);
    std::vector<float> y(cellCount);
    std::vector<float> statistic(cellCount);
    for (Index frame = 0; frame < frames; ++frame) {
        analysis.frames->read(frame, 1, y);
        chain->update(frame, y, statistic);
    }
    chain->finish();
    const double ratio = double(chain->tracks().size()) / ordered;
    QVERIFY2(ratio > 0.7 && ratio < 1.4, qPrintable(QString::number(ratio)));
}

FAINTLINE_TEST(tst_peerChains)
#include "tst_peerChains.moc"

#include "evaluate/experiments/campaignCurve.h"
#include "support/test.h"

#include "base/Random.h"
#include "evaluate/experiments/InjectionTrials.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

namespace {

Experiment twoSnrs()
{
    Experiment made;
    made.snrDb = {-2.0, 1.0};
    return made;
}

/// Runs of two detectors with whole statistics, so that many are equal.
std::vector<RunOutcome> someOutcomes(int runs, int blocks)
{
    Random random(61, std::uint64_t(runs));
    const auto values = [&](double shift) {
        std::vector<float> made;
        for (int i = 0; i < blocks; ++i)
            made.push_back(float(std::floor(8.0 * random.uniform() + shift)));
        return made;
    };
    std::vector<RunOutcome> outcomes;
    for (int run = 0; run < runs; ++run) {
        RunOutcome outcome;
        outcome.run = run;
        outcome.noise = {values(0.0), values(10.0)};
        outcome.signal = {{values(1.0), values(3.0)}, {values(11.0), values(16.0)}};
        outcomes.push_back(std::move(outcome));
    }
    return outcomes;
}

} // namespace

/// Detection probabilities of outcomes with many ties, counted pair by pair; and the mask of signals, cell by cell.
class tst_PdCurve : public QObject
{
    Q_OBJECT

private slots:
    void everyPairOfARunIsCompared()
    {
        const auto outcomes = someOutcomes(3, 7);
        for (std::size_t d = 0; d < 2; ++d)
            for (std::size_t s = 0; s < 2; ++s) {
                double wins = 0.0; // of runs of the same size the mean of means is the mean
                for (const RunOutcome &outcome : outcomes)
                    for (const float signal : outcome.signal[d][s])
                        for (const float noise : outcome.noise[d])
                            wins += signal > noise ? 1.0 : 0.0;
                const CurvePoint point = pdAgainstBlocks(twoSnrs(), outcomes, d, s);
                QVERIFY(std::abs(point.pd - wins / (3.0 * 49.0)) < 1e-12);
                QCOMPARE(point.trials, std::int64_t(21));
                QCOMPARE(point.snrDb, s == 0 ? -2.0 : 1.0);
                QCOMPARE(point.interval, wilsonInterval(std::llround(21.0 * point.pd), 21)); // too few for a scatter
            }
    }

    void manyRunsTellTheirScatter()
    {
        const auto outcomes = someOutcomes(12, 6);
        std::vector<double> pds;
        for (const RunOutcome &outcome : outcomes)
            pds.push_back(pdAgainstBlocks(twoSnrs(), std::span(&outcome, 1), 0, 0).pd);
        double mean = 0.0;
        for (const double pd : pds)
            mean += pd / 12.0;
        double squares = 0.0;
        for (const double pd : pds)
            squares += (pd - mean) * (pd - mean);
        const double error = std::sqrt(squares / 11.0 / 12.0);
        const CurvePoint point = pdAgainstBlocks(twoSnrs(), outcomes, 0, 0);
        QVERIFY(std::abs(point.pd - mean) < 1e-12);
        QVERIFY(std::abs(point.interval.low - (mean - 1.959963984540054 * error)) < 1e-9);
        QVERIFY(std::abs(point.interval.high - (mean + 1.959963984540054 * error)) < 1e-9);
    }

    void certainAnswersStayWithinOne()
    {
        auto outcomes = someOutcomes(6, 4);
        for (RunOutcome &outcome : outcomes)
            outcome.signal[0] = {std::vector<float>(4, 1e9f), std::vector<float>(4, -1e9f)};
        const CurvePoint all = pdAgainstBlocks(twoSnrs(), outcomes, 0, 0);
        QCOMPARE(all.pd, 1.0);
        QCOMPARE(all.interval, (Interval{1.0, 1.0}));
        QCOMPARE(pdAgainstBlocks(twoSnrs(), outcomes, 0, 1).interval, (Interval{0.0, 0.0}));
        // One run that misses half: the interval reaches beyond one but for the cut.
        outcomes[0].signal[0][0] = {1e9f, 1e9f, -1e9f, -1e9f};
        const CurvePoint nearly = pdAgainstBlocks(twoSnrs(), outcomes, 0, 0);
        QVERIFY(nearly.pd < 1.0 && nearly.interval.low < nearly.pd);
        QCOMPARE(nearly.interval.high, 1.0);
    }

    // No more blocks than asked for exceed it, and of the next lower maximum too many do.
    void aThresholdIsExceededByItsShare()
    {
        const auto outcomes = someOutcomes(10, 8);
        std::vector<double> maxima;
        for (const RunOutcome &outcome : outcomes)
            maxima.insert(maxima.end(), outcome.noise[0].begin(), outcome.noise[0].end());
        const auto above = [&](double threshold) {
            return std::count_if(maxima.begin(), maxima.end(), [&](double value) { return value > threshold; });
        };
        for (const double probability : {0.0, 0.01, 0.1, 0.3, 0.6321, 0.99}) {
            const double threshold = blockThreshold(outcomes, 0, probability);
            QVERIFY(std::count(maxima.begin(), maxima.end(), threshold) > 0);
            QVERIFY(double(above(threshold)) <= 80.0 * probability + 1e-9);
            if (threshold > 0.0)
                QVERIFY(double(above(threshold - 1.0)) > 80.0 * probability);
        }
        QCOMPARE(blockThreshold(outcomes, 0, 1.0), *std::min_element(maxima.begin(), maxima.end()));
    }

    void rocGoesThroughEveryMaximum()
    {
        const auto outcomes = someOutcomes(4, 9);
        const std::vector<RocPoint> curve = rocPoints({twoSnrs(), {}, outcomes}, 0, 1);
        QCOMPARE(curve.size(), std::size_t(8)); // 0 … 7, however often each
        for (std::size_t i = 0; i < curve.size(); ++i) {
            const double threshold = 7.0 - double(i);
            double alarms = 0.0;
            double hits = 0.0;
            for (const RunOutcome &outcome : outcomes) {
                for (const float noise : outcome.noise[0])
                    alarms += double(noise) > threshold ? 1.0 : 0.0;
                for (const float signal : outcome.signal[0][1])
                    hits += double(signal) > threshold ? 1.0 : 0.0;
            }
            QCOMPARE(curve[i].threshold, threshold);
            QVERIFY(std::abs(std::exp(-curve[i].falseAlarms) - (1.0 - alarms / 36.0)) < 1e-12);
            QCOMPARE(curve[i].pd, hits / 36.0);
            QCOMPARE(curve[i].interval, wilsonInterval(std::int64_t(hits), 36));
        }
    }

    // Stretches that overlap, touch, enclose one another and reach beyond the band.
    void maskIsAGridOfCells()
    {
        constexpr Index frames = 4;
        constexpr Index bins = 30;
        Random random(62, 0);
        for (int round = 0; round < 50; ++round) {
            SignalMask mask(frames, bins);
            std::vector<std::vector<bool>> grid(frames, std::vector<bool>(bins, false));
            for (int i = 0; i < 12; ++i) {
                const auto frame = Index(random.uniform() * 6.0) - 1;
                const auto low = Index(random.uniform() * 40.0) - 5;
                const auto high = low + Index(random.uniform() * 8.0) - 1; // sometimes none
                mask.add(frame, low, high);
                for (Index bin = std::max<Index>(low, 0); bin <= std::min(high, bins - 1); ++bin)
                    if (frame >= 0 && frame < frames)
                        grid[std::size_t(frame)][std::size_t(bin)] = true;
            }
            double taken = 0.0;
            for (Index frame = 0; frame < frames; ++frame) {
                const std::vector<bool> &row = grid[std::size_t(frame)];
                taken += double(std::count(row.begin(), row.end(), true));
                const Index firstBin = 7;
                std::vector<float> y(11, 1.0f);
                mask.blank(frame, firstBin, y);
                for (Index bin = 0; bin < bins; ++bin) {
                    QCOMPARE(mask.touches(frame, bin, bin), bool(row[std::size_t(bin)]));
                    if (bin >= firstBin && bin < firstBin + 11)
                        QCOMPARE(y[std::size_t(bin - firstBin)], row[std::size_t(bin)] ? 0.0f : 1.0f);
                    for (const Index width : {2, 5})
                        QCOMPARE(mask.touches(frame, bin, bin + width),
                                 std::any_of(row.begin() + bin, row.begin() + std::min(bins, bin + width + 1),
                                             [](bool isTaken) { return isTaken; }));
                }
            }
            QVERIFY(std::abs(mask.freeShare() - (1.0 - taken / (frames * bins))) < 1e-12);
        }
    }

    void emptyMask()
    {
        const SignalMask mask(2, 10);
        QCOMPARE(mask.freeShare(), 1.0);
        QVERIFY(!mask.touches(0, -100, 100) && !mask.touches(-1, 0, 9) && !mask.touches(2, 0, 9));
        std::vector<float> y(10, 2.0f);
        mask.blank(1, 0, y);
        QCOMPARE(y, std::vector<float>(10, 2.0f));
    }
};

FAINTLINE_TEST(tst_PdCurve)
#include "tst_PdCurve.moc"

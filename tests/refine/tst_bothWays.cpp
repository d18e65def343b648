#include "refine/bothWays.h"
#include "support/test.h"

#include "base/Random.h"
#include "model/StateSpace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace faintline;

namespace {

constexpr Index cells = 300;
constexpr Index frameCount = 160;
constexpr Index onset = 30;
constexpr Index ending = 130;

/// Slopes of whole bins with inertia.
const KinematicAxis &slopes()
{
    static const KinematicAxis axis = [] {
        KinematicAxis made;
        made.name = "frequency";
        made.cells = cells;
        made.firstRate = -1;
        made.rateCount = 3;
        made.rateChange = {0.9, 0.05};
        return made;
    }();
    return axis;
}

/// Where the line is: it drifts up by 0.2 bins a frame.
double lineAt(Index frame)
{
    return 100.3 + 0.2 * double(frame);
}

/// Exponential noise around the line's path, and the line's power from onset to ending: a main lobe two bins wide.
PathStrip strip(double snr, std::uint64_t stream)
{
    PathStrip made;
    made.halfWidth = bothWaysHalfWidth(1.0);
    Random random(7, stream);
    for (Index frame = 0; frame < frameCount; ++frame) {
        made.centres.push_back(std::lround(lineAt(frame)));
        for (Index i = 0; i < made.width(); ++i) {
            const double off = double(made.centres.back() - made.halfWidth + i) - lineAt(frame);
            const bool isThere = frame >= onset && frame < ending && std::abs(off) < 1.0;
            const double power = isThere ? snr * std::pow(std::cos(1.5707963267948966 * off), 2.0) : 0.0;
            made.y.push_back(float(power + random.exponential()));
        }
    }
    return made;
}

BothWaysModel model()
{
    BothWaysModel made;
    made.axis = &slopes();
    made.likelihood = Likelihood(LikelihoodKind::Exponential, 2.0);
    made.threshold = 12.0;
    made.lnK = std::vector<double>(std::size_t(frameCount), -0.4);
    return made;
}

Index nearest(double position)
{
    return std::lround(position);
}

} // namespace

/// A track seen from both ends: a known line is found again, and what is said of it is what plain loops say.
class tst_bothWays : public QObject
{
    Q_OBJECT

private slots:
    void aLineIsThereFromOnsetToEnd();
    void endsAreSeenSoon_data();
    void endsAreSeenSoon();
    void positionsAreBelowACell();
    void levelsAreMeansAlongThePath();
    void gainsAreTheDetectorsAccount();
    void aParabolaStandsOnTheMeanPowers();
    void theStrongestPathIsTheBestOfAll();
    void aSteadyLineKeepsItsSlope();
    void framesThatWereNotObserved();
    void atTheAxisEnd();
    void widthOfAStrip();
};

void tst_bothWays::aLineIsThereFromOnsetToEnd()
{
    const BothWays seen = lookBothWays(strip(12.0, 1), model());
    QCOMPARE(seen.presence.present.size(), std::size_t(frameCount));
    for (Index frame = 0; frame < frameCount; ++frame) {
        const float present = seen.presence.present[std::size_t(frame)];
        if (frame < onset - 8 || frame > ending + 8)
            QVERIFY2(present < 0.2f, qPrintable(QString("frame %1: %2").arg(frame).arg(double(present))));
        if (frame > onset + 4 && frame < ending - 5)
            QVERIFY2(present > 0.9f, qPrintable(QString("frame %1: %2").arg(frame).arg(double(present))));
    }
}

void tst_bothWays::endsAreSeenSoon_data()
{
    QTest::addColumn<double>("snr");
    QTest::newRow("6 dB") << 4.0;
    QTest::newRow("10 dB") << 10.0;
}

// A line that begins and ends is expected at its own level beside it, and not at what is left of that in a mean over
// frames with and without it.
void tst_bothWays::endsAreSeenSoon()
{
    QFETCH(double, snr);
    constexpr int runs = 10;
    int late = 0;
    for (int run = 0; run < runs; ++run) {
        const std::vector<float> present = lookBothWays(strip(snr, std::uint64_t(20 + run)), model()).endsBy;
        for (Index frame = onset + 4; frame < ending - 4; ++frame)
            QVERIFY2(present[std::size_t(frame)] > 0.5f, qPrintable(QString::number(frame)));
        late += present[std::size_t(onset - 5)] > 0.5f ? 1 : 0;
        late += present[std::size_t(ending + 4)] > 0.5f ? 1 : 0;
    }
    QVERIFY2(late <= 2, qPrintable(QString::number(late)));
}

void tst_bothWays::positionsAreBelowACell()
{
    const BothWays seen = lookBothWays(strip(12.0, 2), model());
    double squares = 0.0;
    double ofPath = 0.0;
    for (Index frame = onset + 10; frame < ending - 10; ++frame) {
        squares += std::pow(seen.positions[std::size_t(frame)] - lineAt(frame), 2.0);
        ofPath += std::pow(double(nearest(lineAt(frame))) - lineAt(frame), 2.0);
    }
    const double frames = double(ending - onset - 20);
    QVERIFY2(std::sqrt(squares / frames) < 0.25, qPrintable(QString::number(std::sqrt(squares / frames))));
    QVERIFY(std::sqrt(ofPath / frames) > 0.26); // what the cells of a perfect path are off by
}

// ±12 frames along the mean path, what was not observed left out.
void tst_bothWays::levelsAreMeansAlongThePath()
{
    PathStrip made = strip(3.0, 3);
    for (Index i = 0; i < made.width(); ++i)
        made.row(80)[i] = std::numeric_limits<float>::quiet_NaN();
    const BothWays seen = lookBothWays(made, model());
    for (Index frame = 0; frame < frameCount; ++frame) {
        double sum = 0.0;
        double count = 0.0;
        for (Index other = std::max<Index>(0, frame - 12); other <= std::min(frameCount - 1, frame + 12); ++other)
            if (const float y = made.valueAt(other, nearest(seen.presence.mean[std::size_t(other)])); !std::isnan(y)) {
                sum += double(y);
                count += 1.0;
            }
        QVERIFY(std::abs(seen.levels[std::size_t(frame)] - std::max(0.0, sum / count - 1.0)) < 1e-9);
    }
}

void tst_bothWays::gainsAreTheDetectorsAccount()
{
    const PathStrip made = strip(3.0, 4);
    const BothWays seen = lookBothWays(made, model());
    for (Index frame = 0; frame < frameCount; ++frame) {
        const auto y = double(made.valueAt(frame, nearest(seen.presence.mean[std::size_t(frame)])));
        const double lambda = y * 2.0 / 3.0 - std::log(3.0);
        QVERIFY(std::abs(seen.gains[std::size_t(frame)] - (lambda - 0.4 + std::log(0.9))) < 1e-9);
    }
}

// At most a bin from the mean: powers beside it, between bins linear, averaged over clamp(10/level, 1, 8) frames.
void tst_bothWays::aParabolaStandsOnTheMeanPowers()
{
    const PathStrip made = strip(6.0, 5);
    const BothWays seen = lookBothWays(made, model());
    for (Index frame = 0; frame < frameCount; ++frame) {
        const double level = seen.levels[std::size_t(frame)];
        const auto reach = Index(std::clamp(level > 0.1 ? 10.0 / level : 100.0, 1.0, 8.0));
        std::array<double, 5> ln{};
        for (int offset = -2; offset <= 2; ++offset) {
            double sum = 0.0;
            for (Index other = std::max<Index>(0, frame - reach); other <= std::min(frameCount - 1, frame + reach);
                 ++other) {
                const double position = seen.presence.mean[std::size_t(other)] + offset;
                const double lower = std::floor(position);
                sum += (lower + 1.0 - position) * double(made.valueAt(other, Index(lower)))
                       + (position - lower) * double(made.valueAt(other, Index(lower) + 1));
            }
            ln[std::size_t(offset + 2)] = std::log(sum);
        }
        int peak = -1; // of the three in the middle
        for (int offset = 0; offset <= 1; ++offset)
            if (ln[std::size_t(offset + 2)] > ln[std::size_t(peak + 2)])
                peak = offset;
        const double a = ln[std::size_t(peak + 1)];
        const double b = ln[std::size_t(peak + 2)];
        const double c = ln[std::size_t(peak + 3)];
        double vertex = 0.0;
        if (a - 2.0 * b + c < 0.0)
            vertex = std::clamp(0.5 * (a - c) / (a - 2.0 * b + c), -0.5, 0.5);
        const double expected = std::clamp(peak + vertex, -1.0, 1.0);
        QVERIFY(std::abs(seen.positions[std::size_t(frame)] - seen.presence.mean[std::size_t(frame)] - expected)
                < 1e-9);
    }
}

// The recursion by its definition on all of the axis, with evidence in the corridor alone.
void tst_bothWays::theStrongestPathIsTheBestOfAll()
{
    const PathStrip made = strip(2.0, 6);
    const BothWaysModel detector = model();
    const StateSpace space({slopes()});
    std::vector<double> scores(std::size_t(space.stateCount()), -INFINITY);
    double strongest = -INFINITY;
    for (Index frame = 0; frame < frameCount; ++frame) {
        std::vector<double> next(scores.size(), -INFINITY);
        for (Index state = 0; state < space.stateCount(); ++state) {
            const Index cell = space.cellOf(state);
            if (std::abs(cell - made.centres[std::size_t(frame)]) > 3) // resolution cells, a bin each
                continue;
            double best = -INFINITY;
            for (const StateSpace::Predecessor &before : space.predecessors(state, frame))
                best = std::max(best, scores[std::size_t(before.state)] + before.lnProbability);
            const auto y = double(made.valueAt(frame, cell));
            next[std::size_t(state)] = y * 2.0 / 3.0 - std::log(3.0) + std::max(0.0, best - 0.4);
            strongest = std::max(strongest, next[std::size_t(state)]);
        }
        scores = std::move(next);
    }
    const double found = strongestIn(made, detector);
    QVERIFY2(std::abs(found - strongest) < 1e-3, qPrintable(QString("%1, not %2").arg(found).arg(strongest)));
}

void tst_bothWays::aSteadyLineKeepsItsSlope()
{
    PathStrip made = strip(12.0, 7);
    const std::vector<double> drifting = slopeChangesOf(made, model());
    QCOMPARE(drifting.size(), std::size_t(2));
    // A fifth of a bin a frame is one step in five frames: there and back again.
    // Frames in which it is there, and in the next one, too: between what their probabilities allow.
    const std::vector<float> present = lookBothWays(made, model()).presence.present;
    double least = 0.0;
    double most = 0.0;
    for (std::size_t frame = 1; frame < present.size(); ++frame) {
        least += std::max(0.0, double(present[frame - 1] + present[frame]) - 1.0);
        most += double(std::min(present[frame - 1], present[frame]));
    }
    const double pairs = drifting[0] + drifting[1];
    QVERIFY2(pairs > least - 1.0 && pairs < most + 1.0, qPrintable(QString::number(pairs)));
    QVERIFY2(drifting[1] > 15.0 && drifting[1] < 55.0, qPrintable(QString::number(drifting[1])));
    Random random(7, 99);
    for (Index frame = 0; frame < frameCount; ++frame) {
        made.centres[std::size_t(frame)] = 100;
        for (Index i = 0; i < made.width(); ++i)
            made.row(frame)[i] = float((i == made.halfWidth ? 19.0 : 0.0) + random.exponential());
    }
    const std::vector<double> steady = slopeChangesOf(made, model());
    QVERIFY(std::abs(steady[0] + steady[1] - double(frameCount - 1)) < 5.0);
    QVERIFY2(steady[1] < 8.0, qPrintable(QString::number(steady[1])));
}

void tst_bothWays::framesThatWereNotObserved()
{
    PathStrip made = strip(12.0, 8);
    for (Index frame = 70; frame < 75; ++frame)
        std::fill_n(made.row(frame), made.width(), std::numeric_limits<float>::quiet_NaN());
    const BothWays seen = lookBothWays(made, model());
    for (Index frame = 0; frame < frameCount; ++frame) {
        const auto at = std::size_t(frame);
        QVERIFY(std::isfinite(seen.positions[at]) && std::isfinite(seen.levels[at]) && std::isfinite(seen.gains[at]));
        if (frame >= 70 && frame < 75)
            QVERIFY(seen.presence.present[at] > 0.9f); // between two that were
    }
    std::fill(made.y.begin(), made.y.end(), std::numeric_limits<float>::quiet_NaN());
    const BothWays nothing = lookBothWays(made, model());
    for (const double level : nothing.levels)
        QCOMPARE(level, 0.0);
    for (std::size_t at = 0; at < nothing.positions.size(); ++at)
        QCOMPARE(nothing.positions[at], nothing.presence.mean[at]);
}

// The lowest cell of the axis, with nothing below it.
void tst_bothWays::atTheAxisEnd()
{
    PathStrip made = strip(12.0, 9);
    Random random(7, 98);
    for (Index frame = 0; frame < frameCount; ++frame) {
        made.centres[std::size_t(frame)] = 0;
        for (Index i = 0; i < made.width(); ++i)
            made.row(frame)[i] = i < made.halfWidth ? std::numeric_limits<float>::quiet_NaN()
                                                    : float((i == made.halfWidth ? 12.0 : 0.0) + random.exponential());
    }
    const BothWays seen = lookBothWays(made, model());
    for (Index frame = 10; frame < frameCount - 10; ++frame) {
        QVERIFY(seen.presence.present[std::size_t(frame)] > 0.9f);
        const double mean = seen.presence.mean[std::size_t(frame)];
        QVERIFY2(mean > -1e-9 && mean < 0.5, qPrintable(QString("frame %1: %2").arg(frame).arg(mean)));
    }
}

void tst_bothWays::widthOfAStrip()
{
    QCOMPARE(bothWaysHalfWidth(1.0), Index(8)); // a corridor of ±3 about a mean within ±3, and two for a parabola
    QCOMPARE(bothWaysHalfWidth(2.0), Index(14));
    QCOMPARE(bothWaysHalfWidth(1.5), Index(12)); // four and a half bins are five
}

FAINTLINE_TEST(tst_bothWays)
#include "tst_bothWays.moc"

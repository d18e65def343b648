#include "support/test.h"
#include "track/HmmTracker.h"

#include "base/Random.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace faintline;

namespace {

constexpr Index bankCells = 101;
constexpr double threshold = 10.0;
constexpr double lnK = -0.7;
constexpr float unreached = -std::numeric_limits<float>::infinity();

/// A line that stays or goes one cell aside, at three rates.
KinematicAxis line(bool isCyclic)
{
    KinematicAxis axis;
    axis.name = "frequency";
    axis.cells = bankCells;
    axis.cyclic = isCyclic;
    axis.firstRate = -1;
    axis.rateCount = 3;
    axis.rateChange = {0.6, 0.2};
    return axis;
}

Grid gridOf(bool isCyclic)
{
    return {{{"frequency", "Hz", 0.0, 1.0, bankCells, isCyclic}}};
}

TrackSettings wide()
{
    TrackSettings settings;
    settings.windowCells = {30.0};
    settings.decayNats = 0.25;
    settings.ceilingNats = 8.0;
    settings.endNats = 6.0;
    settings.smoothingFrames = 100;
    return settings;
}

/// λ of noise, and of a line that stands in one cell.
std::vector<std::vector<float>> frames(Index count, Index cell, float gain, std::uint64_t stream)
{
    Random random(19, stream);
    std::vector<std::vector<float>> made;
    for (Index frame = 0; frame < count; ++frame) {
        std::vector<float> lambda(std::size_t(bankCells), 0.0f);
        for (float &value : lambda)
            value = float(random.exponential() - 1.5);
        if (cell >= 0)
            lambda[std::size_t(cell)] = gain;
        made.push_back(std::move(lambda));
    }
    return made;
}

/// All states' scores, one frame after the other, by the recursion's definition: the seeded cells alone count.
class WholeLine
{
public:
    WholeLine(const StateSpace &space, const std::vector<float> &scores, const std::vector<Index> &seeded)
        : m_space(space), m_scores{std::vector<double>(scores.size(), double(unreached))}
    {
        for (Index state = 0; state < std::ssize(scores); ++state)
            if (std::find(seeded.begin(), seeded.end(), space.cellOf(state)) != seeded.end())
                m_scores[0][std::size_t(state)] = double(scores[std::size_t(state)]);
    }

    void update(Index frame, const std::vector<float> &lambda)
    {
        std::vector<double> next;
        std::vector<Index> origins;
        for (Index state = 0; state < m_space.stateCount(); ++state) {
            double best = double(unreached);
            Index origin = -1;
            for (const StateSpace::Predecessor &before : m_space.predecessors(state, frame))
                if (const double score = m_scores.back()[std::size_t(before.state)] + before.lnProbability;
                    score > best) {
                    best = score;
                    origin = before.state;
                }
            next.push_back(best + double(lambda[std::size_t(m_space.cellOf(state))]) + lnK);
            origins.push_back(origin);
        }
        m_scores.push_back(std::move(next));
        m_origins.push_back(std::move(origins));
    }

    const std::vector<double> &scores() const { return m_scores.back(); }
    Index best() const { return std::max_element(scores().begin(), scores().end()) - scores().begin(); }

    /// States of the path to one in the newest frame, and its scores.
    std::vector<std::pair<Index, double>> path(Index state) const
    {
        std::vector<std::pair<Index, double>> states;
        for (std::size_t i = m_scores.size(); i-- > 0;) {
            states.emplace_back(state, m_scores[i][std::size_t(state)]);
            state = i > 0 ? m_origins[i - 1][std::size_t(state)] : state;
        }
        std::reverse(states.begin(), states.end());
        return states;
    }

private:
    const StateSpace &m_space;
    std::vector<std::vector<double>> m_scores;
    std::vector<std::vector<Index>> m_origins;
};

/// A tracker that was seeded in frame 5 with scores of cells beside one another, and the whole line beside it.
struct Followed {
    Followed(bool isCyclic, Index cell, const TrackSettings &settings = wide())
        : model({StateSpace({line(isCyclic)}), Likelihood(), 1.0}, gridOf(isCyclic), settings, threshold),
          seeded(around(cell, isCyclic)), scores(seedScores(cell)), whole(model.space, scores, seeded),
          tracker(model, start(), {model.space.cellCount() + cell, seeded, scores, 2.0})
    {
    }

    static std::vector<Index> around(Index cell, bool isCyclic)
    {
        std::vector<Index> all;
        for (Index other = cell - 2; other <= cell + 2; ++other)
            if (isCyclic || (other >= 0 && other < bankCells))
                all.push_back((other + bankCells) % bankCells);
        std::sort(all.begin(), all.end());
        return all;
    }

    /// Of every state; the largest of the seeded ones in the cell itself at rate 0.
    static std::vector<float> seedScores(Index cell)
    {
        Random random(23, 0);
        std::vector<float> all;
        for (Index state = 0; state < 3 * bankCells; ++state)
            all.push_back(float(9.0 * random.uniform()));
        all[std::size_t(bankCells + cell)] = 10.0f;
        return all;
    }

    static Track start()
    {
        Track track;
        track.onsetFrame = track.detectFrame = 5;
        track.points = {{5, 0, 0, 0.0}};
        return track;
    }

    bool update(Index frame, const std::vector<float> &lambda)
    {
        whole.update(frame, lambda);
        return tracker.update(frame, lambda, lnK);
    }

    TrackerModel model;
    std::vector<Index> seeded;
    std::vector<float> scores;
    WholeLine whole;
    HmmTracker tracker;
};

} // namespace

/// The tracker's window against all states of the line, frame by frame, and its level by hand.
class tst_HmmTracker : public QObject
{
    Q_OBJECT

private slots:
    void windowIsTheWholeLine_data();
    void windowIsTheWholeLine();
    void smoothingInPartsFindsTheSamePath();
    void theLevelFollowsTheScore();
    void endsWhereTheFallBegan();
    void aLineThatLeavesTheGridEnds();
    void aTrackerWithoutPastGoesOnToTheBit();
};

void tst_HmmTracker::windowIsTheWholeLine_data()
{
    QTest::addColumn<bool>("isCyclic");
    QTest::addColumn<int>("cell");
    QTest::newRow("in the middle") << false << 50;
    QTest::newRow("at an end") << false << 1;
    QTest::newRow("across the wrap") << true << 0;
}

void tst_HmmTracker::windowIsTheWholeLine()
{
    QFETCH(bool, isCyclic);
    QFETCH(int, cell);
    Followed followed(isCyclic, cell);
    QCOMPARE(followed.tracker.statistic(), 12.0); // the seed's score and its offset
    Index frame = 5;
    for (const std::vector<float> &lambda : frames(12, cell, 1.5f, 1)) {
        followed.update(++frame, lambda);
        const std::vector<double> &expected = followed.whole.scores();
        const Index best = followed.whole.best();
        QVERIFY(std::abs(followed.tracker.statistic() - 2.0 - expected[std::size_t(best)]) < 1e-4);
        QCOMPARE(followed.tracker.cell(), followed.model.space.cellOf(best));

        std::vector<float> painted(expected.size(), unreached);
        followed.tracker.paintStates(painted);
        std::vector<float> ofCells(std::size_t(bankCells), unreached);
        followed.tracker.paint(ofCells);
        for (Index at = 0; at < bankCells; ++at) {
            double highest = double(unreached);
            for (Index plane = 0; plane < 3; ++plane) {
                const auto state = std::size_t(plane * bankCells + at);
                highest = std::max(highest, expected[state]);
                QVERIFY(expected[state] == double(unreached)
                            ? painted[state] == unreached
                            : std::abs(double(painted[state]) - 2.0 - expected[state]) < 1e-4);
            }
            const double found = followed.tracker.scoreAt(at);
            QVERIFY(highest == double(unreached) ? found == highest : std::abs(found - 2.0 - highest) < 1e-4);
            QVERIFY(float(found) == ofCells[std::size_t(at)]
                    || std::abs(float(found) - ofCells[std::size_t(at)]) < 1e-5f);
        }
    }
    // The path's account: each step's score is the one before it and what the step brought.
    const auto path = followed.whole.path(followed.whole.best());
    const std::vector<PathStep> steps = followed.tracker.explain(path.back().first);
    QCOMPARE(steps.size(), path.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
        QCOMPARE(steps[i].state, path[i].first);
        QCOMPARE(steps[i].frame, Index(5 + i));
        QVERIFY(std::abs(steps[i].score - 2.0 - path[i].second) < 1e-4);
        if (i > 0)
            QVERIFY(std::abs(steps[i].score - steps[i - 1].score - steps[i].lnTransition - steps[i].logLikelihoodRatio
                             - lnK)
                    < 1e-4);
    }
    const Track track = followed.tracker.finish(true);
    QCOMPARE(track.points.size(), path.size());
    for (std::size_t i = 0; i < path.size(); ++i) {
        QCOMPARE(track.points[i].cell, followed.model.space.cellOf(path[i].first));
        QCOMPARE(track.points[i].plane, followed.model.space.planeOf(path[i].first));
    }
}

// What was smoothed early is on the path that the end prefers: nine frames later every path comes from there.
void tst_HmmTracker::smoothingInPartsFindsTheSamePath()
{
    TrackSettings brief = wide();
    brief.smoothingFrames = 9;
    Followed whole(false, 50);
    Followed inParts(false, 50, brief);
    Index frame = 5;
    for (const std::vector<float> &lambda : frames(60, 50, 2.0f, 2)) {
        ++frame;
        whole.update(frame, lambda);
        inParts.update(frame, lambda);
        QCOMPARE(inParts.tracker.statistic(), whole.tracker.statistic());
    }
    const Track a = whole.tracker.finish(true);
    const Track b = inParts.tracker.finish(true);
    QCOMPARE(a.points.size(), std::size_t(61));
    QCOMPARE(b.points.size(), a.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        QCOMPARE(b.points[i].frame, Index(5 + i));
        QCOMPARE(b.points[i].cell, a.points[i].cell);
    }
}

void tst_HmmTracker::theLevelFollowsTheScore()
{
    TrackSettings settings = wide();
    settings.confirmNats = 3.0;
    settings.confirmFrames = 6;
    Followed followed(false, 50, settings);
    double level = 12.0; // between the threshold and the ceiling
    double before = 12.0;
    double peak = 12.0;
    Index confirmed = -1;
    Index frame = 5;
    auto lambdas = frames(8, 50, 2.0f, 3);
    for (const std::vector<float> &quiet : frames(30, -1, 0.0f, 4))
        lambdas.push_back(quiet);
    for (const std::vector<float> &lambda : lambdas) {
        ++frame;
        const bool goesOn = followed.update(frame, lambda);
        const double score = 2.0 + followed.whole.scores()[std::size_t(followed.whole.best())];
        level += score - before - 0.25;
        before = score;
        peak = std::max(peak, score);
        if (confirmed < 0 && level >= threshold + 3.0 && frame - 5 + 1 >= 6)
            confirmed = frame;
        level = std::min(level, threshold + 8.0);
        QVERIFY(std::abs(followed.tracker.level() - level) < 1e-3);
        QCOMPARE(followed.tracker.age(), frame - 4);
        QCOMPARE(goesOn, level >= threshold - 6.0);
        if (!goesOn)
            break;
    }
    QVERIFY(frame > 13 && frame < 43); // on noise it fades
    QVERIFY(confirmed >= 10);
    const Track track = followed.tracker.finish(false);
    QVERIFY(track.isConfirmed && !track.isOpen);
    QCOMPARE(track.confirmFrame, confirmed);
    QVERIFY(std::abs(track.peakStatistic - peak) < 1e-3);
}

// A line that gains a nat a frame and stops: the end is in its last frame, however much later that is known.
void tst_HmmTracker::endsWhereTheFallBegan()
{
    Followed followed(false, 50);
    Index frame = 5;
    std::vector<float> heard(std::size_t(bankCells), -1.0f);
    heard[50] = 2.5f;
    for (int i = 0; i < 4; ++i)
        QVERIFY(followed.update(++frame, heard));
    QCOMPARE(frame, followed.tracker.earliestEnd());
    heard[50] = -1.0f;
    while (followed.update(++frame, heard))
        QCOMPARE(followed.tracker.earliestEnd(), Index(9));
    QVERIFY(frame > 12);
    const Track track = followed.tracker.finish(false);
    QCOMPARE(track.endFrame, Index(9));
    QCOMPARE(track.points.back().frame, Index(9));
    QCOMPARE(track.points.size(), std::size_t(5));
}

// All rates lead upward and beyond the last cell.
void tst_HmmTracker::aLineThatLeavesTheGridEnds()
{
    KinematicAxis upward = line(false);
    upward.firstRate = 1;
    upward.rateCount = 1;
    upward.rateChange = {1.0};
    TrackerModel model({StateSpace({upward}), Likelihood(), 1.0}, gridOf(false), wide(), threshold);
    std::vector<float> scores(std::size_t(bankCells), 12.0f);
    const std::vector<Index> seeded{bankCells - 3};
    HmmTracker tracker(model, Followed::start(), {bankCells - 3, seeded, scores, 0.0});
    const std::vector<float> heard(std::size_t(bankCells), 1.0f);
    QVERIFY(tracker.update(6, heard, lnK));
    QVERIFY(tracker.update(7, heard, lnK));
    QCOMPARE(tracker.cell(), bankCells - 1);
    QVERIFY(!tracker.update(8, heard, lnK));
    const Track track = tracker.finish(true);
    QVERIFY(!track.isOpen);
    QCOMPARE(track.endFrame, Index(7));
    QCOMPARE(track.points.back().cell, bankCells - 1);
}

void tst_HmmTracker::aTrackerWithoutPastGoesOnToTheBit()
{
    Followed followed(false, 50);
    TrackerModel other({StateSpace({line(false)}), Likelihood(), 1.0}, gridOf(false), wide(), threshold);
    const auto lambdas = frames(40, 50, 1.5f, 5);
    Index frame = 5;
    for (std::size_t i = 0; i < 20; ++i)
        followed.update(++frame, lambdas[i]);
    HmmTracker bare = followed.tracker.withoutPast(other);
    QVERIFY(bare.bytes() < followed.tracker.bytes());
    for (std::size_t i = 20; i < 40; ++i) {
        ++frame;
        QCOMPARE(bare.update(frame, lambdas[i], lnK), followed.tracker.update(frame, lambdas[i], lnK));
        QVERIFY(bare.statistic() == followed.tracker.statistic() && bare.level() == followed.tracker.level());
        QCOMPARE(bare.cell(), followed.tracker.cell());
        QCOMPARE(bare.earliestEnd(), followed.tracker.earliestEnd());
        std::vector<float> a(std::size_t(bankCells), unreached);
        std::vector<float> b = a;
        bare.paint(a);
        followed.tracker.paint(b);
        QVERIFY(a == b);
    }
    QCOMPARE(bare.finish(true).endFrame, followed.tracker.finish(true).endFrame);
}

FAINTLINE_TEST(tst_HmmTracker)
#include "tst_HmmTracker.moc"

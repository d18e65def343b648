#include "base/Random.h"
#include "refine/explanation.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

namespace {

/// A leakage that falls by a tenth a cell.
double tenths(double distance)
{
    return std::pow(10.0, -distance);
}

} // namespace

/// The floor that explained signals raise.
class tst_explanation : public QObject
{
    Q_OBJECT

private slots:
    void floorIsTheProductOfAll();
    void skirtsCountWhereTheyAreWider();
    void oneFrameMoreAtEitherEnd();
    void transformBesideSharpSignals();
    void halfHiddenTracksLieInOneStretch();
};

void tst_explanation::floorIsTheProductOfAll()
{
    Explanations explanations(100, tenths, tenths);
    explanations.add({10, std::vector<double>(5, 40.0), std::vector<float>(5, 50.0f), {}});
    explanations.add({12, std::vector<double>(300, 42.5), std::vector<float>(300, 8.0f), {}});
    std::vector<float> floor(5);
    explanations.read(13, 39, floor);
    for (Index i = 0; i < 5; ++i) {
        const double cell = 39.0 + double(i);
        const double expected =
            (1.0 + 2.0 * 50.0 * tenths(std::abs(cell - 40.0))) * (1.0 + 2.0 * 8.0 * tenths(std::abs(cell - 42.5)));
        QVERIFY(std::abs(double(floor[std::size_t(i)]) - expected) < 0.03 * expected);
    }
    explanations.read(311, 0, floor); // far off, at the second one's last frame
    for (const float level : floor)
        QCOMPARE(level, 1.0f);
}

void tst_explanation::skirtsCountWhereTheyAreWider()
{
    Explanations explanations(100, tenths, tenths);
    ExplainedSignal signal{0, std::vector<double>(48, 50.0), std::vector<float>(48, 100.0f), {}};
    signal.skirts = {{1.0f, 0.5f, 0.25f, 0.12f}, {}};
    explanations.add(signal);
    std::vector<float> floor(1);
    explanations.read(5, 53, floor); // skirt: 0.12 of the level; leakage: 0.001
    QVERIFY(std::abs(floor[0] - 25.0f) < 0.1f);
    explanations.read(30, 53, floor); // the second block has no skirt
    QVERIFY(std::abs(floor[0] - 1.2f) < 0.02f);
}

void tst_explanation::oneFrameMoreAtEitherEnd()
{
    Explanations explanations(100, tenths, tenths);
    explanations.add({64, {50.0}, {10.0f}, {}});
    std::vector<float> floor(1);
    for (Index frame = 61; frame < 68; ++frame) {
        explanations.read(frame, 50, floor);
        QCOMPARE(floor[0] > 1.0f, frame >= 63 && frame <= 65);
    }
}

void tst_explanation::transformBesideSharpSignals()
{
    const auto none = [](double) { return 0.0; };
    for (const bool isMeasured : {false, true})
        for (const double slope : {0.0, 0.05, 0.5}) {
            Explanations explanations(100, tenths, none);
            ExplainedSignal signal{0, {}, std::vector<float>(24, 100.0f), {}};
            for (int frame = 0; frame < 24; ++frame)
                signal.positions.push_back(40.0 + slope * frame);
            if (isMeasured)
                signal.skirts = {{1.0f}};
            explanations.add(signal);
            std::vector<float> floor(1);
            explanations.read(0, 43, floor);
            const bool isSharp = isMeasured && slope < 0.1;
            QVERIFY(std::abs(double(floor[0]) - (isSharp ? 1.0 : 1.0 + 200.0 * tenths(3.0))) < 1e-4);
        }
}

/// Every track of which half of the points lie where the floor is raised, by enumeration.
void tst_explanation::halfHiddenTracksLieInOneStretch()
{
    constexpr Index frames = 240;
    Random random(4, 0);
    bool areParted = false;
    for (int trial = 0; trial < 20; ++trial) {
        Explanations explanations(100, tenths, tenths);
        std::vector<int> raisedBefore(frames + 1, 0);
        std::vector<bool> isRaised(frames, false);
        for (int signal = 0; signal < 4; ++signal) {
            const auto first = Index(random.uniform() * (frames - 20));
            const auto count = std::size_t(1.0 + random.uniform() * 12.0);
            explanations.add({first, std::vector<double>(count, 40.0), std::vector<float>(count, 9.0f), {}});
            for (Index at = std::max<Index>(0, first - 1); at <= first + Index(count); ++at)
                isRaised[std::size_t(at)] = true;
        }
        for (std::size_t at = 0; at < isRaised.size(); ++at)
            raisedBefore[at + 1] = raisedBefore[at] + int(isRaised[at]);
        const std::vector<Explanations::RaisedStretch> stretches = explanations.stretches();
        areParted = areParted || stretches.size() > 1;
        for (Index first = 0; first < frames; ++first)
            for (Index last = first; last < frames; ++last) {
                const int raised = raisedBefore[std::size_t(last) + 1] - raisedBefore[std::size_t(first)];
                if (2 * raised < last - first + 1)
                    continue;
                QCOMPARE(std::ranges::count_if(
                             stretches, [&](const auto &each) { return each.first <= first && last <= each.last; }),
                         1);
            }
    }
    QVERIFY(areParted);
}

FAINTLINE_TEST(tst_explanation)
#include "tst_explanation.moc"

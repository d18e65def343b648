#include "base/Error.h"
#include "base/Random.h"
#include "plan/makeDetector.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace faintline;

namespace {

using Frames = std::vector<std::vector<float>>;

Grid gridOf(Index cells)
{
    return {{Axis{"frequency", "Hz", 0.0, 1.0, cells, false}}};
}

Frames noise(Index frames, Index cells, std::uint64_t seed)
{
    Random random(seed, 0);
    Frames y(std::size_t(frames), std::vector<float>(std::size_t(cells), 0.0f));
    for (auto &frame : y)
        for (float &value : frame)
            value = float(random.exponential());
    return y;
}

Frames run(Detector &detector, const Frames &y)
{
    Frames statistic;
    for (const auto &frame : y) {
        statistic.emplace_back(frame.size());
        detector.update(frame, statistic.back());
    }
    return statistic;
}

/// Billon's definition, word for word: sort every window.
float pOfNByDefinition(const Frames &y, Index t, Index f, const PofNSettings &settings, Index width)
{
    std::vector<float> maxima;
    for (Index frame = t - settings.n + 1; frame <= t; ++frame) {
        float largest = 0.0f;
        for (Index bin = f - (width - 1) / 2; bin <= f + width / 2; ++bin)
            if (frame >= 0 && bin >= 0 && bin < std::ssize(y.front()))
                largest = std::max(largest, y[std::size_t(frame)][std::size_t(bin)]);
        maxima.push_back(largest);
    }
    std::sort(maxima.begin(), maxima.end(), std::greater<>());
    const auto isEvent = [&](float value) { return double(value) > settings.r1; };
    if (std::count_if(maxima.begin(), maxima.end(), isEvent) < settings.p)
        return 0.0f;
    const double mean = std::accumulate(maxima.begin(), maxima.begin() + settings.p, 0.0) / settings.p;
    return mean > settings.r2 ? float(mean) : 0.0f;
}

MarkovModel threeSlopes(Index cells)
{
    KinematicAxis axis{
        .name = "frequency", .cells = cells, .firstRate = -1, .rateCount = 3, .rateChange = {1.0 / 3.0, 1.0 / 3.0}};
    return {StateSpace({axis}), Likelihood(LikelihoodKind::Rice, 0.5), 1.0};
}

} // namespace

class tst_peers : public QObject
{
    Q_OBJECT

private slots:
    void pOfNSortsEveryWindow_data()
    {
        QTest::addColumn<int>("p");
        QTest::addColumn<int>("n");
        QTest::addColumn<double>("r2");
        QTest::addColumn<int>("width");
        QTest::newRow("3 of 4") << 3 << 4 << 0.0 << 4;
        QTest::newRow("6 of 8") << 6 << 8 << 0.0 << 4;
        QTest::newRow("1 of 1") << 1 << 1 << 0.0 << 1;
        QTest::newRow("2 of 9") << 2 << 9 << 3.0 << 3;
        QTest::newRow("4 of 4, wider than the axis") << 4 << 4 << 0.0 << 50;
    }

    void pOfNSortsEveryWindow()
    {
        QFETCH(int, p);
        QFETCH(int, n);
        QFETCH(double, r2);
        QFETCH(int, width);
        const PofNSettings settings{p, n, 1.2, r2, double(width)};
        const Frames y = noise(30, 37, 4);
        PofN detector(gridOf(37), settings);
        const Frames statistic = run(detector, y);
        int events = 0;
        for (Index t = 0; t < 30; ++t)
            for (Index f = 0; f < 37; ++f) {
                const float expected = pOfNByDefinition(y, t, f, settings, width);
                const float ours = statistic[std::size_t(t)][std::size_t(f)];
                QVERIFY2(std::abs(ours - expected) <= 1e-5f * std::max(1.0f, expected),
                         qPrintable(QString("frame %1, cell %2").arg(t).arg(f)));
                events += expected > 0.0f ? 1 : 0;
            }
        QVERIFY(events > 0);
    }

    void pOfNByHand()
    {
        // Two events of three frames in one cell: 3, 1, 5 with r1 = 2 → (3 + 5)/2.
        PofN detector(gridOf(1), {2, 3, 2.0, 0.0, 1.0});
        const Frames statistic = run(detector, {{3.0f}, {1.0f}, {5.0f}, {0.0f}});
        QCOMPARE(statistic, (Frames{{0.0f}, {0.0f}, {4.0f}, {0.0f}}));
    }

    void pOfNForgets()
    {
        const Grid grid = gridOf(3);
        PofN detector(grid, {2, 3, 2.0, 0.0, 1.0});
        run(detector, {{9.0f, 9.0f, 9.0f}, {9.0f, 9.0f, 9.0f}});
        detector.forget(grid, {{1}, {0}});
        QCOMPARE(run(detector, {{9.0f, 9.0f, 9.0f}}).back(), (std::vector<float>{9.0f, 0.0f, 9.0f}));
    }

    void boxcarIsTheMeanOfTheLastFrames()
    {
        const Frames y = noise(40, 5, 7);
        Integrator detector(5, IntegratorSettings::Shape::Boxcar, 8);
        const Frames statistic = run(detector, y);
        for (std::size_t t = 0; t < y.size(); ++t)
            for (std::size_t f = 0; f < 5; ++f) {
                double sum = 0.0;
                for (std::size_t k = t >= 7 ? t - 7 : 0; k <= t; ++k)
                    sum += double(y[k][f]);
                QVERIFY(std::abs(double(statistic[t][f]) - sum / 8.0) < 1e-6);
            }
    }

    void exponentialFades()
    {
        Integrator detector(1, IntegratorSettings::Shape::Exponential, 10);
        const Frames statistic = run(detector, Frames(30, {1.0f}));
        for (std::size_t t = 0; t < statistic.size(); ++t) // a step's answer: 1 - a^(t+1)
            QVERIFY(std::abs(double(statistic[t][0]) - (1.0 - std::exp(-0.1 * double(t + 1)))) < 1e-6);
    }

    void energyIsTheFrame()
    {
        const Frames y = noise(5, 9, 3);
        const auto detector = makeDetector(EnergySettings{}, threeSlopes(9), gridOf(9), {2.0, 4.0}, {});
        QCOMPARE(run(*detector, y), y);
    }

    void blocksDecideAtTheirEnd()
    {
        const MarkovModel model = threeSlopes(11);
        const Frames y = noise(8, 11, 5);
        BlockViterbi detector(model, 4);
        const Frames statistic = run(detector, y);
        for (std::size_t t = 0; t < y.size(); ++t)
            for (const float value : statistic[t])
                QCOMPARE(std::isfinite(value), t % 4 == 3);
        // The second block knows nothing of the first: a recursion without reset that begins there gives the same.
        Smd fresh(model, {ResetLaw::None});
        QCOMPARE(run(fresh, Frames(y.begin() + 4, y.end())).back(), statistic.back());
    }

    void everyKindCanBeMade()
    {
        const Frames y = noise(20, 13, 6);
        for (std::size_t kind = 0; kind < detectorNames.size(); ++kind) {
            const DetectorSettings settings = detectorOfKind(kind);
            QCOMPARE(settings.index(), kind);
            const auto detector = makeDetector(settings, threeSlopes(13), gridOf(13), {2.0, 1.0}, {});
            const bool scoresPaths = std::holds_alternative<SmdSettings>(settings)
                                     || std::holds_alternative<ShiryaevRobertsSettings>(settings);
            QCOMPARE(dynamic_cast<const PathDetector *>(detector.get()) != nullptr, scoresPaths);
            for (const auto &frame : run(*detector, y))
                for (const float value : frame)
                    QVERIFY(!std::isnan(value));
        }
    }

    void refusals() { QVERIFY_EXCEPTION_THROWN(PofN(gridOf(4), {5, 4}), Error); }
};

FAINTLINE_TEST(tst_peers)
#include "tst_peers.moc"

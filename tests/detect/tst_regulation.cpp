#include "analyse/regulation.h"
#include "base/Random.h"
#include "detect/Smd.h"
#include "model/sonarModels.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace faintline;

namespace {

std::vector<float> exponentialNoise(std::size_t cells, std::uint64_t stream, std::uint64_t frame)
{
    Random random(1000 + stream, frame);
    std::vector<float> y(cells);
    for (float &value : y)
        value = float(random.exponential());
    return y;
}

/// Parsons' recursion written out, state by state in double: the oracle shares nothing with the program but the
/// definition.
struct PlainParsons {
    static constexpr int ranges = 24;
    static constexpr int beams = 6;
    static constexpr int rangeRates = 5;   // -2 … 2
    static constexpr int bearingRates = 3; // -1 … 1
    static constexpr int states = ranges * beams * rangeRates * bearingRates;

    std::vector<double> hRange; ///< h(0), h(1), …
    std::vector<double> hBearing;
    std::vector<double> lnL = std::vector<double>(states, 0.0);
    double lnK = 0.0;
    double resetFraction = 1.0;
    bool isFirst = true;

    static int index(int u, int v, int r, int b) { return ((u * bearingRates + v) * ranges + r) * beams + b; }

    void update(const std::vector<float> &y)
    {
        const double minus = -std::numeric_limits<double>::infinity();
        std::vector<double> best(states, minus);
        if (!isFirst)
            for (int u = 0; u < rangeRates; ++u)
                for (int v = 0; v < bearingRates; ++v)
                    for (int r = 0; r < ranges; ++r)
                        for (int b = 0; b < beams; ++b)
                            for (int u2 = 0; u2 < rangeRates; ++u2)
                                for (int v2 = 0; v2 < bearingRates; ++v2) {
                                    const auto du = std::size_t(std::abs(u2 - u));
                                    const auto dv = std::size_t(std::abs(v2 - v));
                                    if (du >= hRange.size() || dv >= hBearing.size())
                                        continue;
                                    const int r2 = r + (u - 2 + u2 - 2) / 2; // C++ division truncates
                                    const int b2 = (b + (v - 1 + v2 - 1) / 2 + beams) % beams;
                                    if (r2 < 0 || r2 >= ranges)
                                        continue;
                                    double &to = best[std::size_t(index(u2, v2, r2, b2))];
                                    to = std::max(to, std::log(hRange[du]) + std::log(hBearing[dv])
                                                          + lnL[std::size_t(index(u, v, r, b))]);
                                }
        isFirst = false;
        double sum = 0.0;
        int resets = 0;
        for (double &m : best) {
            resets += m <= 0.0 ? 1 : 0;
            m = std::max(m, 0.0);
            sum += m;
        }
        lnK = -sum / states;
        resetFraction = double(resets) / states;
        for (int n = 0; n < states; ++n)
            lnL[std::size_t(n)] = double(y[std::size_t(n % (ranges * beams))]) + best[std::size_t(n)] + lnK;
    }
};

const Grid smallGrid{
    {{"range", "m", 0.0, 1.0, PlainParsons::ranges, false}, {"bearing", "°", 0.0, 1.0, PlainParsons::beams, true}}};

SonarMotion smallMotion(std::vector<double> hRange, std::vector<double> hBearing)
{
    return {2, 1, std::move(hRange), std::move(hBearing)};
}

/// ln K of frames that a law has regulated on noise.
std::vector<double> regulated(const ResetRule &rule, int settling, int frames)
{
    Grid grid = smallGrid;
    grid.axes[0].count = 200;
    SonarMotion motion = nonManoeuvring();
    motion.fastestRange = 3;
    const MarkovModel model = sonarModel(grid, motion);
    Smd detector(model, rule);
    std::vector<float> d(std::size_t(grid.size()));
    std::vector<double> lnK;
    for (int t = 0; t < settling + frames; ++t) {
        detector.update(exponentialNoise(d.size(), 5, std::uint64_t(t)), d);
        if (t >= settling)
            lnK.push_back(detector.regulation().lnK);
    }
    return lnK;
}

} // namespace

/// The laws that regulate K, against Parsons' recursion written out and against closed forms.
class tst_regulation : public QObject
{
    Q_OBJECT

private slots:
    void meanLawIsParsons_data()
    {
        QTest::addColumn<QList<double>>("hRange");
        QTest::addColumn<QList<double>>("hBearing");
        QTest::newRow("non-manoeuvring") << QList<double>{1.0} << QList<double>{1.0};
        QTest::newRow("manoeuvring") << QList<double>{1.0 / 3.0, 1.0 / 3.0} << QList<double>{0.5, 0.25};
        QTest::newRow("two cells a ping") << QList<double>{0.2, 0.2, 0.2} << QList<double>{1.0};
    }

    void meanLawIsParsons()
    {
        QFETCH(QList<double>, hRange);
        QFETCH(QList<double>, hBearing);
        PlainParsons plain;
        plain.hRange.assign(hRange.begin(), hRange.end());
        plain.hBearing.assign(hBearing.begin(), hBearing.end());
        const MarkovModel model = sonarModel(smallGrid, smallMotion(plain.hRange, plain.hBearing));
        Smd detector(model, {ResetLaw::Mean});
        std::vector<float> d(144);
        for (int ping = 0; ping < 8; ++ping) {
            std::vector<float> y = exponentialNoise(144, 7, std::uint64_t(ping));
            // A target of power 5 from range 4 and beam 4 on, two cells and a beam a ping: over the wrap and to the range's
            // end.
            if (const int range = 4 + 2 * ping; range < PlainParsons::ranges)
                y[std::size_t(range * PlainParsons::beams + (4 + ping) % PlainParsons::beams)] += 5.0f;
            plain.update(y);
            detector.update(y, d);
            QVERIFY(std::abs(detector.regulation().lnK - plain.lnK) < 1e-5);
            QVERIFY(std::abs(1.0 - detector.regulation().continuedFraction - plain.resetFraction) < 1e-12);
            double worst = 0.0;
            for (std::size_t n = 0; n < plain.lnL.size(); ++n)
                worst = std::max(worst, std::abs(double(detector.scores()[n]) + detector.offset() - plain.lnL[n]));
            QVERIFY2(worst < 1e-4, qPrintable(QString("ping %1: %2 nat").arg(ping).arg(worst)));
        }
    }

    void dampedHalfLawIsSteady()
    {
        // One-to-one transitions: half of the states reset at K = -2 ln 2 (Lindley). Paths that run off the range's ends
        // shift it slightly.
        const NoiseBand band = noiseBand(regulated({ResetLaw::Half, -1.0, 0.0, 0.1}, 300, 600));
        QVERIFY2(std::abs(band.mean + 2.0 * std::log(2.0)) < 0.08, qPrintable(QString::number(band.mean)));
        QVERIFY2(band.deviation < 0.03, qPrintable(QString::number(band.deviation)));
    }

    void undampedHalfLawSwings()
    {
        const NoiseBand damped = noiseBand(regulated({ResetLaw::Half, -1.386, 0.0, 0.1}, 300, 300));
        const NoiseBand hard = noiseBand(regulated({ResetLaw::Half, -1.386, 0.0, 8.0}, 300, 300));
        QVERIFY2(hard.deviation > 10.0 * damped.deviation,
                 qPrintable(QString("%1, %2").arg(hard.deviation).arg(damped.deviation)));
    }

    void noiseBandHoldsItsNoise()
    {
        const std::vector<double> values{1.0, 2.0, 3.0, 4.0};
        const NoiseBand band = noiseBand(values);
        QCOMPARE(band.mean, 2.5);
        QVERIFY(std::abs(band.deviation - std::sqrt(5.0 / 3.0)) < 1e-12);
        QVERIFY(band.contains(2.5 + 3.9 * band.deviation) && !band.contains(2.5 + 4.1 * band.deviation));
        const std::vector<double> lnK = regulated({ResetLaw::Mean}, 100, 400);
        const NoiseBand own = noiseBand(std::span(lnK).first(200));
        for (double value : std::span(lnK).last(200))
            QVERIFY(own.contains(value));
    }

    void signalsDragK()
    {
        // Signals that no track takes over: K leaves its band downward. Taken out and their cells inhibited, as the chain
        // does, it stays.
        const MarkovModel model = sonarModel(smallGrid, smallMotion({1.0}, {1.0}));
        const auto lastK = [&](float power, bool inhibited) {
            Smd detector(model, {ResetLaw::Mean});
            std::vector<float> d(144);
            const std::vector<Index> sources{2, 20, 38, 56, 74, 92, 110, 128}; // every third range, third beam
            if (inhibited)
                detector.inhibit(sources);
            for (int t = 0; t < 60; ++t) {
                std::vector<float> y = exponentialNoise(144, 9, std::uint64_t(t));
                for (Index cell : sources) {
                    float &value = y[std::size_t(cell)];
                    value = inhibited ? 0.0f : value + power;
                }
                detector.update(y, d);
            }
            return detector.regulation().lnK;
        };
        const double quiet = lastK(0.0f, false);
        QVERIFY2(lastK(5.0f, false) < quiet - 0.5, qPrintable(QString("%1, %2").arg(lastK(5.0f, false)).arg(quiet)));
        QVERIFY2(std::abs(lastK(5.0f, true) - quiet) < 0.3,
                 qPrintable(QString("%1, %2").arg(lastK(5.0f, true)).arg(quiet)));
    }

    void inhibitedCellsDoNotCount()
    {
        // By hand: the mean over the cells that are left, from the scores themselves.
        const MarkovModel model = sonarModel(smallGrid, smallMotion({1.0}, {1.0}));
        const std::vector<Index> inhibited{10, 11, 70, 143};
        Smd detector(model, {ResetLaw::Mean});
        std::vector<float> d(144);
        detector.inhibit(inhibited);
        for (std::uint64_t t = 0; t < 12; ++t) {
            const std::vector<float> y = exponentialNoise(144, 13, t);
            detector.update(y, d);
            double sum = 0.0;
            int continued = 0;
            for (std::size_t n = 0; n < detector.scores().size(); ++n) {
                if (std::binary_search(inhibited.begin(), inhibited.end(), Index(n % 144)))
                    continue;
                const double going = double(detector.scores()[n]) - double(y[n % 144]);
                sum += going;
                continued += going > 1e-5 ? 1 : 0;
            }
            QVERIFY(std::abs(detector.regulation().lnK + sum / (140.0 * 15.0)) < 1e-5);
            QVERIFY(std::abs(detector.regulation().continuedFraction - continued / (140.0 * 15.0)) < 2e-3);
        }
    }

    void allCellsInhibitedKeepK()
    {
        const MarkovModel model = sonarModel(smallGrid, smallMotion({1.0}, {1.0}));
        Smd detector(model, {ResetLaw::Mean});
        std::vector<float> d(144);
        for (std::uint64_t t = 0; t < 10; ++t)
            detector.update(exponentialNoise(144, 15, t), d);
        const double before = detector.regulation().lnK;
        std::vector<Index> all(144);
        for (Index i = 0; i < 144; ++i)
            all[std::size_t(i)] = i;
        detector.inhibit(all);
        detector.update(std::vector<float>(144, 0.0f), d);
        QCOMPARE(detector.regulation().lnK, before);
    }
};

FAINTLINE_TEST(tst_regulation)
#include "tst_regulation.moc"

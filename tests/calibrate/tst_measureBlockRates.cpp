#include "base/Random.h"
#include "calibrate/measureRareRates.h"
#include "detect/BlockViterbi.h"
#include "plan/AnalysisSettings.h"
#include "support/test.h"

#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <cmath>

using namespace faintline;

namespace {

MarkovModel blockModelOf(const ModelSettings &settings, Index cells)
{
    return makeModel(settings, {{{"f", "Hz", 0.0, 1.0, cells, true}}});
}

std::function<std::unique_ptr<Detector>()> blocksOf(const MarkovModel &model)
{
    return [&model] { return std::make_unique<Smd>(model, ResetRule{ResetLaw::None}); };
}

} // namespace

/// Rare rates of a detector that decides at the ends of blocks, against a closed form and against simulation.
class tst_measureBlockRates : public QObject
{
    Q_OBJECT

private slots:
    // Eight independent cells that keep their place, linear likelihood: V is the largest of eight sums of exponentials,
    // P(V ≤ T) = (1 - Q(B, T))^8 with the incomplete gamma function Q, down to 10⁻¹¹ a cell and frame.
    void sumsOfExponentialsAreGamma()
    {
        constexpr Index cells = 8;
        constexpr Index frames = 100; // with fewer, α exceeds ½, where e^(αy) has no variance
        ModelSettings settings = laws::steady();
        settings.likelihood = LikelihoodKind::Linear;
        const MarkovModel model = blockModelOf(settings, cells);
        SplittingSettings splitting;
        splitting.leastLnRate = -27.0;
        const RareRates rates = measureBlockRates(
            blocksOf(model), [] { return independentNoise(cells); }, frames, splitting);
        QVERIFY(!rates.isEmpty());
        QVERIFY2(rates.lnRates.back() < -25.0, qPrintable(QString::number(rates.lnRates.back())));
        for (std::size_t i = 0; i < rates.levels.size(); ++i) {
            const double one = boost::math::gamma_q(double(frames), rates.levels[i]);
            const double expected = std::log(-double(cells) * std::log1p(-one) / double(cells * frames));
            const QString numbers = QString("level %1: ln rate %2, closed form %3, error %4")
                                        .arg(rates.levels[i])
                                        .arg(rates.lnRates[i])
                                        .arg(expected)
                                        .arg(rates.relativeErrors[i]);
            QVERIFY2(std::abs(rates.lnRates[i] - expected) < 4.0 * rates.relativeErrors[i] + 0.02, qPrintable(numbers));
            QVERIFY2(rates.relativeErrors[i] < 0.4, qPrintable(numbers));
        }
    }

    void agreesWithSimulation_data()
    {
        QTest::addColumn<int>("law");
        QTest::newRow("fine slopes") << 0;
        QTest::newRow("Billon's") << 1;
    }

    // Correlated frames and cells, many slopes, the detector itself: its largest statistic at the ends of 30 000 blocks.
    void agreesWithSimulation()
    {
        QFETCH(int, law);
        constexpr Index frames = 24;
        constexpr int blocks = 30000;
        const auto makeNoise = [] { return spectralNoise({}, 16); };
        const auto noise = makeNoise();
        const MarkovModel model = blockModelOf(law == 0 ? ModelSettings() : laws::billon(), noise->cells());
        SplittingSettings splitting;
        splitting.leastLnRate = -20.0;
        const RareRates rates = measureBlockRates(blocksOf(model), makeNoise, frames, splitting);
        QVERIFY(!rates.isEmpty());
        BlockViterbi detector(model, frames);
        Random random(51, 0);
        std::vector<float> y(std::size_t(noise->cells()));
        std::vector<float> statistic(y.size());
        std::vector<double> largest;
        for (int frame = 0; frame < blocks * int(frames); ++frame) {
            noise->next(random, y);
            detector.update(y, statistic);
            if (const float value = *std::max_element(statistic.begin(), statistic.end()); std::isfinite(value))
                largest.push_back(double(value));
        }
        QCOMPARE(largest.size(), std::size_t(blocks));
        std::sort(largest.begin(), largest.end());
        for (const int above : {3000, 300, 60}) {
            const double p = double(above) / blocks;
            const double level = largest[largest.size() - std::size_t(above)];
            const double expected = std::log(-std::log1p(-p) / double(noise->cells() * frames));
            const double error = std::hypot(rates.relativeErrorAt(level), 1.0 / std::sqrt(above));
            QVERIFY2(std::abs(rates.lnRateAt(level) - expected) < 3.0 * error + 0.03,
                     qPrintable(QString("%1 blocks: %2, simulated %3 ± %4")
                                    .arg(above)
                                    .arg(rates.lnRateAt(level))
                                    .arg(expected)
                                    .arg(error)));
        }
    }

    void threadsChangeNothing()
    {
        const MarkovModel model = blockModelOf(ModelSettings(), 32);
        const auto noise = [] { return independentNoise(32); };
        SplittingSettings splitting;
        splitting.leastLnRate = -13.0;
        RunContext three;
        three.threads = 3;
        const RareRates one = measureBlockRates(blocksOf(model), noise, 10, splitting);
        QVERIFY(!one.isEmpty());
        QVERIFY(one == measureBlockRates(blocksOf(model), noise, 10, splitting, three));
    }

    void blocksThatAreTooLongAreEmpty()
    {
        const MarkovModel model = blockModelOf(ModelSettings(), 8);
        QVERIFY(measureBlockRates(blocksOf(model), [] { return independentNoise(8); }, 100000, {}).isEmpty());
    }
};

FAINTLINE_TEST(tst_measureBlockRates)
#include "tst_measureBlockRates.moc"

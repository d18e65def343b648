#include "analysis/AnalysisSettings.h"
#include "analysis/rareRates.h"
#include "base/Random.h"
#include "detect/PofN.h"
#include "detect/Smd.h"
#include "evaluate/theory.h"

#include <QtTest>

using namespace faintline;

namespace {

MarkovModel modelOf(const ModelSettings &settings, Index cells)
{
    return makeModel(settings, {{{"f", "Hz", 0.0, 1.0, cells, true}}});
}

/// Times that a cycle reaches a level, one frame after the other.
double lnBruteRate(Detector &detector, NoiseStream &noise, double base, double level, int frames)
{
    Random random(31, 0);
    std::vector<float> y(static_cast<std::size_t>(noise.cells()));
    std::vector<float> statistic(y.size());
    bool isBelow = false;
    double count = 0.0;
    for (int frame = 0; frame < frames; ++frame) {
        noise.next(random, y);
        detector.update(y, statistic);
        const auto highest = static_cast<double>(*std::max_element(statistic.begin(), statistic.end()));
        if (isBelow && highest > level) {
            ++count;
            isBelow = false;
        } else if (highest < base) {
            isBelow = true;
        }
    }
    return std::log(count / (static_cast<double>(frames) * static_cast<double>(noise.cells())));
}

} // namespace

/// Rare rates by splitting, against closed forms and against simulation where that still reaches.
class tst_rareRates : public QObject
{
    Q_OBJECT

private slots:
    void oneSlopeIsLindleys();
    void agreesWithSimulation_data();
    void agreesWithSimulation();
    void spectralNoiseIsWhite();
    void threadsChangeNothing();
    void whatCannotTellItsStateIsEmpty();
    void aShortWindowIsEmpty();
};

void tst_rareRates::oneSlopeIsLindleys()
{
    // Independent cells that keep their place, linear likelihood: P(L > T) is exponential from the first level on, down to 10⁻¹².
    const double lnK = -1.6;
    ModelSettings settings = laws::steady();
    settings.likelihood = LikelihoodKind::Linear;
    const MarkovModel model = modelOf(settings, 1);
    SplittingSettings splitting;
    splitting.entries = 15000;
    splitting.leastLnRate = -28.0;
    const RareRates rates = measureRareRates(
        [&] {
            return std::make_unique<Smd>(model, ResetRule{ResetLaw::Fixed, lnK});
        },
        [] { return independentNoise(1); }, splitting);
    const double from = rates.levels[1];
    const double to = rates.levels.back();
    QVERIFY(rates.lnRates.back() < -27.0);
    const double expected = std::log(lindleyExceedance(to + lnK, lnK) / lindleyExceedance(from + lnK, lnK));
    const double found = rates.lnRates.back() - rates.lnRates[1];
    QVERIFY2(
        std::abs(found - expected) < 3.0 * rates.relativeErrors.back(),
        qPrintable(
            QString("ln ratio %1, closed form %2 ± %3").arg(found).arg(expected).arg(rates.relativeErrors.back())));
    QVERIFY(rates.relativeErrors.back() < 0.2);
}

void tst_rareRates::agreesWithSimulation_data()
{
    QTest::addColumn<int>("law");
    QTest::newRow("fine slopes") << 0;
    QTest::newRow("steady") << 1;
}

void tst_rareRates::agreesWithSimulation()
{
    QFETCH(int, law);
    const ModelSettings settings = law == 0 ? ModelSettings() : laws::steady();
    const auto noise = [] { return spectralNoise({}, 16); };
    const MarkovModel model = modelOf(settings, noise()->cells());
    const ResetRule rule{ResetLaw::Fixed, 0.0};
    SplittingSettings splitting;
    splitting.leastLnRate = -14.0;
    const RareRates rates = measureRareRates([&] { return std::make_unique<Smd>(model, rule); }, noise, splitting);
    // From a level that cycles reach often to one that they reach some hundred times.
    const double lower = rates.levels[1];
    const double upper = rates.levels[3];
    Smd detector(model, rule);
    Smd again(model, rule);
    const auto stream = noise();
    const auto other = noise();
    const int frames = 400000;
    const double base = rates.levels[0] - 1.0;
    QVERIFY(rates.levels.size() > 3);
    const double expected =
        lnBruteRate(detector, *stream, base, upper, frames) - lnBruteRate(again, *other, base, lower, frames);
    const double found = rates.lnRates[3] - rates.lnRates[1];
    const double error =
        std::hypot(rates.relativeErrors[3],
                   1.0 / std::sqrt(std::exp(rates.lnRates[3]) * frames * static_cast<double>(stream->cells())));
    QVERIFY2(std::abs(found - expected) < 3.5 * error + 0.05,
             qPrintable(QString("%1, simulated %2 ± %3").arg(found).arg(expected).arg(error)));
}

void tst_rareRates::spectralNoiseIsWhite()
{
    const auto noise = spectralNoise({}, 32);
    Random random(32, 0);
    std::vector<float> y(static_cast<std::size_t>(noise->cells()));
    std::vector<double> sum(y.size());
    const int frames = 20000;
    for (int frame = 0; frame < frames; ++frame) {
        noise->next(random, y);
        for (std::size_t cell = 0; cell < y.size(); ++cell)
            sum[cell] += static_cast<double>(y[cell]);
    }
    for (const double total : sum)
        QVERIFY(std::abs(total / frames - 1.0) < 5.0 * 1.2 / std::sqrt(frames)); // overlapping frames are correlated
    // It goes on from a state as it would have gone on.
    const std::vector<float> state = noise->state();
    Random a(33, 0);
    Random b(33, 0);
    std::vector<float> expected(y.size());
    noise->next(a, expected);
    const auto other = spectralNoise({}, 32);
    other->setState(state);
    other->next(b, y);
    QCOMPARE(y, expected);
}

void tst_rareRates::threadsChangeNothing()
{
    const auto noise = [] { return spectralNoise({}, 16); };
    const MarkovModel model = modelOf(ModelSettings(), noise()->cells());
    const auto make = [&] { return std::make_unique<Smd>(model, ResetRule{ResetLaw::Fixed, 0.0}); };
    SplittingSettings splitting;
    splitting.entries = 200;
    splitting.leastLnRate = -12.0;
    RunContext three;
    three.threads = 3;
    QVERIFY(measureRareRates(make, noise, splitting) == measureRareRates(make, noise, splitting, three));
}

void tst_rareRates::whatCannotTellItsStateIsEmpty()
{
    class Mute final : public Detector
    {
    public:
        void update(std::span<const float> y, std::span<float> statistic) override
        {
            std::copy(y.begin(), y.end(), statistic.begin());
        }
        void forget(const Grid &, const CellBox &) override {}
    };
    QVERIFY(
        measureRareRates([] { return std::make_unique<Mute>(); }, [] { return independentNoise(4); }, {}).isEmpty());
}

// Three large cells in four frames make its excursions; whoever has them is everybody's ancestor two levels on.
void tst_rareRates::aShortWindowIsEmpty()
{
    const auto noise = [] { return spectralNoise({}, 32); };
    const Grid grid{{{"f", "Hz", 0.0, 1.0, noise()->cells(), true}}};
    QVERIFY(measureRareRates([&] { return std::make_unique<PofN>(grid, PofNSettings{}, 2.0); }, noise, {}).isEmpty());
}

QTEST_APPLESS_MAIN(tst_rareRates)
#include "tst_rareRates.moc"

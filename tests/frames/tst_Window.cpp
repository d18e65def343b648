#include "frames/Window.h"
#include "support/test.h"

#include <cmath>
#include <numbers>

using namespace faintline;

namespace {

double energy(const std::vector<float> &window)
{
    double sum = 0.0;
    for (float w : window)
        sum += double(w) * double(w);
    return sum;
}

/// |W(Δ)|²/|W(0)|² straight from the definition; the phase is taken about the window's middle, so W is real.
double response(const std::vector<float> &window, double distanceCells)
{
    const auto length = double(window.size());
    double sum = 0.0;
    double atZero = 0.0;
    for (std::size_t n = 0; n < window.size(); ++n) {
        const double t = (double(n) + 0.5) / length - 0.5;
        sum += double(window[n]) * std::cos(2.0 * std::numbers::pi * distanceCells * t);
        atZero += double(window[n]);
    }
    return sum * sum / (atZero * atZero);
}

} // namespace

/// Sample windows: energy, symmetry, and what leaks from a line into bins beside it, by direct transform.
class tst_Window : public QObject
{
    Q_OBJECT

private slots:
    void knownValues()
    {
        // Sampled in the middle of each interval: Hann sin²(π(n + ½)/4), n = 0 … 3, is 0.1464, 0.8536, 0.8536, 0.1464; Σ w²
        // = 1.5.
        const std::vector<float> hann = sampleWindow(WindowShape::Hann, 4);
        QVERIFY(std::abs(double(hann[0]) - 0.14644661 / std::sqrt(1.5)) < 1e-7);
        QVERIFY(std::abs(double(hann[1]) - 0.85355339 / std::sqrt(1.5)) < 1e-7);
        QCOMPARE(sampleWindow(WindowShape::Rectangular, 4), (std::vector<float>{0.5f, 0.5f, 0.5f, 0.5f}));
        for (int shape = 0; shape < 6; ++shape)
            QCOMPARE(sampleWindow(static_cast<WindowShape>(shape), 1), std::vector<float>{1.0f});
    }

    void unitEnergy_data() { shapes(); }

    void unitEnergy()
    {
        QFETCH(int, shape);
        for (int length : {1, 2, 3, 16, 17, 250, 4097})
            QVERIFY(std::abs(energy(sampleWindow(static_cast<WindowShape>(shape), length)) - 1.0) < 1e-6);
    }

    void symmetric_data() { shapes(); }

    void symmetric()
    {
        QFETCH(int, shape);
        for (int length : {2, 16, 17}) {
            const std::vector<float> window = sampleWindow(static_cast<WindowShape>(shape), length);
            for (std::size_t n = 0; n < window.size(); ++n) {
                QVERIFY(window[n] > 0.0f);
                QVERIFY(std::abs(window[n] - window[window.size() - 1 - n]) < 1e-7f);
                QVERIFY(window[n] <= window[window.size() / 2] + 1e-7f);
            }
        }
    }

    void cellsAlike()
    {
        // Σ |ρ|² over all distances between cells: 1, and of Hann 1 + 2·4/9 + 2/36.
        QVERIFY(std::abs(cellLikeness(sampleWindow(WindowShape::Rectangular, 256)) - 1.0) < 1e-6);
        QVERIFY(std::abs(cellLikeness(sampleWindow(WindowShape::Hann, 256)) - 35.0 / 18.0) < 1e-6);
        QVERIFY(cellLikeness(sampleWindow(WindowShape::BlackmanHarris, 256)) > 2.5);
    }

    void mainLobe_data() { shapes(); }

    void mainLobe()
    {
        QFETCH(int, shape);
        const std::vector<float> window = sampleWindow(static_cast<WindowShape>(shape), 512);
        const double half = mainLobeHalfWidth(static_cast<WindowShape>(shape));
        QVERIFY(response(window, half) < 1e-11);
        // No zero before it: the main lobe falls all the way.
        for (double distance = 0.1; distance < 0.98 * half; distance += 0.02)
            QVERIFY(response(window, distance) < response(window, distance - 0.02));
    }

    void leakageIsBounded_data() { shapes(); }

    void leakageIsBounded()
    {
        QFETCH(int, shape);
        QFETCH(double, sideLobeDb);
        const std::vector<float> window =
            sampleWindow(static_cast<WindowShape>(shape), 2048); // long: nothing folds over
        const double half = mainLobeHalfWidth(static_cast<WindowShape>(shape));
        constexpr double singlePrecision = 1e-14; // of the window's own values
        double highest = 0.0;
        for (double distance = 0.03; distance < 60.0; distance += distance < 20.0 ? 0.07 : 0.53) {
            const double leaked = response(window, distance);
            const double bound = leakageBound(static_cast<WindowShape>(shape), distance);
            QVERIFY2(leaked <= bound * 1.01 + singlePrecision, qPrintable(QString("%1 dB at %2 cells, bound %3 dB")
                                                                              .arg(10.0 * std::log10(leaked))
                                                                              .arg(distance)
                                                                              .arg(10.0 * std::log10(bound))));
            if (distance >= half)
                highest = std::max(highest, leaked);
        }
        // Neither is the bound wasteful: the highest side lobe reaches it.
        const double boundDb = 10.0 * std::log10(leakageBound(static_cast<WindowShape>(shape), half));
        QVERIFY(std::abs(boundDb - sideLobeDb) < 0.2);
        QVERIFY(10.0 * std::log10(highest) > boundDb - 1.5);
    }

    void boundFallsWithDistance_data() { shapes(); }

    void boundFallsWithDistance()
    {
        QFETCH(int, shape);
        double before = 1.0;
        QCOMPARE(leakageBound(static_cast<WindowShape>(shape), 0.0), 1.0);
        for (double distance = 0.1; distance < 1e5; distance *= 1.03) {
            const double bound = leakageBound(static_cast<WindowShape>(shape), distance);
            QVERIFY(bound <= before);
            before = bound;
        }
        QVERIFY(before < 1e-8);
    }

    void leakageNearTheMainLobe_data() { shapes(); }

    void leakageNearTheMainLobe()
    {
        QFETCH(int, shape);
        const auto window = static_cast<WindowShape>(shape);
        const std::vector<float> samples = sampleWindow(window, 2048);
        const double end = mainLobeHalfWidth(window) + 1.0;
        for (double distance = 0.0; distance < end; distance += 0.03)
            QVERIFY(std::abs(leakageAt(window, distance) - response(samples, distance))
                    < 1e-5 * leakageBound(window, 0.0));
        QVERIFY(leakageAt(window, mainLobeHalfWidth(window)) < 1e-9);
        QCOMPARE(leakageAt(window, end + 0.01), leakageBound(window, end + 0.01));
        QCOMPARE(leakageAt(window, -0.7), leakageAt(window, 0.7));
    }

    void leakageOfHann()
    {
        for (const double distance : {0.3, 0.5, 1.5, 1.75, 1.9, 2.1, 2.5}) {
            const double pi = std::numbers::pi;
            const double transform = std::sin(pi * distance) / (pi * distance * (1.0 - distance * distance));
            QVERIFY(std::abs(leakageAt(WindowShape::Hann, distance) - transform * transform)
                    < 1e-5 * transform * transform);
        }
    }

private:
    static void shapes()
    {
        QTest::addColumn<int>("shape");
        QTest::addColumn<double>("sideLobeDb"); ///< highest, from the tables (Harris 1978)
        const double levels[] = {-13.3, -31.5, -42.7, -58.1, -92.0, -105.0};
        for (std::size_t i = 0; i < windowShapeNames.size(); ++i)
            QTest::newRow(windowShapeNames[i].data()) << int(i) << levels[i];
    }
};

FAINTLINE_TEST(tst_Window)
#include "tst_Window.moc"

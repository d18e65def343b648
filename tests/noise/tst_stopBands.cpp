#include "noise/NoiseNormaliser.h"
#include "noise/stopBands.h"
#include "support/recordings.h"
#include "support/test.h"

#include <cmath>
#include <functional>
#include <numbers>

using namespace faintline;

namespace {

/// Stop bands of a spectrum of 500 cells of 1 Hz in dB, which `of` gives at a time and a place in it (0 … 1).
std::vector<StopBand> bandsOf(const std::function<double(double, double)> &of, bool isComplex)
{
    std::vector<std::vector<double>> lnPower(40);
    for (std::size_t time = 0; time < lnPower.size(); ++time)
        for (int cell = 0; cell < 500; ++cell)
            lnPower[time].push_back(std::numbers::ln10 / 10.0 * of(double(time) / 40.0, double(cell) / 500.0));
    return stopBands({"frequency", "Hz", 0.0, 1.0, 500, false}, lnPower, isComplex);
}

double swell(double time)
{
    return 3.0 * std::sin(20.0 * time);
}

} // namespace

class tst_stopBands : public QObject
{
    Q_OBJECT

private slots:
    void findsABandThatFollowsTheRest()
    {
        const auto spectrum = [](double time, double place) { return swell(time) - (place < 0.7 ? 0.0 : 30.0); };
        const std::vector<StopBand> bands = bandsOf(spectrum, false);
        QCOMPARE(bands.size(), std::size_t(1));
        QCOMPARE(bands[0].lowHz, 349.5);
        QCOMPARE(bands[0].highHz, 499.5);
        QVERIFY(std::abs(bands[0].natsBelow - 3.0 * std::numbers::ln10) < 1e-4);
    }

    void findsBothEndsOfComplexSamples()
    {
        const auto spectrum = [](double time, double place) {
            return swell(time) - (std::abs(place - 0.5) < 0.3 ? 0.0 : 40.0);
        };
        const std::vector<StopBand> bands = bandsOf(spectrum, true);
        QCOMPARE(bands.size(), std::size_t(2));
        QCOMPARE(bands[0].lowHz, -0.5);
        QVERIFY(std::abs(bands[0].highHz - 100.0) <= 1.0 && std::abs(bands[1].lowHz - 400.0) <= 1.0);
        QCOMPARE(bandsOf(spectrum, false).size(), std::size_t(1));
    }

    void leavesOtherQuietBands_data()
    {
        using Spectrum = std::function<double(double, double)>;
        QTest::addColumn<Spectrum>("spectrum");
        QTest::newRow("white") << Spectrum([](double time, double) { return swell(time); });
        QTest::newRow("constant level") << Spectrum([](double, double place) { return place < 0.7 ? 0.0 : -30.0; });
        QTest::newRow("a level of its own") << Spectrum(
            [](double time, double place) { return place < 0.7 ? swell(time) : swell(1.0 - 0.3 * time) - 30.0; });
        QTest::newRow("rounding errors below it")
            << Spectrum([](double time, double place) { return place < 0.7 ? swell(time) : -30.0; });
        QTest::newRow("a slope") << Spectrum([](double time, double place) { return swell(time) - 60.0 * place; });
        QTest::newRow("shallow") << Spectrum(
            [](double time, double place) { return swell(time) - (place < 0.7 ? 0.0 : 15.0); });
        QTest::newRow("in the middle") << Spectrum(
            [](double time, double place) { return swell(time) - (std::abs(place - 0.5) < 0.1 ? 30.0 : 0.0); });
    }
    void leavesOtherQuietBands()
    {
        QFETCH(const std::function<double(double, double)>, spectrum);
        QVERIFY(bandsOf(spectrum, true).empty());
    }

    void isNotObservedUnlessSelected()
    {
        SpectrogramSettings settings;
        settings.windowSeconds = 0.5;
        const auto read = [&](const SelectionSettings &selection) {
            const auto spectrogram = std::make_shared<Spectrogram>(test::filteredNoise(300.0), settings, selection);
            const NormalisedSpectrogram frames(spectrogram, estimateBackground(*spectrogram, {}), {});
            std::vector<float> y(std::size_t(frames.grid().size()));
            frames.read(200, 1, y);
            const auto missing = std::ranges::count_if(y, [](float value) { return std::isnan(value); });
            return double(missing) * spectrogram->frequency().step;
        };
        const double hz = read({});
        QVERIFY2(hz > 150.0 && hz < 195.0, qPrintable(QString::number(hz)));
        SelectionSettings above; // the pass band ends at 300 Hz
        above.lowHz = 320.0;
        above.highHz = 500.0;
        QCOMPARE(read(above), 0.0);
    }

    void needsEnoughSamples()
    {
        SpectrogramSettings settings;
        settings.windowSeconds = 0.1;
        SelectionSettings half;
        half.toSeconds = 0.5; // shorter than one of its spectra
        QVERIFY(stopBands(Spectrogram(test::filteredNoise(300.0), settings, half)).empty());
    }

    void cellsLieWithinTheBand()
    {
        const Axis axis{"frequency", "Hz", -10.0, 1.0, 21, false};
        QCOMPARE(cellsIn({3.5, 10.5, 0.0}, axis), (std::pair<Index, Index>(14, 21)));
        QCOMPARE(cellsIn({-10.5, -4.0, 0.0}, axis), (std::pair<Index, Index>(0, 7)));
    }
};

FAINTLINE_TEST(tst_stopBands)
#include "tst_stopBands.moc"

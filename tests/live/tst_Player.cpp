#include "live/Player.h"
#include "live/sources/SoundSource.h"
#include "support/test.h"

#include "signal/BandRecording.h"
#include "support/PulseServer.h"
#include "support/recordings.h"

#include <cstring>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr double deviceRate = 48'000.0;
constexpr double fullTone = 0.14142135623730950; ///< amplitude of a tone at the level that is played

using Phase = std::function<double(double seconds)>; // cycles

/// Tones of amplitude 0.3, real or complex.
std::shared_ptr<MemoryRecording> tones(const std::vector<Phase> &phases, double rate, double seconds, bool isComplex)
{
    std::vector<float> samples;
    for (Index n = 0; double(n) < seconds * rate; ++n) {
        std::complex<double> sum = 0.0;
        for (const Phase &phase : phases)
            sum += std::polar(0.3, 2.0 * std::numbers::pi * phase(double(n) / rate));
        samples.push_back(float(sum.real()));
        if (isComplex)
            samples.push_back(float(sum.imag()));
    }
    return std::make_shared<MemoryRecording>(std::move(samples), rate, isComplex);
}

Phase steady(double hz)
{
    return [hz](double seconds) { return hz * seconds; };
}

std::vector<float> played(const PlayedSound &sound, Index first, Index count)
{
    std::vector<float> samples(static_cast<std::size_t>(count));
    sound.render(first, samples);
    return samples;
}

/// Amplitude of a tone in a second and a bit of what is played.
double amplitudeAt(std::span<const float> samples, double hz)
{
    return 2.0 * std::abs(fourier(samples.data(), std::ssize(samples), false, hz / deviceRate))
           / double(samples.size());
}

} // namespace

/// What a sound device gets is what is to be heard, at the frequency and speed that were asked for.
class tst_Player : public QObject
{
    Q_OBJECT

private slots:
    void tonesKeepTheirShape_data()
    {
        QTest::addColumn<double>("rate");
        QTest::addColumn<double>("hz");
        QTest::addColumn<double>("speed");
        QTest::newRow("the device's rate") << 48'000.0 << 1000.0 << 1.0;
        QTest::newRow("a lower rate") << 11'025.0 << 4200.0 << 1.0;
        QTest::newRow("a higher rate") << 250'000.0 << 12'345.0 << 1.0;
        QTest::newRow("half as fast") << 8000.0 << 1000.0 << 0.5;
        QTest::newRow("four times as fast") << 44'100.0 << 440.0 << 4.0;
    }

    // Against the closed form, sample by sample; rendering in pieces gives the same.
    void tonesKeepTheirShape()
    {
        QFETCH(double, rate);
        QFETCH(double, hz);
        QFETCH(double, speed);
        const auto recording = tones({steady(hz)}, rate, 10.0, false);
        const PlayedSound sound(recording, 0, {1.0, 9.0, speed, false, 0.0}, deviceRate);
        QCOMPARE(sound.length(), Index(std::ceil(8.0 / speed * deviceRate)));
        const std::vector<float> whole = played(sound, 10'000, 20'000);
        double largest = 0.0;
        for (Index n = 0; n < std::ssize(whole); ++n) {
            const double seconds = 1.0 + double(10'000 + n) * speed / deviceRate;
            const double expected = fullTone * std::cos(2.0 * std::numbers::pi * hz * seconds);
            largest = std::max(largest, std::abs(double(whole[std::size_t(n)]) - expected));
            QVERIFY(std::abs(sound.secondsAt(10'000 + n) - seconds) < 1e-9);
        }
        QVERIFY2(largest < 0.02 * fullTone, qPrintable(QString::number(largest / fullTone)));
        std::vector<float> pieces = played(sound, 10'000, 777);
        const std::vector<float> rest = played(sound, 10'777, 19'223);
        pieces.insert(pieces.end(), rest.begin(), rest.end());
        QVERIFY(largestDifference(pieces, whole) < 1e-6);
        QVERIFY(played(sound, sound.length(), 100) == std::vector<float>(100));
    }

    void bandAlone()
    {
        for (const bool isComplex : {false, true}) {
            const auto both = tones({steady(1000.0), steady(3000.0)}, 16'000.0, 8.0, isComplex);
            const auto band = std::make_shared<BandRecording>(both, 0, 800.0, 1200.0);
            const std::vector<float> samples =
                played(PlayedSound(band, 0, {1.0, 7.0, 1.0, false, 0.0}, deviceRate), 0, 96'000);
            QVERIFY(std::abs(amplitudeAt(samples, 1000.0) / fullTone - 1.0) < 0.01);
            QVERIFY(amplitudeAt(samples, 3000.0) < 1e-4 * fullTone);
        }
        // The real part of a band that holds all is the recording.
        const auto noise = std::make_shared<MemoryRecording>(someNoise(30'000), 8000.0);
        const std::vector<float> all = readInPieces(BandRecording(noise, 0, -1.0, 1e6), 5000);
        QVERIFY(largestDifference(every(all, 2, 0), readAll(*noise)) < 1e-5);
    }

    void lineStaysAtItsTone_data()
    {
        QTest::addColumn<double>("rate");
        QTest::addColumn<double>("hz");
        QTest::addColumn<double>("drift");
        QTest::addColumn<double>("speed");
        QTest::addColumn<bool>("isComplex");
        QTest::newRow("a steady line") << 48'000.0 << 5000.0 << 0.0 << 1.0 << false;
        QTest::newRow("one that drifts") << 48'000.0 << 5000.0 << 20.0 << 1.0 << false;
        QTest::newRow("twice as fast") << 48'000.0 << 5000.0 << 20.0 << 2.0 << false;
        QTest::newRow("below the tone") << 2000.0 << 40.0 << -1.0 << 1.0 << false;
        QTest::newRow("negative frequencies") << 250'000.0 << -60'000.0 << 100.0 << 1.0 << true;
        QTest::newRow("a slow recording") << 50.0 << 3.0 << 0.1 << 1.0 << true;
    }

    // At 700 Hz to a tenth of a Hz for four seconds of sound, whatever it does in the recording.
    void lineStaysAtItsTone()
    {
        QFETCH(double, rate);
        QFETCH(double, hz);
        QFETCH(double, drift);
        QFETCH(double, speed);
        QFETCH(bool, isComplex);
        constexpr double seconds = 12.0;
        const auto recording =
            tones({[=](double t) { return hz * t + 0.5 * drift * t * t; }}, rate, seconds, isComplex);
        const FrequencyCurve line({"time", "s", 0.0, seconds, 2}, {hz, hz + drift * seconds});
        const PlayedSound sound(lineToPlay(recording, 0, line), 0, {2.0, 10.0, speed, false, 700.0}, deviceRate);
        const std::vector<float> samples = played(sound, 0, 4 * 48'000);
        QVERIFY2(std::abs(amplitudeAt(samples, 700.0) / fullTone - 1.0) < 0.02,
                 qPrintable(QString::number(amplitudeAt(samples, 700.0) / fullTone)));
    }

    // Nothing is played that is not there yet; what has run away is left out but for half a second; the level is that
    // before.
    void waitsForWhatIsBeingMade()
    {
        double end = 12.0;
        PlaySettings settings{10.0, 1e9};
        settings.endSeconds = [&end] { return end; };
        const PlayedSound sound(tones({steady(1000.0)}, 8000.0, 30.0, false), 0, settings, deviceRate);
        QVERIFY(sound.isThere(Index(1.99 * deviceRate)));
        QVERIFY(!sound.isThere(Index(2.0 * deviceRate))); // which is made from what lies behind it, too
        end = 12.5;
        QVERIFY(sound.isThere(Index(2.0 * deviceRate)));
        QCOMPARE(sound.behindBy(0), Index(2.0 * deviceRate));
        QCOMPARE(sound.behindBy(Index(1.0 * deviceRate)), Index(0));
        const std::vector<float> samples = played(sound, 0, 96'000);
        QVERIFY(std::abs(amplitudeAt(samples, 1000.0) / fullTone - 1.0) < 0.01);
    }

    void loops()
    {
        const auto recording = std::make_shared<MemoryRecording>(someNoise(48'000), deviceRate);
        const PlayedSound once(recording, 0, {0.25, 0.5, 1.0, false, 0.0}, deviceRate);
        const PlayedSound again(recording, 0, {0.25, 0.5, 1.0, true, 0.0}, deviceRate);
        const std::vector<float> pass = played(once, 0, 12'000);
        const std::vector<float> looped = played(again, 9'000, 12'000);
        QVERIFY(std::equal(pass.begin() + 9'000, pass.end(), looped.begin()));
        QVERIFY(std::equal(pass.begin(), pass.begin() + 9'000, looped.begin() + 3'000));
        QCOMPARE(again.secondsAt(12'000 + 4'800), 0.35);
        QCOMPARE(once.secondsAt(12'000 + 4'800), 0.5);
    }

    void silenceIsSilent()
    {
        const auto recording = std::make_shared<MemoryRecording>(std::vector<float>(8000), 8000.0);
        const PlayedSound sound(recording, 0, {0.0, 1.0, 1.0, false, 0.0}, deviceRate);
        QVERIFY(played(sound, 0, 48'000) == std::vector<float>(48'000));
    }

    void withoutDevice()
    {
        qputenv("PULSE_SERVER", "unix:/nonexistent");
        if (!soundDevices().empty())
            QSKIP("this machine has a sound card");
        const auto recording = tones({steady(100.0)}, 8000.0, 1.0, false);
        QVERIFY(contains(errorOf([&] {
                             Player(recording, 0, {0.0, 1.0}, "default", "Play");
                         }),
                         "Play: this machine has no sound output"));
    }

    // The tone is measured where the sound comes out.
    void isHeard()
    {
        const PulseServer server;
        if (!server.whyNot().isEmpty())
            QSKIP(qPrintable(server.whyNot()));
        SoundSource ear({"default", {}, 0.0, 0});
        std::vector<float> heard;
        const auto hear = [&] {
            const Heard some = ear.hear(std::chrono::milliseconds(50));
            const std::size_t before = heard.size();
            heard.resize(before + some.bytes.size() / sizeof(float));
            if (!some.bytes.empty())
                std::memcpy(heard.data() + before, some.bytes.data(), some.bytes.size());
        };
        const auto recording = tones({steady(5000.0)}, 22'050.0, 10.0, false);
        const FrequencyCurve line({"time", "s", 0.0, 10.0, 2}, {5000.0, 5000.0});
        while (heard.empty())
            hear();
        heard.clear();
        QElapsedTimer timer;
        timer.start();
        const Player player(lineToPlay(recording, 0, line), 0, {2.0, 5.0, 1.0, false, 700.0}, "default", "test");
        double last = 2.0;
        while (!player.isOver() && timer.elapsed() < 20'000) {
            hear();
            const double position = player.positionSeconds();
            QVERIFY(position >= last && position <= 5.0 && position - 2.0 < 0.3 + double(timer.elapsed()) / 1000.0);
            last = position;
            QVERIFY(!player.failure());
        }
        QVERIFY(player.isOver());
        QCOMPARE(player.positionSeconds(), 5.0);
        for (int i = 0; i < 10; ++i)
            hear();
        const auto begin = std::find_if(heard.begin(), heard.end(), [](float x) { return x != 0.0f; });
        const auto end = std::find_if(heard.rbegin(), heard.rend(), [](float x) { return x != 0.0f; }).base();
        QVERIFY2(std::abs(double(end - begin) / deviceRate - 3.0) < 0.5, qPrintable(QString::number(end - begin)));
        double largest = 0.0;
        for (auto second = begin; end - second >= 24'000; second += 24'000) { // a break would change the phase
            const std::span<const float> half(second, 24'000);
            largest = std::max(largest, amplitudeAt(half, 700.0));
            QVERIFY(amplitudeAt(half, 5000.0) < 1e-3);
        }
        QVERIFY2(std::abs(largest / fullTone - 1.0) < 0.02, qPrintable(QString::number(largest)));
    }
};

FAINTLINE_TEST(tst_Player)
#include "tst_Player.moc"

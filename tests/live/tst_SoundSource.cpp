#include "live/sources/SoundSource.h"
#include "support/test.h"

#include "support/PulseServer.h"
#include "support/recordings.h"

#include <cstring>
#include <numeric>
#include <thread>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr std::chrono::milliseconds patience{50};

/// Counts, so that each sample says where it belongs.
std::vector<std::int32_t> counted(std::int32_t first, std::int32_t count)
{
    std::vector<std::int32_t> samples(static_cast<std::size_t>(count));
    std::iota(samples.begin(), samples.end(), first);
    return samples;
}

/// Whether every sample stands where it says, gaps included; adds what was heard and what was lost.
bool isInPlace(const Heard &heard, Index &position, Index &lost)
{
    position += heard.lostSamples;
    lost += heard.lostSamples;
    for (std::size_t at = 0; at < heard.bytes.size(); at += sizeof(std::int32_t)) {
        std::int32_t value = 0;
        std::memcpy(&value, heard.bytes.data() + at, sizeof value);
        if (value != position++)
            return false;
    }
    return true;
}

std::vector<float> floatsOf(const std::vector<std::byte> &bytes)
{
    std::vector<float> values(bytes.size() / sizeof(float));
    if (!values.empty())
        std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
    return values;
}

} // namespace

/// What a sound device gives arrives as it was, and what is lost is known at its place.
class tst_SoundSource : public QObject
{
    Q_OBJECT

private slots:
    // A thousand of them, of the device's own and for want of room.
    void lossesArePlacedToTheSample()
    {
        Random random(1, 2);
        SoundIntake intake(sizeof(std::int32_t), 4000);
        std::int32_t next = 0;
        Index position = 0;
        Index lost = 0;
        int losses = 0;
        while (losses < 1000) {
            const int blocks = int(random.uniform() * 20.0);
            for (int i = 0; i < blocks; ++i) {
                const auto missing = random.uniform() < 0.1 ? std::int32_t(1.0 + random.uniform() * 500.0) : 0;
                const std::vector<std::int32_t> block = counted(next + missing, 96);
                next += missing + 96;
                intake.put(std::as_bytes(std::span(block)), missing);
            }
            for (int i = 0; i < 2; ++i) {
                const Heard heard = intake.take(std::chrono::milliseconds(0));
                losses += heard.lostSamples > 0;
                QVERIFY(isInPlace(heard, position, lost));
            }
        }
        while (true) { // the rest
            const Heard heard = intake.take(std::chrono::milliseconds(0));
            QVERIFY(isInPlace(heard, position, lost));
            if (heard.bytes.empty() && heard.lostSamples == 0)
                break;
        }
        QVERIFY(lost > 10'000);
        QCOMPARE(position, Index(next));
    }

    void aThreadThatIsTooSlow()
    {
        constexpr std::int32_t total = 480'000;
        SoundIntake intake(sizeof(std::int32_t), 40'000);
        std::jthread device([&] {
            for (std::int32_t next = 0; next < total; next += 480) {
                const std::vector<std::int32_t> block = counted(next, 480);
                intake.put(std::as_bytes(std::span(block)));
                std::this_thread::sleep_for(std::chrono::microseconds(100));
            }
        });
        Index position = 0;
        Index lost = 0;
        while (true) {
            const Heard heard = intake.take(std::chrono::milliseconds(500));
            QVERIFY(isInPlace(heard, position, lost));
            if (heard.bytes.empty() && heard.lostSamples == 0)
                break;
            std::this_thread::sleep_for(std::chrono::milliseconds(15));
        }
        QVERIFY2(lost > 0, "nothing was lost");
        QCOMPARE(position, Index(total));
    }

    void devicesByName()
    {
        using System = SoundDevice::System;
        const std::vector<SoundDevice> devices{{System::PulseAudio, "Speaker", 0, 2, 48000.0, false, true},
                                               {System::PulseAudio, "Line In", 2, 0, 96000.0, false, false},
                                               {System::PulseAudio, "Line In (front)", 1, 0, 44100.0, true, false},
                                               {System::Alsa, "hw:Loopback", 2, 2, 48000.0, false, false}};
        const auto found = [&](const char *name, SoundDirection direction = SoundDirection::In) {
            return findSoundDevice(devices, name, direction, "--device").name;
        };
        QCOMPARE(found("default"), std::string("Line In (front)"));
        QCOMPARE(found("default", SoundDirection::Out), std::string("Speaker"));
        QCOMPARE(found("Line In"), std::string("Line In")); // all of it, though it is a part of another
        QCOMPARE(found("LOOPBACK"), std::string("hw:Loopback"));
        QVERIFY(
            contains(errorOf([&] { found("line"); }), "fits more than one sound device; there are: Line In, Line In"));
        QVERIFY(contains(errorOf([&] { found("Speaker"); }), "no such sound device"));
        QVERIFY(contains(errorOf([] { findSoundDevice({}, "default", SoundDirection::Out, "play"); }),
                         "play: this machine has no sound output: no sound server"));
    }

    void withoutSoundServer()
    {
        qputenv("PULSE_SERVER", "unix:/nonexistent");
        if (!soundDevices().empty())
            QSKIP("this machine has a sound card");
        QVERIFY(contains(errorOf([] { SoundSource source(SoundSettings{}); }),
                         "--device default: this machine has no sound input"));
    }

    // The samples themselves: a null sink of floats changes none.
    void hearsWhatIsPlayed()
    {
        const PulseServer server;
        if (!server.whyNot().isEmpty())
            QSKIP(qPrintable(server.whyNot()));
        const std::vector<float> played = someNoise(3 * 48'000);
        QTemporaryDir folder;
        const QString file = folder.filePath(QStringLiteral("noise.raw"));
        writeBytes(file.toStdString(), {reinterpret_cast<const char *>(played.data()), std::ssize(played) * 4});
        SoundSource source({"of nothing", {}, 0.0, 0});
        QCOMPARE(source.format().sampleRateHz, 48000.0);
        QCOMPARE(source.format().channelCount, 1);
        QProcess player;
        player.start("pacat", {"--playback", "--raw", "--format=float32le", "--rate=48000", "--channels=1", file});
        std::vector<float> heard;
        while (std::ssize(heard) < 6 * 48'000) {
            const Heard some = source.hear(patience);
            QCOMPARE(some.lostSamples, Index(0));
            const std::vector<float> values = floatsOf(some.bytes);
            heard.insert(heard.end(), values.begin(), values.end());
        }
        player.waitForFinished();
        // A player that begins may be late with its first block; after that the stream is whole.
        const auto from = played.begin() + 24'000;
        const auto found = std::search(heard.begin(), heard.end(), from, from + 1000);
        QVERIFY2(found != heard.end(), "what was played was not heard");
        QVERIFY(std::equal(from, played.end(), found));
    }

    void deviceThatComesBack_data()
    {
        QTest::addColumn<bool>("isWholeServer");
        QTest::newRow("the device") << false;
        QTest::newRow("the sound server") << true;
    }

    void deviceThatComesBack()
    {
        QFETCH(bool, isWholeServer);
        PulseServer server;
        if (!server.whyNot().isEmpty())
            QSKIP(qPrintable(server.whyNot()));
        SoundSource source({"default", parseSampleType("ri16_le", "test"), 8000.0, 1});
        Index samples = 0;
        Index lost = 0;
        std::vector<Heard::Incident> incidents;
        QElapsedTimer timer;
        const auto hear = [&](const auto &isEnough) {
            for (QElapsedTimer limit; !isEnough();) {
                if (!limit.isValid())
                    limit.start();
                if (limit.elapsed() > 20'000)
                    return false;
                const Heard heard = source.hear(patience);
                if (samples == 0 && !heard.bytes.empty())
                    timer.start();
                samples += std::ssize(heard.bytes) / 2;
                lost += heard.lostSamples;
                if (heard.incident != Heard::Incident::None)
                    incidents.push_back(heard.incident);
                if (heard.incident == Heard::Incident::Gone && !contains(heard.words, "is gone: audio read error"))
                    return false;
            }
            return true;
        };
        QVERIFY(hear([&] { return samples > 4000; }));
        isWholeServer ? server.stop() : server.unplug();
        QVERIFY(hear([&] { return incidents.size() == 1; }));
        isWholeServer ? server.start() : void(server.plug());
        const Index before = samples;
        QVERIFY(hear([&] { return samples > before + 8000; }));
        QCOMPARE(incidents, (std::vector{Heard::Incident::Gone, Heard::Incident::Back}));
        const double seconds = double(samples + lost) / 8000.0;
        QVERIFY2(lost > 0 && std::abs(seconds - double(timer.elapsed()) / 1000.0) < 0.3,
                 qPrintable(QStringLiteral("%1 s in %2 ms").arg(seconds).arg(timer.elapsed())));
    }
};

FAINTLINE_TEST(tst_SoundSource)
#include "tst_SoundSource.moc"

#include "live/StreamBuffer.h"
#include "support/test.h"

#include "base/Random.h"

#include <atomic>
#include <cstring>
#include <thread>

using namespace faintline;
using namespace std::chrono_literals;

namespace {

constexpr SampleType shorts{false, SampleType::Number::Signed, 2, false};

StreamFormat stereo()
{
    return {shorts, 1000.0, 2, 0.0, "test"};
}

std::vector<std::byte> bytesOf(const std::vector<std::int16_t> &numbers)
{
    std::vector<std::byte> bytes(2 * numbers.size());
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
}

} // namespace

/// Received samples in their places in time, against a plain array that holds all of them.
class tst_StreamBuffer : public QObject
{
    Q_OBJECT

private slots:
    void readsLikeAnArrayWithZerosInGaps()
    {
        Random random(11, 1);
        StreamBuffer buffer(stereo(), 1 << 22);
        std::vector<std::vector<float>> all(2); // of each channel
        std::vector<bool> isHeard;
        for (int piece = 0; piece < 60; ++piece) {
            const auto count = Index(1 + std::floor(random.uniform() * 3000.0));
            if (random.uniform() < 0.2) {
                buffer.pushGap(count);
                isHeard.insert(isHeard.end(), std::size_t(count), false);
                for (std::vector<float> &channel : all)
                    channel.insert(channel.end(), std::size_t(count), 0.0f);
                continue;
            }
            std::vector<std::int16_t> numbers;
            for (Index i = 0; i < count; ++i)
                for (std::vector<float> &channel : all) {
                    numbers.push_back(std::int16_t(std::floor(random.uniform() * 60000.0) - 30000.0));
                    channel.push_back(float(numbers.back()) / 32768.0f);
                }
            isHeard.insert(isHeard.end(), std::size_t(count), true);
            buffer.push(bytesOf(numbers));
        }
        QCOMPARE(buffer.length(), std::ssize(isHeard));
        for (int trial = 0; trial < 300; ++trial) {
            const auto first = Index(random.uniform() * double(isHeard.size() - 1));
            const Index count = std::min(Index(1 + random.uniform() * 4000.0), std::ssize(isHeard) - first);
            const int channel = trial % 2;
            std::vector<float> out(std::size_t(count), -9.0f);
            buffer.read(channel, first, count, out);
            const auto from = all[std::size_t(channel)].begin() + first;
            QVERIFY2(std::equal(out.begin(), out.end(), from), qPrintable(QString::number(first)));
            const auto heard = isHeard.begin() + first;
            QCOMPARE(buffer.isWhole(first, count), std::all_of(heard, heard + count, [](bool is) { return is; }));
        }
    }

    void whatIsReleasedMakesRoom()
    {
        StreamBuffer buffer(stereo(), 400); // a hundred samples of two channels
        QVERIFY(buffer.hasRoom(400, 0ms));
        QVERIFY(!buffer.hasRoom(401, 0ms));
        buffer.push(bytesOf(std::vector<std::int16_t>(80, 1)));  // 40 samples
        buffer.pushGap(1000);                                    // takes no room
        buffer.push(bytesOf(std::vector<std::int16_t>(120, 2))); // 60 samples
        QVERIFY(!buffer.hasRoom(1, 0ms));
        buffer.release(39); // the first piece is needed up to its last sample
        QVERIFY(!buffer.hasRoom(1, 0ms));
        buffer.release(40);
        QVERIFY(buffer.hasRoom(160, 0ms));
        QVERIFY(!buffer.hasRoom(161, 0ms));
        buffer.widen(500);
        QVERIFY(buffer.hasRoom(260, 0ms));
        buffer.widen(10); // never narrower
        QVERIFY(buffer.hasRoom(260, 0ms));
        std::vector<float> out(60);
        buffer.read(0, 1040, 60, out);
        QCOMPARE(out, std::vector<float>(60, 2.0f / 32768.0f));
    }

    void theReaderWaitsForThePosition()
    {
        StreamBuffer buffer(stereo(), 1 << 16);
        std::atomic<bool> isSent = false;
        std::jthread sender([&] {
            std::this_thread::sleep_for(20ms);
            buffer.push(bytesOf(std::vector<std::int16_t>(20, 1)));
            isSent = true;
            buffer.pushGap(5); // what is known to be lost counts
            std::this_thread::sleep_for(20ms);
            buffer.end();
        });
        QVERIFY(buffer.waitFor(15));
        QVERIFY(isSent);
        QVERIFY(!buffer.waitFor(16)); // it never comes
        QVERIFY(buffer.isEnded());
        QCOMPARE(buffer.length(), Index(15));
    }

    void aStopEndsTheWaiting()
    {
        StreamBuffer buffer(stereo(), 1 << 16);
        std::stop_source stop;
        std::jthread stopper([&] {
            std::this_thread::sleep_for(20ms);
            stop.request_stop();
        });
        QVERIFY(!buffer.waitFor(1, stop.get_token()));
        QVERIFY(!buffer.isEnded());
    }

    void theTimeOfASampleIsCountedBackAtTheRate()
    {
        StreamBuffer buffer(stereo(), 1 << 16);
        const auto before = std::chrono::steady_clock::now();
        buffer.push(bytesOf(std::vector<std::int16_t>(2000, 1))); // 1000 samples: a second
        const auto after = std::chrono::steady_clock::now();
        const auto last = buffer.heardAt(1000);
        QVERIFY(last >= before && last <= after);
        QCOMPARE(last - buffer.heardAt(500), std::chrono::steady_clock::duration(500ms));
    }
};

FAINTLINE_TEST(tst_StreamBuffer)
#include "tst_StreamBuffer.moc"

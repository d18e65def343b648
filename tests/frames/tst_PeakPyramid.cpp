#include "frames/PeakPyramid.h"
#include "support/test.h"

#include "base/Random.h"
#include "base/memoryShares.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace faintline;

namespace {

Axis timeOf(Index frames)
{
    return {"time", "s", 0.5, 0.25, frames, false};
}

/// Scores in quarters of a nat, so that bytes hold them exactly.
std::vector<float> someScores(Index frames, Index cells, std::uint64_t stream)
{
    Random random(7, stream);
    std::vector<float> values(std::size_t(frames * cells));
    for (float &value : values)
        value = float(std::floor(random.uniform() * 180.0) / 4.0 - 3.0);
    return values;
}

PeakPyramid built(const std::vector<float> &values, Index frames, Index cells,
                  std::size_t budget = std::size_t(1) << 20)
{
    PeakPyramid pyramid(timeOf(frames), cells, ByteScale(ByteScale::Kind::ScoreNats), budget);
    pyramid.append(values);
    pyramid.finish();
    return pyramid;
}

/// Checks every row of every level against the plain maximum of the frames it stands for.
bool hasTheMaxima(const PeakPyramid &pyramid, const std::vector<float> &values, Index frames, Index cells)
{
    for (int level = 0; level < pyramid.levelCount(); ++level) {
        const Index perRow = pyramid.framesPerRow(level);
        if (pyramid.rowCount(level) != (frames + perRow - 1) / perRow)
            return false;
        for (Index row = 0; row < pyramid.rowCount(level); ++row)
            for (Index cell = 0; cell < cells; ++cell) {
                float largest = -INFINITY;
                for (Index frame = row * perRow; frame < std::min(frames, (row + 1) * perRow); ++frame)
                    largest = std::max(largest, values[std::size_t(frame * cells + cell)]);
                const std::uint8_t byte = pyramid.row(level, row)[std::size_t(cell)];
                if (pyramid.scale().value(byte) != double(largest))
                    return false;
            }
    }
    return true;
}

} // namespace

/// A picture that keeps its maxima at every zoom, and its scale of bytes.
class tst_PeakPyramid : public QObject
{
    Q_OBJECT

private slots:
    void everyByteReadsBack_data()
    {
        QTest::addColumn<int>("kind");
        QTest::newRow("dB") << int(ByteScale::Kind::PowerDb);
        QTest::newRow("nat") << int(ByteScale::Kind::ScoreNats);
    }

    void everyByteReadsBack()
    {
        QFETCH(int, kind);
        const ByteScale scale(static_cast<ByteScale::Kind>(kind));
        for (int byte = 0; byte < 256; ++byte) {
            QCOMPARE(int(scale.byte(scale.value(byte))), byte);
            if (byte > 0)
                QVERIFY(scale.value(byte) > scale.value(byte - 1));
        }
    }

    void byteIsTheNearest_data()
    {
        QTest::addColumn<int>("kind");
        QTest::addColumn<double>("value");
        QTest::addColumn<double>("shown");
        const int dB = int(ByteScale::Kind::PowerDb);
        const int nat = int(ByteScale::Kind::ScoreNats);
        QTest::newRow("0 dB") << dB << 0.0 << 0.0;
        QTest::newRow("a third of a dB") << dB << 0.33 << 0.5;
        QTest::newRow("below") << dB << -40.0 << -15.0;
        QTest::newRow("above") << dB << 300.0 << 112.5;
        QTest::newRow("0 nat") << nat << 0.0 << 0.0;
        QTest::newRow("an eighth up") << nat << 12.13 << 12.25;
        QTest::newRow("an eighth down") << nat << 12.12 << 12.0;
        QTest::newRow("below all") << nat << -100.0 << -4.0;
        QTest::newRow("one coarse step") << nat << 53.0 << 46.0 * 1.15;
        QTest::newRow("beyond") << nat << 1e9 << 46.0 * std::pow(1.15, 55);
    }

    void byteIsTheNearest()
    {
        QFETCH(int, kind);
        QFETCH(double, value);
        QFETCH(double, shown);
        const ByteScale scale(static_cast<ByteScale::Kind>(kind));
        QVERIFY(std::abs(scale.value(scale.byte(value)) - shown) < 1e-6 * std::max(1.0, shown));
    }

    void encodingIsTheScale()
    {
        // The quick way for whole frames gives the byte of the slow one, or its neighbour where the two are equally near.
        Random random(1, 1);
        for (const ByteScale::Kind kind : {ByteScale::Kind::PowerDb, ByteScale::Kind::ScoreNats}) {
            const ByteScale scale(kind);
            for (int i = 0; i < 20000; ++i) {
                const double wanted = -20.0 + 140.0 * random.uniform() * (i % 3 == 0 ? 10.0 : 1.0);
                const auto stored = float(kind == ByteScale::Kind::PowerDb ? std::pow(10.0, wanted / 10.0) : wanted);
                std::uint8_t byte = 0;
                scale.encode({&stored, 1}, {&byte, 1});
                const double nearest = std::abs(scale.value(scale.byte(wanted)) - wanted);
                QVERIFY(std::abs(std::abs(scale.value(byte) - wanted) - nearest)
                        < 2e-5 * std::max(1.0, std::abs(wanted)));
            }
        }
    }

    void differencesKeepTheirSign()
    {
        const ByteScale scale(ByteScale::Kind::DifferenceNats);
        for (int byte = 0; byte < 256; ++byte) {
            QCOMPARE(int(scale.byte(scale.value(byte))), byte == 1 ? 0 : byte);
            if (byte > 1)
                QVERIFY(std::abs(scale.value(byte)) >= std::abs(scale.value(byte - 1)));
        }
        const std::vector<int> ascending = scale.ascending();
        for (std::size_t i = 1; i < ascending.size(); ++i)
            QVERIFY(scale.value(ascending[i]) >= scale.value(ascending[i - 1]));
        QCOMPARE(scale.value(scale.byte(-7.3)), -7.25);
        QCOMPARE(scale.value(scale.byte(0.1)), 0.0);
        QCOMPARE(scale.value(scale.byte(-0.1)), 0.0);
        QCOMPARE(scale.value(scale.byte(NAN)), 0.0);
        QVERIFY(scale.value(scale.byte(1e9)) > 8e4 && scale.value(scale.byte(-1e9)) < -8e4);

        // The larger magnitude wins, of equal ones the positive.
        PeakPyramid pyramid(timeOf(4), 3, scale, std::size_t(1) << 20);
        pyramid.append(std::vector<float>{1.0f, -3.0f, 0.0f, -2.0f, 3.0f, 0.0f, 0.5f, -3.0f, -0.25f, 0.0f, 2.0f, 0.0f});
        pyramid.finish();
        const auto top = pyramid.row(1, 0);
        QCOMPARE(scale.value(top[0]), -2.0);
        QCOMPARE(scale.value(top[1]), 3.0);
        QCOMPARE(scale.value(top[2]), -0.25);
    }

    void whatWasNotObservedIsDark()
    {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const std::vector<float> values{nan, 1.0f, -nan, std::numeric_limits<float>::infinity(), 0.0f};
        std::vector<std::uint8_t> bytes(values.size());
        ByteScale(ByteScale::Kind::PowerDb).encode(values, bytes);
        QCOMPARE(bytes, (std::vector<std::uint8_t>{0, 30, 0, 255, 0}));
        ByteScale(ByteScale::Kind::ScoreNats).encode(values, bytes);
        QCOMPARE(bytes[0], std::uint8_t(0));
    }

    void strangeValues()
    {
        const std::vector<float> values{0.0f, -INFINITY, INFINITY};
        std::vector<std::uint8_t> bytes(3);
        ByteScale(ByteScale::Kind::PowerDb).encode(values, bytes);
        QCOMPARE(int(bytes[0]), 0);
        QCOMPARE(int(bytes[2]), 255);
        ByteScale(ByteScale::Kind::ScoreNats).encode(values, bytes);
        QCOMPARE(int(bytes[0]), 16);
        QCOMPARE(int(bytes[1]), 0);
        QCOMPARE(int(bytes[2]), 255);
        QCOMPARE(int(ByteScale(ByteScale::Kind::ScoreNats).byte(NAN)), 0);
    }

    void nineFramesByEye()
    {
        // Two cells; the right one peaks in frame 6.
        const std::vector<float> values{0, 1, 1, 1, 2, 1, 3, 1, 4, 1, 5, 1, 6, 9, 7, 1, 8, 1};
        const PeakPyramid pyramid = built(values, 9, 2);
        QCOMPARE(pyramid.frameCount(), Index(9));
        QCOMPARE(pyramid.levelCount(), 3);
        const auto shown = [&](int level, Index row) {
            const auto bytes = pyramid.row(level, row);
            return std::pair(pyramid.scale().value(bytes[0]), pyramid.scale().value(bytes[1]));
        };
        QCOMPARE(pyramid.rowCount(0), Index(9));
        QCOMPARE(shown(0, 6), std::pair(6.0, 9.0));
        QCOMPARE(pyramid.rowCount(1), Index(3));
        QCOMPARE(shown(1, 0), std::pair(3.0, 1.0));
        QCOMPARE(shown(1, 1), std::pair(7.0, 9.0));
        QCOMPARE(shown(1, 2), std::pair(8.0, 1.0));
        QCOMPARE(pyramid.rowCount(2), Index(1));
        QCOMPARE(shown(2, 0), std::pair(8.0, 9.0));
    }

    void maximaOfEveryLevel_data()
    {
        QTest::addColumn<int>("frames");
        QTest::addColumn<int>("cells");
        for (int frames : {1, 2, 3, 4, 5, 15, 16, 17, 63, 64, 65, 255, 256, 257, 1000})
            QTest::addRow("%d frames", frames) << frames << 3;
        QTest::newRow("one cell") << 77 << 1;
        QTest::newRow("many cells") << 21 << 301;
    }

    void maximaOfEveryLevel()
    {
        QFETCH(int, frames);
        QFETCH(int, cells);
        const std::vector<float> values = someScores(frames, cells, 1);
        const PeakPyramid pyramid = built(values, frames, cells);
        QCOMPARE(pyramid.framesPerRow(0), Index(1));
        QVERIFY(hasTheMaxima(pyramid, values, frames, cells));
        QCOMPARE(pyramid.rowCount(pyramid.levelCount() - 1), Index(1)); // the top is the whole recording
    }

    void piecesMakeTheSamePyramid()
    {
        const std::vector<float> values = someScores(100, 5, 2);
        const PeakPyramid whole = built(values, 100, 5);
        PeakPyramid pieces(timeOf(100), 5, ByteScale(ByteScale::Kind::ScoreNats));
        for (std::size_t first = 0, count = 1; first < 100;
             first += count, count = std::min<std::size_t>(count + 3, 100 - first))
            pieces.append(std::span(values).subspan(5 * first, 5 * count));
        pieces.finish();
        QCOMPARE(pieces.levelCount(), whole.levelCount());
        for (int level = 0; level < whole.levelCount(); ++level)
            for (Index row = 0; row < whole.rowCount(level); ++row)
                QVERIFY(std::ranges::equal(pieces.row(level, row), whole.row(level, row)));
    }

    void budgetKeepsMaximaAndGeometry_data()
    {
        QTest::addColumn<int>("frames");
        QTest::addColumn<int>("budget");
        for (int frames : {60, 61, 63, 64, 250, 1000, 1023, 4099})
            for (int budget : {50, 300, 1000})
                QTest::addRow("%d frames, %d bytes", frames, budget) << frames << budget;
    }

    void budgetKeepsMaximaAndGeometry()
    {
        QFETCH(int, frames);
        QFETCH(int, budget);
        const std::vector<float> values = someScores(frames, 3, 3);
        const PeakPyramid pyramid = built(values, frames, 3, std::size_t(budget));
        QCOMPARE(pyramid.frameCount(), Index(frames));
        QCOMPARE(pyramid.time().count, Index(frames));
        QVERIFY(hasTheMaxima(pyramid, values, frames, 3));
        Index bytes = 0;
        for (int level = 0; level < pyramid.levelCount(); ++level) {
            bytes += pyramid.rowCount(level) * 3;
            if (level > 0)
                QCOMPARE(pyramid.framesPerRow(level), 4 * pyramid.framesPerRow(level - 1));
        }
        QVERIFY(bytes <= budget + 3 * (pyramid.levelCount() + 1)); // the last rows close after the budget was kept
        if (frames * 3 * 5 / 4 < budget)
            QCOMPARE(pyramid.framesPerRow(0), Index(1)); // nothing is merged without need
    }

    void soFarIsAPictureOfItsOwn()
    {
        // What was taken on the way has the maxima of its frames, and keeps them while the picture goes on and is
        // coarsened.
        const Index cells = 300;
        const Index frames = 5000;
        const std::vector<float> values = someScores(frames, cells, 9);
        PeakPyramid pyramid(timeOf(frames), cells, ByteScale(ByteScale::Kind::ScoreNats), 400'000);
        std::vector<PeakPyramid> taken;
        const std::vector<Index> ends = {0, 1, 7, 873, 874, 1333, 3001, 4999, 5000};
        Index done = 0;
        for (Index end : ends) {
            pyramid.append(std::span(values).subspan(std::size_t(done * cells), std::size_t((end - done) * cells)));
            done = end;
            taken.push_back(pyramid.soFar());
        }
        pyramid.finish();
        for (std::size_t i = 0; i < ends.size(); ++i) {
            QCOMPARE(taken[i].frameCount(), ends[i]);
            const std::vector<float> seen(values.begin(), values.begin() + ends[i] * cells);
            QVERIFY(hasTheMaxima(taken[i], seen, ends[i], cells));
        }
        QVERIFY(hasTheMaxima(pyramid, values, frames, cells));
        QVERIFY(pyramid.framesPerRow(0) > taken[2].framesPerRow(0));
    }

    void roomForWhatItIsInTheEndIsEnough()
    {
        constexpr Index cells = 3;
        for (const std::size_t share : {1, 40, 100, 1000, 5000})
            for (const Index frames : {1, 7, 64, 100, 333, 1024, 1500}) {
                const Axis time{"time", "s", 0.0, 1.0, frames, false};
                const std::size_t least = memoryShares::inTheEnd(share, std::size_t(frames), cells);
                QVERIFY(least <= share);
                PeakPyramid with(time, cells, ByteScale(ByteScale::Kind::ScoreNats), share);
                PeakPyramid within(time, cells, ByteScale(ByteScale::Kind::ScoreNats), least);
                for (Index frame = 0; frame < frames; ++frame) {
                    const std::uint8_t row[cells] = {std::uint8_t(frame * 37), std::uint8_t(frame * frame),
                                                     std::uint8_t(frame / 5)};
                    with.appendBytes(row);
                    within.appendBytes(row);
                }
                with.finish();
                within.finish();
                QCOMPARE(within.levelCount(), with.levelCount());
                QCOMPARE(within.framesPerRow(0), with.framesPerRow(0));
                for (int level = 0; level < with.levelCount(); ++level) {
                    QCOMPARE(within.rowCount(level), with.rowCount(level));
                    for (Index row = 0; row < with.rowCount(level); ++row)
                        QVERIFY(std::ranges::equal(within.row(level, row), with.row(level, row)));
                }
            }
    }

    void levelForAZoom()
    {
        const PeakPyramid pyramid = built(someScores(256, 1, 4), 256, 1); // 1, 4, 16, 64, 256 frames a row
        QCOMPARE(pyramid.levelFor(0.3), 0);
        QCOMPARE(pyramid.levelFor(3.9), 0);
        QCOMPARE(pyramid.levelFor(4.0), 1);
        QCOMPARE(pyramid.levelFor(63.0), 2);
        QCOMPARE(pyramid.levelFor(1e9), pyramid.levelCount() - 1);
    }

    void oneFrameAndNone()
    {
        const PeakPyramid one = built({1.0f, 2.0f}, 1, 2);
        QCOMPARE(one.rowCount(0), Index(1));
        QCOMPARE(one.scale().value(one.row(0, 0)[1]), 2.0);
        const PeakPyramid none = built({}, 0, 2);
        QCOMPARE(none.levelCount(), 1);
        QCOMPARE(none.rowCount(0), Index(0));
        QCOMPARE(none.frameCount(), Index(0));
    }
};

FAINTLINE_TEST(tst_PeakPyramid)
#include "tst_PeakPyramid.moc"

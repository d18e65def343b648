#include "signal/ArrayRecording.h"
#include "support/test.h"

#include "support/errors.h"

#include <limits>

using namespace faintline;
using namespace faintline::test;

namespace {

std::shared_ptr<const float> shared(std::vector<float> values)
{
    const auto owner = std::make_shared<const std::vector<float>>(std::move(values));
    return {owner, owner->data()};
}

} // namespace

/// Samples in memory as a recording.
class tst_ArrayRecording : public QObject
{
    Q_OBJECT

private slots:
    void channelsLieSideBySide()
    {
        const ArrayRecording recording("x", shared({1, 10, 2, 20, 3, 30}),
                                       {.sampleRateHz = 100.0, .sampleCount = 3, .channelCount = 2});
        std::vector<float> out(2);
        recording.read(1, 1, 2, out);
        QCOMPARE(out, (std::vector<float>{20, 30}));
        QCOMPARE(recording.info().durationSeconds(), 0.03);
    }

    void complexSamplesArePairs()
    {
        const ArrayRecording recording(
            "x", shared({1, -1, 2, -2, 3, -3, 4, -4}),
            {.sampleRateHz = 100.0, .sampleCount = 2, .channelCount = 2, .isComplex = true, .centreHz = 1e6});
        std::vector<float> out(4);
        recording.read(1, 0, 2, out);
        QCOMPARE(out, (std::vector<float>{2, -2, 4, -4}));
        QCOMPARE(recording.info().centreHz, 1e6);
    }

    void outsideAndNotFiniteAreZero()
    {
        const ArrayRecording recording("x", shared({1, std::numeric_limits<float>::quiet_NaN(), 3}),
                                       {.sampleRateHz = 1.0, .sampleCount = 3});
        std::vector<float> out(5);
        recording.read(0, -1, 5, out);
        QCOMPARE(out, (std::vector<float>{0, 1, 0, 3, 0}));
        QCOMPARE(recording.nonFiniteCount(), 1);
    }

    void refusals()
    {
        QVERIFY(contains(errorOf([] { ArrayRecording("x", shared({1}), {.sampleRateHz = 0.0, .sampleCount = 1}); }),
                         "x: rate = 0: must be"));
        QVERIFY(
            contains(errorOf([] { ArrayRecording("x", shared({}), {.sampleRateHz = 1.0}); }), "x: holds no samples"));
    }
};

FAINTLINE_TEST(tst_ArrayRecording)
#include "tst_ArrayRecording.moc"

#include "analyse/LiveFrames.h"
#include "support/test.h"

#include "base/memoryShares.h"

#include <cmath>

using namespace faintline;

namespace {

Axis frames(Index count)
{
    return {"time", "s", 0.0, 1.0, count, false};
}

/// A run of that many frames.
NormalisedFramesPointer source(Index count, Index cells)
{
    const Grid grid{{{"frequency", "Hz", 0.0, 1.0, cells, false}}};
    return std::make_shared<FrameArray>(frames(count), grid, std::vector<float>(std::size_t(count * cells), 1.0f));
}

std::vector<float> frame(Index t, Index cells)
{
    return std::vector<float>(std::size_t(cells), float(t));
}

} // namespace

/// The newest frames whole, older ones around marked places.
class tst_LiveFrames : public QObject
{
    Q_OBJECT

private slots:
    void olderFramesKeepMarkedPlaces()
    {
        const Index cells = 200;
        LiveFrames kept(source(100, cells), 10, 4);
        for (Index t = 0; t < 100; ++t) {
            kept.append(t, frame(t, cells));
            kept.mark(t, 50);
            kept.mark(t, 55);
            kept.mark(t, 0);
        }
        kept.mark(3, 120); // too late: this frame is no longer whole
        QCOMPARE(kept.time().count, Index(100));
        QCOMPARE(kept.firstKept(), Index(0));
        std::vector<float> y(static_cast<std::size_t>(100 * cells));
        kept.read(0, 100, y);
        for (Index t = 0; t < 100; ++t)
            for (Index cell = 0; cell < cells; ++cell) {
                const bool isKept = t >= 90 || cell <= 4 || (cell >= 46 && cell <= 59);
                const float value = y[std::size_t(t * cells + cell)];
                QVERIFY(isKept ? value == float(t) : std::isnan(value));
            }
        QVERIFY(kept.isObserved(5));
        kept.forgetBefore(30);
        QCOMPARE(kept.firstKept(), Index(30));
        kept.forgetBefore(95);
        QCOMPARE(kept.firstKept(), Index(90));
    }

    void aRunThatGoesOnKeepsItsFrameNumbers()
    {
        LiveFrames kept(source(100, 20), 10, 4);
        kept.append(60, frame(60, 20));
        kept.append(61, frame(61, 20));
        QCOMPARE(kept.firstKept(), Index(60));
        std::vector<float> y(std::size_t(4 * 20));
        kept.read(59, 4, y);
        QVERIFY(std::isnan(y[0]) && y[20] == 60.0f && y[40] == 61.0f && std::isnan(y[60]));
    }

    void memoryIsBounded()
    {
        const Index cells = 4096;
        const auto fits = Index(memoryShares::pathRecord / (sizeof(float) * std::size_t(cells)));
        LiveFrames kept(source(1, cells), 4, cells); // all of a marked frame is kept
        const std::vector<float> y = frame(1, cells);
        for (Index t = 0; t < 2 * fits; ++t) {
            kept.append(t, y);
            kept.mark(t, 7);
        }
        QVERIFY(kept.firstKept() >= fits - 4);
        QVERIFY(kept.firstKept() < fits + 100);
    }
};

FAINTLINE_TEST(tst_LiveFrames)
#include "tst_LiveFrames.moc"

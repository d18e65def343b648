#include "base/Checkpoints.h"
#include "support/test.h"

#include <limits>

using namespace faintline;

/// States kept at even distances within a budget of bytes.
class tst_Checkpoints : public QObject
{
    Q_OBJECT

private slots:
    void everyIntervalWhileThereIsRoom()
    {
        Checkpoints<int> kept(8, 1000);
        fill(kept, 50, 10);
        QCOMPARE(framesOf(kept), (std::vector<Index>{8, 16, 24, 32, 40, 48}));
        QCOMPARE(kept.bytes(), std::size_t(60));
        QCOMPARE(*kept.at(24), 24);
        QVERIFY(!kept.at(25));
        QCOMPARE(kept.latest(31), Index(24));
        QCOMPARE(kept.latest(7), Index(0));
    }

    void fartherApartWhereTheyAreLarge()
    {
        Checkpoints<int> kept(8, 1000);
        for (const Index frames : {1'000, 10'000, 100'000}) {
            fill(kept, frames, 100);
            QVERIFY(kept.bytes() <= 1000);
            const std::vector<Index> at = framesOf(kept);
            QVERIFY(at.size() >= 5); // more than half of what there is room for
            for (std::size_t i = 0; i < at.size(); ++i)
                QCOMPARE(at[i], Index(i + 1) * kept.interval());
        }
    }

    void anIncreasingSizeIsCountedAsItIs()
    {
        Checkpoints<int> kept(1, 1000);
        std::size_t largest = 0;
        for (Index frame = 1; frame <= 200; ++frame)
            if (kept.lacks(frame)) {
                kept.keep(frame, std::make_shared<const int>(0), std::size_t(frame));
                largest = std::max(largest, kept.bytes());
            }
        QVERIFY(largest <= 1000);
    }

    void oneIsAlwaysKept()
    {
        Checkpoints<int> kept(4, 10);
        fill(kept, 5, 100);
        QCOMPARE(framesOf(kept), std::vector<Index>{4});
        kept.clear();
        QCOMPARE(kept.bytes(), std::size_t(0));
    }

    void keptAnewItIsReplaced()
    {
        Checkpoints<int> kept(4, 1000);
        kept.keep(4, std::make_shared<const int>(1), 100);
        kept.keep(4, std::make_shared<const int>(2), 50);
        QCOMPARE(*kept.at(4), 2);
        QCOMPARE(kept.bytes(), std::size_t(50));
    }

private:
    static void fill(Checkpoints<int> &kept, Index frames, std::size_t bytes)
    {
        for (Index frame = 0; frame < frames; ++frame)
            if (kept.lacks(frame))
                kept.keep(frame, std::make_shared<const int>(int(frame)), bytes);
    }

    static std::vector<Index> framesOf(const Checkpoints<int> &kept)
    {
        std::vector<Index> frames;
        for (Index frame = kept.latest(std::numeric_limits<Index>::max()); frame > 0; frame = kept.latest(frame - 1))
            frames.insert(frames.begin(), frame);
        return frames;
    }
};

FAINTLINE_TEST(tst_Checkpoints)
#include "tst_Checkpoints.moc"

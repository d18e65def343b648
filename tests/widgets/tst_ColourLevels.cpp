#include "support/test.h"
#include "widgets/waterfall/ColourLevels.h"

#include "pictures.h"

using namespace faintline;

/// Which values the colours stand for: by hand, or as the pixels suggest.
class tst_ColourLevels : public QObject
{
    Q_OBJECT

private slots:
    void nothingIsSuggestedBeforeTheFirstCount()
    {
        ColourLevels levels;
        QVERIFY(levels.isAutomatic());
        levels.setRange({-3.0, 8.0});
        QCOMPARE(levels.suggested(ByteScale(), {}), (Span{-3.0, 8.0}));
        QVERIFY(levels.histogram().empty());
    }

    void everyPixelIsCounted()
    {
        const auto picture = test::countingPicture(20, 30);
        ColourLevels levels;
        QVERIFY(levels.count(*picture, 1.0, 1.0));
        QCOMPARE(levels.histogram().size(), std::size_t(256));
        double sum = 0.0;
        for (int byte = 0; byte < 256; ++byte) {
            const double count = levels.histogram()[std::size_t(byte)];
            sum += count;
            if (picture->scale().value(byte) > 220.0) // the largest is 29 + 10·19
                QCOMPARE(count, 0.0);
        }
        QCOMPARE(sum, 600.0);
        levels.clearHistogram();
        QVERIFY(levels.histogram().empty());
    }

    void theSameZoomIsCountedOnce()
    {
        const auto picture = test::countingPicture(64, 64);
        ColourLevels levels;
        QVERIFY(levels.count(*picture, 1.0, 1.0));
        QVERIFY(!levels.count(*picture, 1.0, 1.0));
        QVERIFY(!levels.count(*picture, 1.4, 1.3));   // nearly the same
        QVERIFY(!levels.count(*picture, 0.01, 0.01)); // a cell is the least there is
        QVERIFY(levels.count(*picture, 1.0, 2.0));
        QVERIFY(levels.count(*picture, 4.0, 2.0));
        QVERIFY(!levels.count(*picture, 4.0, 2.0));
        levels.countAgain();
        QVERIFY(levels.count(*picture, 4.0, 2.0));
    }

    void noiseIsDarkAndALineBright()
    {
        const auto picture = test::picture(
            100, 100,
            [](Index frame, Index cell) { return cell == 50 ? 1000.0f : 0.5f + 0.01f * float((frame * 7) % 100); },
            ByteScale::Kind::PowerDb);
        ColourLevels levels;
        QVERIFY(levels.count(*picture, 1.0, 1.0));
        const Span suggested = levels.suggested(picture->scale(), {});
        QVERIFY(suggested.low < 0.0);    // 1 is 0 dB
        QVERIFY(suggested.high <= 30.0); // of the line
        QVERIFY(suggested.high > suggested.low + 5.0);
        levels.setRange(suggested);
        QCOMPARE(levels.range(), suggested);
    }

    void levelsByHandStayApart()
    {
        const ColourLevels levels;
        const ByteScale power;
        QCOMPARE(levels.byHand(-10.0, 20.0, &power), (Span{-10.0, 20.0}));
        QCOMPARE(levels.byHand(5.0, 5.0, &power), (Span{5.0, 5.5}));
        QCOMPARE(levels.byHand(5.0, -5.0, nullptr), (Span{5.0, 5.5}));
    }

    void zeroStaysInTheMiddleOfDifferences()
    {
        const ByteScale differences(ByteScale::Kind::DifferenceNats);
        ColourLevels levels;
        levels.setRange({-10.0, 10.0});
        QCOMPARE(levels.byHand(-10.0, 7.0, &differences), (Span{-7.0, 7.0})); // the high end was moved,
        QCOMPARE(levels.byHand(-4.0, 10.0, &differences), (Span{-4.0, 4.0})); // the low one
        QCOMPARE(levels.byHand(3.0, 10.0, &differences), (Span{-0.5, 0.5}));  // beyond the middle
    }
};

FAINTLINE_WINDOW_TEST(tst_ColourLevels)
#include "tst_ColourLevels.moc"

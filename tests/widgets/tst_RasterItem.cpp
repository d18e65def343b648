#include "support/test.h"
#include "widgets/waterfall/RasterItem.h"

#include "pictures.h"
#include "pixels.h"

using namespace faintline;

/// The image of a tiny picture, pixel by pixel.
class tst_RasterItem : public QObject
{
    Q_OBJECT

private slots:
    void everyOrientation()
    {
        // Two frames (0 … 2 s) of three cells (99 … 105 Hz): values 0 1 2 and 10 11 12.
        RasterItem item;
        item.setPicture(test::countingPicture(2, 3), test::hzAxis(3));
        item.setColours({&ColourMap::named("grey"), {0.0, 20.0}});
        const Span time{0.0, 2.0}, hz{99.0, 105.0};

        const QImage oldestOnTop = item.image(hz, time, false, {3, 2});
        const QImage newestOnTop = item.image(hz, time, true, {3, 2});
        item.setTimeVertical(false);
        const QImage leftToRight = item.image(time, hz, true, {2, 3});
        QCOMPARE(oldestOnTop.size(), QSize(3, 2));
        QCOMPARE(leftToRight.size(), QSize(2, 3));
        for (int frame = 0; frame < 2; ++frame)
            for (int cell = 0; cell < 3; ++cell) {
                const int expected = greyOf(cell + 10 * frame);
                QCOMPARE(grey(oldestOnTop, cell, frame), expected);
                QCOMPARE(grey(newestOnTop, cell, 1 - frame), expected);
                QCOMPARE(grey(leftToRight, frame, 2 - cell), expected);
            }
    }

    void rangeAndMap()
    {
        RasterItem item;
        item.setPicture(test::countingPicture(2, 3), test::hzAxis(3));
        item.setColours({&ColourMap::named("grey"), {1.0, 11.0}});
        QImage image = item.image({99.0, 105.0}, {0.0, 2.0}, false, {3, 2});
        QCOMPARE(grey(image, 0, 0), 0);   // below black
        QCOMPARE(grey(image, 1, 0), 0);   // black
        QCOMPARE(grey(image, 1, 1), 255); // white
        QCOMPARE(grey(image, 2, 1), 255); // beyond white
        item.setColours({&ColourMap::named("paper"), {1.0, 11.0}});
        image = item.image({99.0, 105.0}, {0.0, 2.0}, false, {3, 2});
        QCOMPARE(grey(image, 1, 1), 0);
    }

    void contour()
    {
        // One cell of 5 × 5 above the threshold: its four neighbours are drawn in the contour's colour, the cell itself is
        // not touched.
        RasterItem item;
        item.setPicture(test::picture(5, 5, [](Index f, Index c) { return f == 2 && c == 2 ? 20.0f : 0.0f; }),
                        test::hzAxis(5));
        PictureColours colours{.map = &ColourMap::named("grey"), .range = {0.0, 20.0}, .contour = 10.0};
        colours.contourColour = 0xff00ff00;
        item.setColours(colours);
        const QImage image = item.image({99.0, 109.0}, {0.0, 5.0}, false, {5, 5});
        QCOMPARE(test::pixelsWhere(image, image.rect(), [](QRgb colour) { return colour == 0xff00ff00; }).size(), 4);
        QCOMPARE(image.pixel(2, 2), 0xffffffff);
        QCOMPARE(image.pixel(1, 2), 0xff00ff00);

        colours.contour = 25.0;
        item.setColours(colours);
        QCOMPARE(item.image({99.0, 109.0}, {0.0, 5.0}, false, {5, 5}).pixel(1, 2), 0xff000000);
    }

    void scrollsWithoutFlicker()
    {
        // 40 frames on 10 pixels, scrolled by less than a pixel: the same pixels, for they lie on a grid that stays.
        RasterItem item;
        item.setPicture(test::picture(100, 3, [](Index f, Index c) { return float((f * 31 + c) % 40); }),
                        test::hzAxis(3));
        item.setColours({&ColourMap::named("grey"), {0.0, 40.0}});
        const QImage before = item.image({99.0, 105.0}, {20.0, 60.0}, false, {3, 10});
        const QImage little = item.image({99.0, 105.0}, {21.0, 61.0}, false, {3, 10});
        const QImage pixel = item.image({99.0, 105.0}, {24.0, 64.0}, false, {3, 10});
        QCOMPARE(little, before);
        QCOMPARE(pixel.copy(0, 0, 3, 9), before.copy(0, 1, 3, 9));
    }

    void sameTwice()
    {
        const auto picture = test::picture(300, 200, [](Index f, Index c) { return float((f * 131 + c * 17) % 45); });
        const auto draw = [&](bool isWarm) {
            RasterItem item;
            item.setPicture(picture, test::hzAxis(200));
            if (isWarm) { // caches filled by other views must not show
                item.image({99.0, 300.0}, {0.0, 100.0}, true, {50, 60});
                item.setColours({.contour = 12.0, .contourColour = 0xffff0000});
                item.image({99.0, 499.0}, {0.0, 300.0}, false, {120, 90});
                item.setColours({});
            }
            return item.image({99.0, 499.0}, {0.0, 300.0}, false, {120, 90});
        };
        QCOMPARE(draw(true), draw(false));
    }

    /// A walk over a picture whose pixels are no whole number of frames or cells: what was moved and what was added fit
    /// together.
    void scrolledIsAsDrawnAnew()
    {
        const auto picture =
            test::picture(700, 300, [](Index f, Index c) { return float((f * 131 + c * 17 + f * c % 11) % 45); });
        const auto itemOf = [&](bool isTimeVertical) {
            auto item = std::make_unique<RasterItem>();
            item->setPicture(picture, test::hzAxis(300));
            item->setColours({&ColourMap::named("viridis"), {0.0, 45.0}});
            item->setTimeVertical(isTimeVertical);
            return item;
        };
        for (const bool isTimeVertical : {true, false})
            for (const double seconds : {40.0, 333.3, 611.0}) {
                const auto walker = itemOf(isTimeVertical);
                double low = 11.0, hz = 150.0;
                for (const QPointF &step : {QPointF(0, 0), QPointF(3, 0), QPointF(0, 7), QPointF(-5, 9),
                                            QPointF(11, -20), QPointF(-2, -3.3), QPointF(200, 0)}) {
                    low += step.x();
                    hz += step.y();
                    const Span time{low, low + seconds}, band{hz, hz + 171.0};
                    const Span &x = isTimeVertical ? band : time;
                    const Span &y = isTimeVertical ? time : band;
                    QCOMPARE(walker->image(x, y, true, {97, 83}), itemOf(isTimeVertical)->image(x, y, true, {97, 83}));
                }
            }
    }

private:
    /// Grey level of a value in nats where black is 0 and white is 20.
    static int grey(const QImage &image, int x, int y) { return qGreen(image.pixel(x, y)); }
    static int greyOf(double nats) { return qRound(255.0 * nats / 20.0); }
};

FAINTLINE_WINDOW_TEST(tst_RasterItem)
#include "tst_RasterItem.moc"

#include "support/test.h"
#include "widgets/base/rasterise.h"

#include "pictures.h"
#include "widgets/base/ColourScale.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

/// Pixels from cells: rectangles when zoomed in, maxima when zoomed out.
class tst_rasterise : public QObject
{
    Q_OBJECT

private slots:
    void zoomedInEveryCellIsARectangle()
    {
        const auto picture = test::countingPicture(2, 3);
        const auto out = raster(*picture, {0.0, 0.5, 4}, {0.0, 1.0 / 3.0, 9});
        for (int t = 0; t < 4; ++t)
            for (int c = 0; c < 9; ++c)
                QCOMPARE(picture->scale().value(out[std::size_t(9 * t + c)]), double(10 * (t / 2) + c / 3));
    }

    void zoomedOutAgainstTheDefinition()
    {
        const Index frames = 60, cells = 70;
        const auto picture =
            test::picture(frames, cells, [](Index f, Index c) { return float((f * 37 + c * 91) % 43); });
        const PixelRow time{0.0, 1.7, 35}, hz{0.0, 2.3, 30};
        const auto out = raster(*picture, time, hz);
        // max over ⌈step⌉ cells from the first one whose centre the pixel covers
        const auto first = [](const PixelRow &row, int pixel) {
            return Index(std::ceil(row.first + pixel * row.step - 0.5));
        };
        for (int t = 0; t < time.count; ++t)
            for (int c = 0; c < hz.count; ++c) {
                double highest = -100.0;
                for (Index f = first(time, t); f < std::min<Index>(first(time, t) + 2, frames); ++f)
                    for (Index cell = first(hz, c); cell < std::min<Index>(first(hz, c) + 3, cells); ++cell)
                        highest = std::max(highest, picture->scale().value(picture->row(0, f)[std::size_t(cell)]));
                QCOMPARE(picture->scale().value(out[std::size_t(t * hz.count + c)]), highest);
            }
    }

    void logarithmicPixelsAgainstTheDefinition()
    {
        // Cells of 1 Hz from -0.5 Hz on; pixels from 1 to 600 Hz: narrower than cells below, wider above.
        const Index cells = 620;
        const auto picture = test::picture(3, cells, [](Index f, Index c) { return float((f * 37 + c * 91) % 43); });
        const int count = 200;
        const double step = std::log(600.0) / count;
        const auto out = raster(*picture, {0.0, 1.0, 3}, {0.0, step, count, 0.5});
        QSet<int> inSight;
        for (int t = 0; t < 3; ++t)
            for (int p = 0; p < count; ++p) {
                const double low = 0.5 + std::exp(p * step), high = 0.5 + std::exp((p + 1) * step);
                double highest = -100.0;
                for (Index cell = 0; cell < cells; ++cell) {
                    const double centre = double(cell) + 0.5;
                    const bool isInside = high - low > 1.0 ? centre >= low && centre < low + std::ceil(high - low)
                                                           : cell == Index(0.5 * (low + high));
                    if (!isInside)
                        continue;
                    inSight.insert(int(cell));
                    highest = std::max(highest, picture->scale().value(picture->row(0, t)[std::size_t(cell)]));
                }
                QCOMPARE(picture->scale().value(out[std::size_t(t * count + p)]), highest);
            }
        for (int cell = 2; cell < 600; ++cell)
            QVERIFY2(inSight.contains(cell), qPrintable(QString::number(cell)));
    }

    void aHotCellSurvivesAnyZoom()
    {
        const Index frames = 500, cells = 300;
        for (const auto &[frame, cell] :
             {std::pair<Index, Index>{0, 0}, {499, 299}, {17, 250}, {256, 128}, {333, 1}, {498, 77}}) {
            const auto picture =
                test::picture(frames, cells, [=](Index f, Index c) { return f == frame && c == cell ? 40.0f : 0.0f; });
            const auto hot = picture->scale().byte(40.0);
            for (const int pixels : {7, 31, 100, 299, 640}) {
                const double perTime = double(frames) / pixels, perHz = double(cells) / pixels;
                const auto out = raster(*picture, {0.0, perTime, pixels}, {0.0, perHz, pixels});
                const auto found = std::find(out.begin(), out.end(), hot);
                QVERIFY2(found != out.end(),
                         qPrintable(QString("frame %1 cell %2 at %3 pixels").arg(frame).arg(cell).arg(pixels)));
                const auto index = int(found - out.begin());
                QVERIFY(std::abs(index / pixels - (double(frame) + 0.5) / perTime) <= std::max(2.0, 1.0 / perTime));
                QVERIFY(std::abs(index % pixels - (double(cell) + 0.5) / perHz) <= std::max(2.0, 1.0 / perHz));
            }
        }
    }

    void aOneBinLineSurvivesLongRecordings()
    {
        const Index frames = 20000, cells = 64;
        const auto picture = test::picture(frames, cells, [](Index, Index c) { return c == 41 ? 30.0f : 1.0f; });
        const auto out = raster(*picture, {0.0, double(frames) / 50.0, 50}, {0.0, 8.0, 8});
        for (int t = 0; t < 50; ++t)
            for (int c = 0; c < 8; ++c)
                QCOMPARE(picture->scale().value(out[std::size_t(8 * t + c)]), c == 5 ? 30.0 : 1.0);
    }

    void theLastFrameIsShown()
    {
        // 1027 frames: the last rows of the coarser levels stand for fewer frames than the others.
        const Index frames = 1027;
        const auto picture = test::picture(frames, 4, [=](Index f, Index) { return f == frames - 1 ? 20.0f : 0.0f; });
        for (const int pixels : {3, 10, 60, 250}) {
            const auto out = raster(*picture, {0.0, double(frames) / pixels, pixels}, {0.0, 1.0, 4});
            QCOMPARE(picture->scale().value(out.back()), 20.0);
        }
    }

    void emptyPicture()
    {
        PeakPyramid picture(test::timeAxis(0), 5, ByteScale());
        picture.finish();
        const auto out = raster(picture, {0.0, 1.0, 3}, {0.0, 1.0, 5});
        QVERIFY(std::all_of(out.begin(), out.end(), [](std::uint8_t byte) { return byte == 0; }));
        QCOMPARE(automaticRange(picture.scale(), countPixels(picture, 1.0, 1.0)).low, -6.0);
    }

    void rangeOfNoise()
    {
        // Exponential noise of mean 1: its median is -1.6 dB, and the range must not depend on the few lines there are.
        const auto value = [](Index f, Index c, double line) {
            const double u = (double((f * 7919 + c * 104729) % 99991) + 0.5) / 99991.0;
            return float(-std::log(u) + (c == 10 ? line : 0.0));
        };
        const auto rangeWith = [&](double line) {
            const auto picture = test::picture(
                400, 300, [&](Index f, Index c) { return value(f, c, line); }, ByteScale::Kind::PowerDb);
            return automaticRange(picture->scale(), countPixels(*picture, 1.0, 1.0));
        };
        const Span quiet = rangeWith(0.0), loud = rangeWith(1e5);
        QVERIFY(quiet.low > -7.0 && quiet.low < -2.0);
        QVERIFY(quiet.high > 8.0 && quiet.high < 15.0);
        QVERIFY(std::abs(quiet.low - loud.low) <= 0.5);
        QVERIFY(loud.high <= 15.0);
    }

    void rangeOfABandFullOfLines()
    {
        const auto rangeWith = [](int lineEvery, std::optional<double> threshold) {
            const auto picture =
                test::picture(100, 300, [=](Index f, Index c) { // noise of about 1 nat, lines of hundreds
                    return lineEvery > 0 && c % lineEvery != 0 ? float(200 + f) : float(f % 4);
                });
            return automaticRange(picture->scale(), countPixels(*picture, 1.0, 1.0), threshold);
        };
        const Span full = rangeWith(4, 14.0);
        QVERIFY(rangeWith(4, {}).low > 150.0); // what the picture alone would say
        QVERIFY(full.low <= 7.0);
        QVERIFY(full.high > 280.0 && full.high < 310.0); // nearly the strongest, in steps of 15 %
        const ColourScale colours = ColourScale::of(ByteScale(ByteScale::Kind::ScoreNats), 14.0);
        QVERIFY(colours.share(14.0, full) > 0.2);               // 14 nat is not black
        QVERIFY(colours.share(220.0, full) < 0.97);             // ten colours from white
        QCOMPARE(rangeWith(0, 14.0).low, rangeWith(0, {}).low); // of noise alone, which stays dark
        QCOMPARE(rangeWith(0, 14.0).high, 21.0);
        QCOMPARE(rangeWith(4, -1.0), rangeWith(4, {}));
    }

    void coloursOfAScoreAreLogarithmicAboveTheThreshold()
    {
        const ColourScale bent = ColourScale::of(ByteScale(ByteScale::Kind::ScoreNats), 16.0);
        const Span range{0.0, 2000.0};
        for (const double value : {-3.0, 0.0, 16.0, 24.0, 24.1, 100.0, 5000.0})
            QVERIFY(std::abs(bent.value(bent.place(value)) - value) < 1e-9 * (1.0 + std::abs(value)));
        QCOMPARE(bent.place(20.0), 20.0);
        QVERIFY(bent.share(16.0, range) > 0.2);
        QVERIFY(bent.share(20.0, range) - bent.share(16.0, range) > 0.04); // ten of 256 colours
        QCOMPARE(bent.share(2000.0, range), 1.0);
        const ColourScale decibels = ColourScale::of(ByteScale(ByteScale::Kind::PowerDb), 16.0);
        QCOMPARE(decibels.share(500.0, range), 0.25);
    }

    void whiteIsTheLargestValue()
    {
        const auto picture = test::picture(100, 300, [](Index f, Index c) { // spread noise and a line of 22 nat
            return c == 10 ? float(f % 23) : float(2 * (f % 4));
        });
        const std::vector<double> counts = countPixels(*picture, 1.0, 1.0);
        QCOMPARE(automaticRange(picture->scale(), counts, 12.0).high, 22.0);
        QCOMPARE(automaticRange(picture->scale(), counts, 20.0).high, 30.0); // nothing there is an event
        QVERIFY(automaticRange(picture->scale(), counts).high > 30.0);       // a threshold is not known
    }

    void valuesOfABox()
    {
        const auto nats = test::countingPicture(5, 8); // cell + 10 · frame
        QCOMPARE(boxValues(*nats, 1, 3, 2, 5).peak, 24.0);
        QVERIFY(!boxValues(*nats, 1, 3, 2, 5).mean);
        const auto power = test::picture(
            4, 4, [](Index f, Index c) { return f == 1 && c == 1 ? 100.0f : 1.0f; }, ByteScale::Kind::PowerDb);
        QCOMPARE(boxValues(*power, 0, 4, 0, 4).peak, 20.0);
        QVERIFY(std::abs(boxValues(*power, 0, 4, 0, 4).mean.value() - 10.0 * std::log10(115.0 / 16.0)) < 1e-9);
        QCOMPARE(boxValues(*power, 2, 4, 0, 4).mean.value(), 0.0);
    }

private:
    static std::vector<std::uint8_t> raster(const PeakPyramid &picture, const PixelRow &time, const PixelRow &cells)
    {
        std::vector<std::uint8_t> out(std::size_t(time.count * cells.count));
        rasterise(picture, time, cells, out);
        return out;
    }
};

FAINTLINE_WINDOW_TEST(tst_rasterise)
#include "tst_rasterise.moc"

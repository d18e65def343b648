#include "support/test.h"
#include "widgets/waterfall/LayerItem.h"

#include "pictures.h"
#include "pixels.h"
#include "widgets/base/Theme.h"
#include "widgets/pings/PolarLayerItem.h"
#include "widgets/plot/ColourMap.h"

#include <qwt_scale_map.h>

#include <QPainter>

#include <cmath>
#include <limits>

using namespace faintline;

namespace {

constexpr QRgb ground = 0xff3c2814; ///< a colour that no layer has

QwtScaleMap scaleMap(double low, double high, double fromPixel, double toPixel)
{
    QwtScaleMap map;
    map.setScaleInterval(low, high);
    map.setPaintInterval(fromPixel, toPixel);
    return map;
}

} // namespace

/// A layer over the picture: which colour a value has, how much is seen through it, where a cell lies, and the key.
class tst_LayerItem : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Dark); }

    void init()
    {
        m_item = std::make_unique<LayerItem>();
        m_item->setColours(Qt::white, Qt::black, ColourMap::named("grey"));
    }

    void cleanup() { Theme::setPlotScale(1.0); }

    void ratesDivergeAboutZero()
    {
        const auto rates = picture(1, 3);
        rates->rate = {-2.0f, 0.0f, 1.0f};
        m_item->setPicture(rates, m_rows, m_columns);
        m_item->setLayer(OutputLayer::Rate, {-2.0, 2.0}, "Drift", 1.0);
        QCOMPARE(colour(0, 0), mapped("blue-red", 0.0));
        QCOMPARE(colour(1, 0), mapped("blue-red", 0.5));
        QCOMPARE(colour(2, 0), mapped("blue-red", 0.75));
        rates->secondRate = {2.0f, 2.0f, -2.0f};
        m_item->setLayer(OutputLayer::SecondRate, {-2.0, 2.0}, "Turn", 1.0);
        QCOMPARE(colour(0, 0), mapped("blue-red", 1.0));
        QCOMPARE(colour(2, 0), mapped("blue-red", 0.0));
    }

    void whereNothingHasWonItIsGrey()
    {
        const auto rates = picture(1, 3);
        rates->rate = {1.0f, 1.0f, 1.0f};
        rates->resetFraction = {1.0f, 0.99f, 0.0f};
        rates->statistic = {20.0f, 20.0f, 20.0f};
        m_item->setPicture(rates, m_rows, m_columns);
        m_item->setLayer(OutputLayer::Rate, {-1.0, 1.0}, "Drift", 1.0);
        QCOMPARE(colour(0, 0), qRgb(110, 110, 110));
        QCOMPARE(colour(1, 0), mapped("blue-red", 1.0));
        m_item->setOverlay(true, 10.0);
        QCOMPARE(qAlpha(colour(0, 0)), 0);
        QCOMPARE(qAlpha(colour(1, 0)), 255);
    }

    /// Where only lines that stand still are looked for, all rates are 0, and so are both ends of the range.
    void oneRateAloneHasTheMiddleColour()
    {
        m_item->setPicture(picture(2, 2), m_rows, m_columns);
        m_item->setLayer(OutputLayer::Rate, {-0.0, 0.0}, "Drift", 1.0);
        QCOMPARE(colour(1, 1), mapped("blue-red", 0.5));
    }

    void agesGrow()
    {
        const auto ages = picture(3, 1);
        ages->age = {0.0f, 30.0f, 60.0f};
        m_item->setPicture(ages, m_rows, m_columns);
        m_item->setLayer(OutputLayer::Age, {0.0, 60.0}, "Age (s)", 1.0);
        QCOMPARE(colour(0, 0), mapped("viridis", 0.0));
        QCOMPARE(colour(0, 1), mapped("viridis", 0.5));
        QCOMPARE(colour(0, 2), mapped("viridis", 1.0));
    }

    void agesBeyondTheRangeAreItsEnds()
    {
        const auto ages = picture(1, 4);
        constexpr float inf = std::numeric_limits<float>::infinity();
        ages->age = {inf, 1e30f, -inf, std::numeric_limits<float>::quiet_NaN()};
        m_item->setPicture(ages, m_rows, m_columns);
        m_item->setLayer(OutputLayer::Age, {0.0, 60.0}, "Age (s)", 1.0);
        QCOMPARE(colour(0, 0), mapped("viridis", 1.0));
        QCOMPARE(colour(1, 0), mapped("viridis", 1.0));
        QCOMPARE(colour(2, 0), mapped("viridis", 0.0));
        QCOMPARE(colour(3, 0), mapped("viridis", 0.0));
    }

    void inhibitedCellsHaveAColourOfTheirOwn()
    {
        const auto cells = picture(1, 2);
        cells->inhibited = {1.0f, 0.0f};
        m_item->setPicture(cells, m_rows, m_columns);
        m_item->setLayer(OutputLayer::Inhibited, {0.0, 1.0}, "Inhibited", 1.0);
        QCOMPARE(colour(0, 0), qRgb(0, 170, 190));
        QCOMPARE(colour(1, 0), qRgb(0, 0, 0));
        m_item->setOverlay(true, 10.0);
        QCOMPARE(qAlpha(colour(0, 0)), 140); // 55 %, however small the statistic is there
        QCOMPARE(qAlpha(colour(1, 0)), 0);
    }

    void presenceIsAsOpaqueAsItIsSure()
    {
        const auto tracks = picture(1, 3);
        tracks->presence = {0.0f, 0.5f, 1.0f};
        m_item->setPicture(tracks, m_rows, m_columns);
        m_item->setLayer(OutputLayer::Presence, {0.0, 1.0}, "Presence", 1.0);
        QCOMPARE(colour(1, 0), mapped("grey", 0.5)); // of the picture that it replaces
        QCOMPARE(colour(2, 0), mapped("grey", 1.0));
        m_item->setColours(Qt::white, Qt::black, ColourMap::named("paper"));
        QCOMPARE(colour(2, 0), mapped("paper", 1.0));
        m_item->setOverlay(true, 8.0);
        QCOMPARE(colour(2, 0), mapped("viridis", 1.0));
        QCOMPARE(qAlpha(colour(0, 0)), 0);
        QCOMPARE(qAlpha(colour(1, 0)), 128);
        QCOMPARE(qAlpha(colour(2, 0)), 255);
    }

    void overTheStatisticItIsAsOpaqueAsThatIsLarge()
    {
        const auto ages = picture(1, 4);
        ages->statistic = {-1.0f, 4.0f, 8.0f, 100.0f};
        ages->age = {60.0f, 60.0f, 60.0f, 60.0f};
        m_item->setPicture(ages, m_rows, m_columns);
        m_item->setLayer(OutputLayer::Age, {0.0, 60.0}, "Age (s)", 1.0);
        m_item->setOverlay(true, 8.0);
        const int alphas[] = {0, 128, 255, 255};
        for (int i = 0; i < 4; ++i)
            QCOMPARE(qAlpha(colour(i, 0)), alphas[i]);
        QCOMPARE(m_item->image().pixelColor(3, 0).rgb(), mapped("viridis", 1.0));
        m_item->setOverlay(true, 0.0); // no threshold: not a division by it
        QCOMPARE(qAlpha(colour(0, 0)), 0);
        QCOMPARE(qAlpha(colour(1, 0)), 255);
    }

    void overTheStatisticResetsAreAsOpaqueAsTheyAreMany()
    {
        const auto resets = picture(1, 3);
        resets->resetFraction = {0.0f, 0.5f, 1.0f};
        resets->statistic = {50.0f, 0.0f, 0.0f}; // does not count
        m_item->setPicture(resets, m_rows, m_columns);
        m_item->setLayer(OutputLayer::Reset, {0.0, 1.0}, "Reset", 1.0);
        m_item->setOverlay(true, 10.0);
        const int alphas[] = {0, 89, 179}; // 70 %
        for (int i = 0; i < 3; ++i)
            QVERIFY(std::abs(qAlpha(colour(i, 0)) - alphas[i]) <= 1);
    }

    void aRowOfPixelsLiesOnItsFrames()
    {
        const auto cells = picture(3, 4);
        cells->firstRow = 2;
        cells->firstColumn = 5;
        cells->inhibited[1 * 4 + 3] = 1.0f; // frame 3, cell 8
        m_item->setPicture(cells, m_rows, m_columns);
        m_item->setLayer(OutputLayer::Inhibited, {0.0, 1.0}, "Inhibited", 1.0);
        const QImage image = drawn();
        const QRgb inhibited = qRgb(0, 170, 190);
        QCOMPARE(image.pixel(85, 65), inhibited); // 16 … 18 Hz, 3 … 4 s
        QCOMPARE(image.pixel(81, 61), inhibited);
        QCOMPARE(image.pixel(88, 68), inhibited);
        QCOMPARE(image.pixel(78, 65), qRgb(0, 0, 0));
        QCOMPARE(image.pixel(92, 65), ground); // beyond the picture
        QCOMPARE(image.pixel(85, 45), ground);
        QCOMPARE(image.pixel(85, 75), qRgb(0, 0, 0));
        QCOMPARE(image.pixel(85, 82), ground);
    }

    void timeMayRunToTheRight()
    {
        const auto cells = picture(10, 20);
        cells->inhibited[3 * 20 + 8] = 1.0f; // frame 3, cell 8
        m_item->setPicture(cells, m_rows, m_columns);
        m_item->setLayer(OutputLayer::Inhibited, {0.0, 1.0}, "Inhibited", 1.0);
        const QImage image = drawn(false);
        QCOMPARE(image.pixel(70, 57), qRgb(0, 170, 190)); // 3 … 4 s, 16 … 18 Hz
        QCOMPARE(image.pixel(50, 57), qRgb(0, 0, 0));
        QCOMPARE(image.pixel(70, 62), qRgb(0, 0, 0));
    }

    void coarsePixelsCoverAllTheirCells()
    {
        const auto cells = picture(2, 4);
        cells->perRow = 4;
        cells->perColumn = 3;
        cells->firstColumn = 1;             // cells 3 … 14
        cells->inhibited[1 * 4 + 0] = 1.0f; // frames 4 … 7, cells 3 … 5
        m_item->setPicture(cells, m_rows, m_columns);
        m_item->setLayer(OutputLayer::Inhibited, {0.0, 1.0}, "Inhibited", 1.0);
        const QImage image = drawn();
        const QRgb inhibited = qRgb(0, 170, 190);
        for (const QPoint at : {QPoint(32, 58), QPoint(57, 58), QPoint(32, 22), QPoint(57, 22)})
            QCOMPARE(image.pixel(at), inhibited);
        QCOMPARE(image.pixel(28, 40), ground);
        QCOMPARE(image.pixel(62, 40), qRgb(0, 0, 0));
        QCOMPARE(image.pixel(45, 62), qRgb(0, 0, 0));
        QCOMPARE(image.pixel(45, 18), ground); // frames 8 and 9 are not in it
    }

    void frequencyMayBeLogarithmic()
    {
        const auto cells = picture(10, 20);
        cells->inhibited[3 * 20 + 8] = 1.0f; // frame 3, cell 8: 16 … 18 Hz
        m_item->setPicture(cells, m_rows, m_columns);
        m_item->setLayer(OutputLayer::Inhibited, {0.0, 1.0}, "Inhibited", 1.0);
        QwtScaleMap hz;
        hz.setTransformation(new QwtLogTransform);
        hz.setScaleInterval(1.0, 100.0);
        for (const bool isTimeVertical : {true, false}) {
            QImage image(200, 200, QImage::Format_RGB32);
            image.fill(ground);
            QPainter painter(&image);
            m_item->setTimeVertical(isTimeVertical);
            hz.setPaintInterval(isTimeVertical ? 0.0 : 200.0, isTimeVertical ? 200.0 : 0.0); // 100 pixels a decade
            const QwtScaleMap time = scaleMap(0.0, 10.0, 0.0, 200.0);
            m_item->draw(&painter, isTimeVertical ? hz : time, isTimeVertical ? time : hz, {0, 0, 200, 200});
            const auto colourAt = [&](double frequency) {
                const int place = int(hz.transform(frequency));
                return isTimeVertical ? image.pixel(place, 70) : image.pixel(70, place); // 3.5 s
            };
            QCOMPARE(colourAt(17.0), qRgb(0, 170, 190));
            QCOMPARE(colourAt(15.4), qRgb(0, 0, 0));
            QCOMPARE(colourAt(18.8), qRgb(0, 0, 0));
            QCOMPARE(colourAt(50.0), ground); // above the last cell
        }
    }

    void itStaysOnTheCanvas()
    {
        m_item->setPicture(picture(10, 20), m_rows, m_columns);
        m_item->setLayer(OutputLayer::Inhibited, {0.0, 1.0}, "Inhibited", 1.0);
        const QImage image = drawn(true, {20, 10, 100, 50});
        QCOMPARE(image.pixel(21, 11), qRgb(0, 0, 0));
        QCOMPARE(image.pixel(118, 58), qRgb(0, 0, 0));
        for (const QPoint at : {QPoint(18, 30), QPoint(122, 30), QPoint(60, 8), QPoint(60, 62)})
            QCOMPARE(image.pixel(at), ground);
    }

    void withoutAPictureNothingIsDrawn()
    {
        QImage empty(200, 100, QImage::Format_RGB32);
        empty.fill(ground);
        m_item->setLayer(OutputLayer::Age, {0.0, 1.0}, "Age", 1.0);
        QVERIFY(!m_item->isShown());
        QCOMPARE(drawn(), empty);
        m_item->setPicture(picture(0, 20), m_rows, m_columns);
        QVERIFY(!m_item->isShown());
        QCOMPARE(drawn(), empty);
        m_item->setPicture(picture(10, 20), m_rows, m_columns);
        QVERIFY(m_item->isShown());
        QVERIFY(drawn() != empty);
        m_item->setLayer(OutputLayer::Statistic, {0.0, 1.0}, "D", 1.0); // that is the raster's own
        QVERIFY(!m_item->isShown());
        QCOMPARE(drawn(), empty);
    }

    void anotherLayerIsPaintedAnew()
    {
        const auto cells = picture(1, 1);
        cells->age = {60.0f};
        cells->rate = {-1.0f};
        m_item->setPicture(cells, m_rows, m_columns);
        m_item->setLayer(OutputLayer::Age, {0.0, 60.0}, "Age (s)", 1.0);
        QCOMPARE(colour(0, 0), mapped("viridis", 1.0));
        m_item->setLayer(OutputLayer::Age, {0.0, 120.0}, "Age (s)", 1.0);
        QCOMPARE(colour(0, 0), mapped("viridis", 0.5));
        m_item->setLayer(OutputLayer::Rate, {-1.0, 1.0}, "Drift", 1.0);
        QCOMPARE(colour(0, 0), mapped("blue-red", 0.0));
        const auto other = picture(1, 1);
        other->rate = {1.0f};
        m_item->setPicture(other, m_rows, m_columns);
        QCOMPARE(colour(0, 0), mapped("blue-red", 1.0));
    }

    void theKeyIsTheMapItself()
    {
        m_item->setPicture(picture(10, 20), m_rows, m_columns);
        m_item->setLayer(OutputLayer::Rate, {-2.0, 2.0}, "Drift (Hz/s)", 1.0);
        const QImage key = drawnKey({400, 300});
        const QSet<QRgb> colours = test::coloursOf(key.copy(250, 50, 200, 100));
        for (const double share : {0.0, 0.25, 0.5, 0.75})
            QVERIFY(colours.contains(mapped("blue-red", share)));
        // The numbers are in the unit of the title.
        m_item->setLayer(OutputLayer::Rate, {-2.0, 2.0}, "Drift (Hz/s)", 0.001);
        QVERIFY(drawnKey({400, 300}) != key);
        m_item->setLayer(OutputLayer::Rate, {-2000.0, 2000.0}, "Drift (Hz/s)", 1000.0);
        QCOMPARE(drawnKey({400, 300}), key);
    }

    void theKeyStaysOnASmallCanvas()
    {
        m_item->setPicture(picture(10, 20), m_rows, m_columns);
        m_item->setLayer(OutputLayer::Age, {0.0, 2.0}, "Path age since reset (pings)", 1.0);
        const QSizeF smallest(220, 180); // of a waterfall, and its canvas is smaller still
        for (const double scale : {1.0, 2.0}) {
            Theme::setPlotScale(scale);
            for (const QSizeF &size : {smallest, QSizeF(150, 110)}) {
                const QImage image = drawnKey(size);
                const QRectF canvas(QPointF(50, 50), size);
                for (int y = 0; y < image.height(); ++y)
                    for (int x = 0; x < image.width(); ++x)
                        QVERIFY2(image.pixel(x, y) == ground || canvas.contains(x, y),
                                 qPrintable(QStringLiteral("%1, %2 at %3").arg(x).arg(y).arg(scale)));
            }
        }
    }

    void theStatisticHasNoKey()
    {
        m_item->setPicture(picture(10, 20), m_rows, m_columns);
        QImage empty(500, 400, QImage::Format_RGB32);
        empty.fill(ground);
        QCOMPARE(drawnKey({400, 300}), empty);
        m_item->setLayer(OutputLayer::Inhibited, {0.0, 1.0}, "Inhibited", 1.0);
        QVERIFY(drawnKey({400, 300}) != empty);
        m_item->setPicture(nullptr, {}, {});
        QCOMPARE(drawnKey({400, 300}), empty);
    }

    void fromAboveACellIsWhereItsBearingPoints()
    {
        const Axis ranges{"range", "m", 10.0, 20.0, 5, false}; // 0 … 100 m
        const Axis bearings{"bearing", "°", 0.0, 90.0, 4, true};
        const auto cells = picture(5, 4);
        cells->inhibited[3 * 4 + 1] = 1.0f; // 60 … 80 m, 45 … 135°: east
        m_item->setPicture(cells, ranges, bearings);
        m_item->setLayer(OutputLayer::Inhibited, {0.0, 1.0}, "Inhibited", 1.0);
        const PolarLayerItem polar(*m_item);
        QImage image(200, 200, QImage::Format_RGB32);
        image.fill(ground);
        QPainter painter(&image);
        polar.draw(&painter, scaleMap(-100.0, 100.0, 0.0, 200.0), scaleMap(-100.0, 100.0, 200.0, 0.0),
                   {0, 0, 199, 199});
        const QRgb inhibited = qRgb(0, 170, 190);
        QCOMPARE(image.pixel(100 + 70, 100), inhibited);
        QCOMPARE(image.pixel(100 + 48, 100 - 46), inhibited);
        QCOMPARE(image.pixel(100 + 46, 100 - 52), qRgb(0, 0, 0)); // north of north-east
        for (const QPoint at : {QPoint(30, 100), QPoint(100, 30), QPoint(100, 170), QPoint(150, 100), QPoint(185, 100)})
            QCOMPARE(image.pixel(at), qRgb(0, 0, 0));
        QCOMPARE(image.pixel(5, 5), ground); // beyond the last range
    }

private:
    std::shared_ptr<LayerPicture> picture(Index rows, Index columns) const
    {
        auto made = std::make_shared<LayerPicture>();
        made->rows = rows;
        made->columns = columns;
        const std::vector<float> zeros(std::size_t(rows * columns), 0.0f);
        made->statistic = made->rate = made->secondRate = made->age = made->resetFraction = made->inhibited = zeros;
        return made;
    }

    QRgb colour(int column, int row) const { return m_item->image().pixel(column, row); }
    static QRgb mapped(const char *name, double share) { return ColourMap::named(name).at(share) | 0xff000000; }
    /// Frames 0 … 9 upwards over cells 0 … 19 to the right, ten pixels each; or frames to the right.
    QImage drawn(bool isTimeVertical = true, const QRectF &canvas = {0, 0, 200, 100}) const
    {
        QImage image(200, 100, QImage::Format_RGB32);
        image.fill(ground);
        QPainter painter(&image);
        m_item->setTimeVertical(isTimeVertical);
        if (isTimeVertical)
            m_item->draw(&painter, scaleMap(0.0, 40.0, 0.0, 200.0), scaleMap(0.0, 10.0, 100.0, 0.0), canvas);
        else
            m_item->draw(&painter, scaleMap(0.0, 10.0, 0.0, 200.0), scaleMap(0.0, 40.0, 100.0, 0.0), canvas);
        return image;
    }

    QImage drawnKey(const QSizeF &canvas) const
    {
        QImage image(canvas.toSize() + QSize(100, 100), QImage::Format_RGB32);
        image.fill(ground);
        QPainter painter(&image);
        m_item->makeKey()->draw(&painter, {}, {}, QRectF(QPointF(50, 50), canvas));
        return image;
    }

    const Axis m_rows = test::timeAxis(10);            // frame i is i s … i + 1 s
    const Axis m_columns = test::hzAxis(20, 1.0, 2.0); // cell i is 2 i … 2 i + 2 Hz
    std::unique_ptr<LayerItem> m_item;
};

FAINTLINE_WINDOW_TEST(tst_LayerItem)
#include "tst_LayerItem.moc"

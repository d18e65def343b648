#include "support/test.h"
#include "widgets/plot/MarkedPlot.h"

#include "pixels.h"
#include "widgets/base/Theme.h"

#include <qwt_scale_div.h>
#include <qwt_text.h>

using namespace faintline;

namespace {

/// A mark that is no more than its line.
MarkedPlot::Mark line(double at, bool isUpright)
{
    return {at, isUpright, {}, false};
}

} // namespace

/// What the plots of sequential tests have in common: lines with words, the cursor, whole numbers, and the sentence.
class tst_MarkedPlot : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void init()
    {
        struct Plain : MarkedPlot {}; // as it is
        m_view = std::make_unique<Plain>();
        m_view->setSpans({0.0, 20.0}, {-10.0, 10.0});
        m_view->setEmpty(false);
        test::show(*m_view);
    }

    void cleanup()
    {
        m_view.reset();
        Theme::setPlotScale(1.0);
    }

    void uprightLinesStandAtTheirPlace()
    {
        m_view->setCursor(7.0); // a line without dashes
        const QRect line = placeOf(light().accent);
        QVERIFY2(std::abs(line.center().x() - pixel(7.0, 0.0).x()) <= 1,
                 qPrintable(QString::number(line.center().x())));
        QVERIFY(line.width() <= 2);
        QVERIFY(line.height() >= m_view->canvas()->height() - 8);
    }

    void levelLinesLieAtTheirHeight()
    {
        m_view->setMarks({line(-4.0, false)});
        const QRect place = placeOf(light().threshold);
        QVERIFY(std::abs(place.center().y() - pixel(0.0, -4.0).y()) <= 1);
        QVERIFY(place.height() <= 2);
        QVERIFY(place.width() >= m_view->canvas()->width() - 8);
    }

    void wordsStandOnTheirSideOfTheLine()
    {
        const int level = pixel(0.0, 2.0).y();
        m_view->setMarks({{2.0, false, "accept", false}});
        QRect place = placeOf(light().threshold);
        QVERIFY(place.bottom() > level + 5 && place.top() >= level - 2);
        m_view->setMarks({{2.0, false, "accept", true}});
        place = placeOf(light().threshold);
        QVERIFY(place.top() < level - 5 && place.bottom() <= level + 2);
    }

    void wordsNearTheRightEdgeStandLeftOfTheirLine()
    {
        m_view->setMarks({{3.0, true, "fixed sample size", false}});
        QVERIFY(placeOf(light().text).right() > pixel(3.0, 0.0).x() + 20);
        QVERIFY(placeOf(light().text).left() >= pixel(3.0, 0.0).x() - 2);
        m_view->setMarks({{19.5, true, "fixed sample size", false}});
        QVERIFY(placeOf(light().text).left() < pixel(19.5, 0.0).x() - 20);
        QVERIFY(placeOf(light().text).right() <= pixel(19.5, 0.0).x() + 2);
    }

    void wordsOfNeighboursDoNotMeet()
    {
        for (const double scale : {1.0, 2.0}) {
            Theme::setPlotScale(scale);
            const auto rowsOf = [&](std::vector<MarkedPlot::Mark> marks) {
                m_view->setMarks(std::move(marks));
                const QImage image = test::imageOf(*m_view);
                const int left = pixel(5.4, 0.0).x();
                const QRect beside(left, 3, pixel(11.0, 0.0).x() - left, image.height() - 6);
                QSet<int> rows; // with letters: more than the line's own pixels
                for (const QPoint &dark : test::pixelsWhere(image, beside, [](QRgb one) { return qGray(one) < 100; }))
                    rows << dark.y();
                return rows;
            };
            const QSet<int> first = rowsOf({{5.0, true, "first of two", false}});
            QSet<int> both = rowsOf({{5.0, true, "first of two", false}, {5.2, true, "second of two", false}});
            QVERIFY(!first.isEmpty());
            QVERIFY(both.contains(first));
            both.subtract(first);
            QVERIFY2(both.size() >= first.size() - 2, qPrintable(QString::number(scale))); // as many rows again, below
            QVERIFY(*std::min_element(both.begin(), both.end()) > *std::max_element(first.begin(), first.end()));
        }
    }

    void marksBeyondTheCanvasAreNotDrawn()
    {
        const QImage without = test::imageOf(*m_view);
        m_view->setMarks({line(1e6, true), line(-1e300, true), line(500.0, false)});
        QCOMPARE(test::imageOf(*m_view), without);
    }

    void theCursorIsALine()
    {
        const QImage without = test::imageOf(*m_view);
        m_view->setCursor(3.0);
        const QImage at3 = test::imageOf(*m_view);
        QVERIFY(at3 != without);
        m_view->setCursor(4.0);
        QVERIFY(test::imageOf(*m_view) != at3);
        m_view->setCursor({});
        QCOMPARE(test::imageOf(*m_view), without);
        QVERIFY(!m_view->cursor());
    }

    void theAbscissaHasWholeNumbers_data()
    {
        QTest::addColumn<double>("low");
        QTest::addColumn<double>("high");
        QTest::newRow("one place") << 0.4 << 1.6;
        QTest::newRow("three places") << 0.4 << 3.6;
        QTest::newRow("many") << 0.0 << 1234567.0;
        QTest::newRow("below zero") << -12.0 << -3.0;
    }

    void theAbscissaHasWholeNumbers()
    {
        QFETCH(double, low);
        QFETCH(double, high);
        m_view->setSpans({low, high}, {0.0, 1.0});
        const QwtScaleDiv &div = m_view->axisScaleDiv(QwtAxis::XBottom);
        QVERIFY(!div.ticks(QwtScaleDiv::MajorTick).isEmpty()); // even of one place
        for (const double tick : div.ticks(QwtScaleDiv::MajorTick))
            QCOMPARE(tick, std::round(tick));
        for (const int kind : {QwtScaleDiv::MinorTick, QwtScaleDiv::MediumTick})
            for (const double tick : div.ticks(kind))
                QVERIFY(high - low > 12.0 || tick == std::round(tick)); // nothing between whole numbers
        QCOMPARE(div.lowerBound(), low);
        QCOMPARE(div.upperBound(), high);
    }

    void extremeSpansAreDrawn_data()
    {
        QTest::addColumn<Span>("y");
        QTest::newRow("nothing wide") << Span{3.0, 3.0};
        QTest::newRow("tiny") << Span{0.0, 1e-300};
        QTest::newRow("huge") << Span{-1e300, 1e300};
        QTest::newRow("narrow and far") << Span{1e9, 1e9 + 1e-3};
    }

    void extremeSpansAreDrawn()
    {
        QFETCH(Span, y);
        m_view->setSpans({0.0, 20.0}, y);
        m_view->setMarks({{y.low, false, "low", true}});
        const auto &ticks = m_view->axisScaleDiv(QwtAxis::YLeft).ticks(QwtScaleDiv::MajorTick);
        QVERIFY2(ticks.size() <= 30, qPrintable(QString::number(ticks.size())));
        QVERIFY(!m_view->grab().isNull());
        QCOMPARE(test::spanOf(*m_view, QwtAxis::YLeft), y);
    }

    void aClickTellsItsPlace()
    {
        QSignalSpy places(m_view.get(), &MarkedPlot::activated);
        QTest::mouseClick(m_view->canvas(), Qt::LeftButton, {}, pixel(5.0, -3.0));
        QTest::mouseClick(m_view->canvas(), Qt::MiddleButton, {}, pixel(5.0, -3.0));
        QCOMPARE(places.count(), 1);
        QVERIFY(std::abs(places[0][0].toDouble() - 5.0) < 0.05);
        QVERIFY(std::abs(places[0][1].toDouble() + 3.0) < 0.1);
    }

    void emptyThereIsASentence()
    {
        m_view->setMarks({line(2.0, false)});
        m_view->setEmptySentence("Press Run to plot.");
        QVERIFY(placeOf(light().faintText).isNull()); // not while there is something
        m_view->setEmpty(true);
        QCoreApplication::processEvents();
        QVERIFY(placeOf(light().threshold).isNull());
        const QRect words = placeOf(light().faintText);
        QVERIFY(words.width() > 40);
        QVERIFY((words.center() - m_view->canvas()->rect().center()).manhattanLength() < 12); // in the middle
        QVERIFY(!m_view->isAxisVisible(QwtAxis::YLeft));
    }

    void aSmallerCanvasHasFewerNumbers()
    {
        const auto count = [&] {
            QCoreApplication::processEvents();
            return m_view->axisScaleDiv(QwtAxis::XBottom).ticks(QwtScaleDiv::MajorTick).size();
        };
        const auto many = count();
        m_view->resize(m_view->minimumSizeHint());
        QVERIFY(count() < many);
        QVERIFY(count() >= 2);
        m_view->resize(640, 360);
        QCOMPARE(count(), many);
    }

    void aThemeColoursItsMarks()
    {
        m_view->setMarks({line(2.0, false)});
        m_view->setCursor(5.0);
        for (const Theme::Kind kind : {Theme::Kind::Dark, Theme::Kind::HighContrast, Theme::Kind::Light}) {
            m_view->setPalette(Theme::palette(kind));
            const QSet<QRgb> colours = test::coloursOf(*m_view);
            for (const QColor &colour :
                 {Theme::colours(kind).canvas, Theme::colours(kind).threshold, Theme::colours(kind).accent})
                QVERIFY2(colours.contains(colour.rgb()), qPrintable(Theme::nameOf(kind) + ' ' + colour.name()));
        }
    }

private:
    static const Theme::Colours &light() { return Theme::colours(Theme::Kind::Light); }
    /// Where a colour is on the canvas, within its frame.
    QRect placeOf(const QColor &colour) const
    {
        const QImage image = test::imageOf(*m_view);
        return test::pixelsWhere(image, image.rect().adjusted(3, 3, -3, -3),
                                 [&](QRgb one) { return one == colour.rgb(); })
            .boundingRect();
    }
    QPoint pixel(double x, double y) const { return m_view->canvasPosition(x, y).toPoint(); }

    std::unique_ptr<MarkedPlot> m_view;
};

FAINTLINE_WINDOW_TEST(tst_MarkedPlot)
#include "tst_MarkedPlot.moc"

#include "support/test.h"
#include "widgets/plot/BarPlot.h"

#include "pixels.h"
#include "widgets/base/Theme.h"

#include <cmath>
#include <limits>

using namespace faintline;

/// Bars over whole numbers: where they stand, how high, in which colour, and which one a click is on.
class tst_BarPlot : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }
    void cleanup() { Theme::setPlotScale(1.0); }

    void barsStandWhereTheyBelong()
    {
        BarPlot view;
        view.setBars({{"noise", 0, {0.0, 0.0, 4.0}}, {"target", 1, {8.0, 0.0, 0.0}}}, 1);
        test::show(view);
        const QImage image = test::imageOf(view);
        const auto at = [&](double x, double y) { return test::colourAt(image, view.canvasPosition(x, y)); };
        QCOMPARE(at(2.8, 2.0), curve(0));
        QCOMPARE(at(1.2, 6.0), curve(1));
        QVERIFY(at(2.8, 4.5) != curve(0)); // above its bar
        QVERIFY(at(2.0, 1.0) != curve(0));
        view.setBars({{"empty", 0, {3.0, 0.0}}, {"occupied", 1, {0.0, 2.0}}}, 1, true);
        const QImage wide = test::imageOf(view);
        QCOMPARE(test::colourAt(wide, view.canvasPosition(1.3, 1.0)), curve(0));
        QCOMPARE(test::colourAt(wide, view.canvasPosition(1.7, 1.0)), curve(1));
        view.setLeastHeight(40.0);
        QVERIFY(test::spanOf(view, QwtAxis::YLeft).contains(40.0));
    }

    void barsAreAsHighAsTheirValues()
    {
        BarPlot view;
        view.setBars({{"all", 2, {8.0, 2.0, 1.0}}}, -1); // places may be negative
        test::show(view);
        const double perUnit = view.canvasPosition(0, 0.0).y() - view.canvasPosition(0, 1.0).y();
        const double values[] = {8.0, 2.0, 1.0};
        for (int i = 0; i < 3; ++i)
            QVERIFY(std::abs(heightOf(view, i - 1, curve(2)) - perUnit * values[i]) <= 1.5);
    }

    void nothingIsNoBar()
    {
        BarPlot view;
        view.setBars({{"all", 0, {0.0, 5.0, -3.0}}}, 0);
        test::show(view);
        QCOMPARE(heightOf(view, 0, curve(0)), 0);
        QVERIFY(heightOf(view, 1, curve(0)) > 50);
        QCOMPARE(heightOf(view, 2, curve(0)), 0); // a count is never negative
    }

    void aValueThatIsNoNumberLeavesTheOthers()
    {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        BarPlot view;
        view.setBars({{"all", 0, {nan, 5.0, nan}}}, 0);
        test::show(view);
        QCOMPARE(test::spanOf(view, QwtAxis::YLeft), (Span{0.0, 6.25}));
        QCOMPARE(heightOf(view, 0, curve(0)), 0);
        QVERIFY(heightOf(view, 1, curve(0)) > 50);
    }

    void theOrdinateReachesOverEveryBar()
    {
        BarPlot view;
        for (const double highest : {1e-9, 0.25, 1.0, 3e6}) {
            view.setBars({{"a", 0, {0.5 * highest}}, {"b", 1, {highest, 0.0}}}, 0);
            QVERIFY(test::spanOf(view, QwtAxis::YLeft).high > highest
                    && test::spanOf(view, QwtAxis::YLeft).high < 2.0 * highest);
            QCOMPARE(test::spanOf(view, QwtAxis::YLeft).low, 0.0);
        }
        view.setBars({{"a", 0, {0.0, 0.0}}}, 0); // nothing counted yet
        QCOMPARE(test::spanOf(view, QwtAxis::YLeft), (Span{0.0, 1.0}));
    }

    void aMillionPlacesAreDrawn()
    {
        BarPlot view;
        std::vector<double> values(1000000, 1.0);
        values[500000] = 100.0;
        view.setBars({{"all", 0, std::move(values)}}, 1);
        test::show(view);
        QVERIFY(test::spanOf(view, QwtAxis::XBottom).contains(1.0)
                && test::spanOf(view, QwtAxis::XBottom).contains(1e6));
        const QImage image = test::imageOf(view);
        QVERIFY(test::coloursOf(image).size() > 2); // bars so thin are blended with what is between them
        const QRgb low = test::colourAt(image, view.canvasPosition(2e5, 0.5));
        QVERIFY(low != Theme::colours(Theme::Kind::Light).canvas.rgb());
    }

    void aBarCanBeClicked()
    {
        BarPlot view;
        view.setBars({{"all", 0, {1.0, 2.0, 3.0}}}, 5);
        test::show(view);
        QSignalSpy bars(&view, &BarPlot::barActivated);
        for (const double x : {5.0, 6.1, 6.9}) // the gap between two bars belongs to the nearer one
            QTest::mouseClick(view.canvas(), Qt::LeftButton, {}, view.canvasPosition(x, 1.0).toPoint());
        QCOMPARE(bars.count(), 3);
        QCOMPARE(bars[0][0].toInt(), 5);
        QCOMPARE(bars[1][0].toInt(), 6);
        QCOMPARE(bars[2][0].toInt(), 7);
    }

    void everyPlaceOfTheLongestKindCanBeClicked()
    {
        BarPlot view;
        view.setBars({{"noise", 0, {1.0}}, {"target", 1, {1.0, 2.0, 3.0}}}, 1);
        test::show(view);
        QSignalSpy bars(&view, &BarPlot::barActivated);
        QTest::mouseClick(view.canvas(), Qt::LeftButton, {}, view.canvasPosition(3.2, 1.0).toPoint());
        QCOMPARE(bars.count(), 1);
        QCOMPARE(bars[0][0].toInt(), 3);
    }

    void besideTheBarsNothingIsClicked()
    {
        BarPlot view;
        view.setBars({{"all", 0, {1.0, 2.0}}}, 1);
        test::show(view);
        QSignalSpy bars(&view, &BarPlot::barActivated);
        QTest::mouseClick(view.canvas(), Qt::LeftButton, {}, view.canvasPosition(0.45, 1.0).toPoint());
        QTest::mouseClick(view.canvas(), Qt::LeftButton, {}, view.canvasPosition(2.55, 1.0).toPoint());
        QTest::mouseClick(view.canvas(), Qt::RightButton, {}, view.canvasPosition(1.0, 0.5).toPoint());
        QCOMPARE(bars.count(), 0);
        view.setBars({}, 1);
        QTest::mouseClick(view.canvas(), Qt::LeftButton);
        QCOMPARE(bars.count(), 0);
    }

    void thePlaceChosenStaysBright()
    {
        BarPlot view;
        view.setBars({{"all", 0, {3.0, 3.0, 3.0}}}, 5);
        test::show(view);
        const auto isBright = [&](int place) {
            return test::colourAt(test::imageOf(view), view.canvasPosition(place, 0.5)) == curve(0);
        };
        QVERIFY(isBright(5) && isBright(6));
        view.setSelected(6);
        QVERIFY(isBright(6) && !isBright(5) && !isBright(7));
        view.setSelected(4); // before the first: none
        QVERIFY(isBright(5) && isBright(6) && isBright(7));
    }

    void theKeyNamesTheKinds()
    {
        BarPlot view;
        view.setBars({{"noise", 4, {0.0, 0.0, 0.0}}}, 0);
        test::show(view);
        QVERIFY(test::coloursOf(view).contains(curve(4))); // there is no bar: it is the key's
        const QImage one = test::imageOf(view);
        view.setBars({{"noise", 4, {0.0, 0.0, 0.0}}, {"a target", 1, {0.0, 0.0, 0.0}}}, 0);
        QVERIFY(test::coloursOf(view).contains(curve(4)) && test::coloursOf(view).contains(curve(1)));
        QVERIFY(test::imageOf(view) != one);
    }

    void theKeyGivesWayOnASmallPlot()
    {
        for (const double scale : {1.0, 2.0}) {
            Theme::setPlotScale(scale);
            BarPlot view;
            view.setBars({{"a name that is wider than the whole plot can be", 4, {0.0, 2.0}}}, 0);
            test::show(view, view.minimumSizeHint());
            const QImage image = test::imageOf(view);
            const QPointF bar = view.canvasPosition(1.0, 1.9);
            QCOMPARE(test::colourAt(image, bar), curve(4)); // nothing lies over the bar
            QCOMPARE(test::colourAt(image, {image.width() - 12.0, 10.0}), Theme::colours(view).canvas.rgb());
        }
    }

    void withoutBarsASentence()
    {
        BarPlot view;
        view.setEmptySentence("Press Run.");
        test::show(view);
        QVERIFY(!view.isAxisVisible(QwtAxis::XBottom));
        const QImage sentence = test::imageOf(view);
        view.setBars({{"all", 0, {1.0}}}, 1);
        QVERIFY(view.isAxisVisible(QwtAxis::XBottom));
        view.setBars({}, 1);
        QCoreApplication::processEvents();
        QVERIFY(!view.isAxisVisible(QwtAxis::XBottom));
        QCOMPARE(test::imageOf(view), sentence);
    }

    void aClickTakesTheFocus()
    {
        QWidget window;
        auto *view = new BarPlot(&window);
        view->setBars({{"all", 0, {1.0, 2.0}}}, 1);
        view->resize(400, 250);
        test::show(window);
        view->clearFocus();
        QTest::mouseClick(view->canvas(), Qt::LeftButton, {}, view->canvasPosition(1.0, 0.5).toPoint());
        QVERIFY(view->hasFocus());
        QVERIFY(test::coloursOf(view->grab().toImage()).contains(Theme::colours(Theme::Kind::Light).accent.rgb()));
    }

private:
    static QRgb curve(int i) { return Theme::colours(Theme::Kind::Light).curves[i].rgb(); }
    /// Rows of pixels that a colour fills in the column above a place.
    static int heightOf(BarPlot &view, double place, QRgb colour)
    {
        const QImage image = test::imageOf(view);
        const int x = qRound(view.canvasPosition(place, 0.0).x());
        return int(test::pixelsWhere(image, {x, 0, 1, image.height()}, [&](QRgb one) { return one == colour; }).size());
    }
};

FAINTLINE_WINDOW_TEST(tst_BarPlot)
#include "tst_BarPlot.moc"

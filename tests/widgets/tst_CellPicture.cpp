#include "support/test.h"
#include "widgets/plot/CellPicture.h"

#include "pixels.h"
#include "widgets/base/Theme.h"
#include "widgets/plot/ColourMap.h"

#include <qwt_scale_div.h>
#include <qwt_scale_widget.h>
#include <qwt_text.h>

#include <algorithm>
#include <limits>

using namespace faintline;

/// A small picture of values: every cell in its place and colour, and paths over them.
class tst_CellPicture : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void cellsLieWhereTheirValuesSay()
    {
        CellPicture view;
        // Two columns of three cells; the brightest is the middle cell of the second.
        view.setPicture(stages(2), ranges(3), {0, 0, 0, 0, 1, 0}, {0.0, 1.0}, "P");
        test::show(view);
        const QImage image = test::imageOf(view);
        const auto lightness = [&](double x, double y) {
            return qGray(image.pixel(view.canvasPosition(x, y).toPoint()));
        };
        QVERIFY(lightness(2.0, 111.0) > 200);
        for (const auto &[x, y] :
             {std::pair(1.0, 111.0), std::pair(2.0, 101.0), std::pair(2.0, 121.0), std::pair(1.0, 101.0)})
            QVERIFY(lightness(x, y) < 30);
        QCOMPARE(view.axisTitle(QwtAxis::YLeft).text(), QString("range (m)"));
        QSignalSpy places(&view, &MarkedPlot::activated);
        QTest::mouseClick(view.canvas(), Qt::LeftButton, {}, view.canvasPosition(2.0, 110.0).toPoint());
        QVERIFY(std::abs(places[0][0].toDouble() - 2.0) < 0.02);
        QVERIFY(std::abs(places[0][1].toDouble() - 110.0) < 0.5);
    }

    void everyValueHasItsColour()
    {
        CellPicture view;
        const std::vector<float> values{-30.0f, -20.0f, -10.0f, 0.0f, 10.0f, -1e30f};
        view.setPicture(stages(2), ranges(3), values, {-20.0, 0.0}, "dB");
        test::show(view);
        const QImage image = test::imageOf(view);
        const double shares[] = {0.0, 0.0, 0.5, 1.0, 1.0, 0.0}; // beyond the range as at its ends
        for (int i = 0; i < 6; ++i) {
            const QPointF middle = view.canvasPosition(1.0 + i / 3, 101.0 + 10.0 * (i % 3));
            QCOMPARE(test::colourAt(image, middle), colourOf(shares[i]));
        }
    }

    void oneBrightCellAmongManyIsSeen()
    {
        CellPicture view;
        std::vector<float> values(3000 * 4000, 0.0f);
        values[1500 * 4000 + 2000] = 1.0f;
        view.setPicture(stages(3000), {"cell", "", 0.0, 1.0, 4000, false}, std::move(values), {0.0, 1.0}, "P");
        test::show(view);
        const QImage image = test::imageOf(view);
        const QRect inFrame = image.rect().adjusted(3, 3, -3, -3);
        const auto bright = test::pixelsWhere(image, inFrame, [](QRgb colour) { return qGray(colour) > 200; }).size();
        QVERIFY2(bright >= 1 && bright <= 9, qPrintable(QString::number(bright)));
    }

    void theBarSaysWhatColoursMean()
    {
        CellPicture view;
        view.setPicture(stages(2), ranges(1), {0.0f, 1.0f}, {-40.0, 0.0}, "lg P");
        test::show(view);
        QVERIFY(view.isAxisVisible(QwtAxis::YRight));
        QCOMPARE(view.axisTitle(QwtAxis::YRight).text(), QString("lg P"));
        QCOMPARE(view.axisScaleDiv(QwtAxis::YRight).lowerBound(), -40.0);
        QCOMPARE(view.axisScaleDiv(QwtAxis::YRight).upperBound(), 0.0);
        const QSet<QRgb> bar = test::coloursOf(view.axisWidget(QwtAxis::YRight)->grab().toImage());
        for (const double share : {0.02, 0.25, 0.5, 0.75, 0.98}) {
            const QColor wanted(colourOf(share));
            QVERIFY(std::any_of(bar.begin(), bar.end(), [&](const QColor &one) {
                return std::abs(one.red() - wanted.red()) + std::abs(one.green() - wanted.green())
                           + std::abs(one.blue() - wanted.blue())
                       < 12;
            }));
        }
    }

    void oneValueEverywhereIsDrawn()
    {
        CellPicture view;
        view.setPicture(stages(3), ranges(3), std::vector<float>(9, 2.0f), {2.0, 2.0}, "P"); // a range of no width
        test::show(view);
        QCOMPARE(test::colourAt(test::imageOf(view), view.canvasPosition(2.0, 111.0)), colourOf(0.0));
        view.setPicture(stages(1), ranges(1), {0.5f}, {0.0, 1.0}, "P"); // one cell fills the canvas
        const QImage one = test::imageOf(view);
        QCOMPARE(test::colourAt(one, {5.0, 5.0}), colourOf(0.5));
        QCOMPARE(test::colourAt(one, {one.width() - 6.0, one.height() - 6.0}), colourOf(0.5));
    }

    void valuesThatAreNoNumbersAreDrawn_data()
    {
        QTest::addColumn<float>("value");
        QTest::addColumn<double>("share");
        QTest::newRow("nan") << std::numeric_limits<float>::quiet_NaN() << 0.0;
        QTest::newRow("-inf") << -std::numeric_limits<float>::infinity() << 0.0; // ln 0
        QTest::newRow("inf") << std::numeric_limits<float>::infinity() << 1.0;
    }

    void valuesThatAreNoNumbersAreDrawn()
    {
        QFETCH(float, value);
        QFETCH(double, share);
        CellPicture view;
        view.setPicture(stages(2), ranges(1), {value, 0.5f}, {0.0, 1.0}, "P");
        test::show(view);
        const QImage image = test::imageOf(view);
        QCOMPARE(test::colourAt(image, view.canvasPosition(1.0, 101.0)), colourOf(share));
        QCOMPARE(test::colourAt(image, view.canvasPosition(2.0, 101.0)), colourOf(0.5));
    }

    void theNextPictureReplacesTheLast()
    {
        CellPicture view;
        view.setPicture(stages(2), ranges(1), {0.0f, 1.0f}, {0.0, 1.0}, "P");
        test::show(view);
        view.grab();
        view.setPicture(stages(2), ranges(1), {1.0f, 0.0f}, {0.0, 1.0}, "P"); // of the same size
        const QImage image = test::imageOf(view);
        QCOMPARE(test::colourAt(image, view.canvasPosition(1.0, 101.0)), colourOf(1.0));
        QCOMPARE(test::colourAt(image, view.canvasPosition(2.0, 101.0)), colourOf(0.0));
    }

    void pathsAreNamed()
    {
        CellPicture view;
        view.setPicture(stages(4), {"range", "cell", 0.0, 1.0, 8, false}, std::vector<float>(32, 0.0f), {0.0, 1.0},
                        "P");
        test::show(view);
        const QColor colour(10, 250, 20);
        QVERIFY(!test::coloursOf(view).contains(colour.rgb()));
        view.setPaths({{"truth", CellPicture::Path::Kind::Line, colour, {{1.0, 2.0}, {4.0, 6.0}}}});
        QVERIFY(test::coloursOf(view).contains(colour.rgb()));
        view.setPaths({{"nowhere", CellPicture::Path::Kind::Rings, colour, {}}});
        QVERIFY(!test::coloursOf(view).contains(colour.rgb()));
    }

    void pathsGoThroughTheirPoints()
    {
        using Kind = CellPicture::Path::Kind;
        CellPicture view;
        view.setPicture(stages(4), {"range", "cell", 0.0, 1.0, 8, false}, std::vector<float>(32, 0.0f), {0.0, 1.0},
                        "P");
        test::show(view);
        const QColor colour(10, 250, 20);
        const auto isGreenNear = [&](double x, double y, const QPointF &offset) {
            const QImage image = test::imageOf(view);
            const QPoint at = (view.canvasPosition(x, y) + offset).toPoint();
            bool isFound = false;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    isFound = isFound || qGreen(image.pixel(at + QPoint(dx, dy))) > 150;
            return isFound;
        };
        view.setPaths({{"line", Kind::Line, colour, {{2.0, 4.0}, {4.0, 4.0}}}});
        QVERIFY(isGreenNear(2.0, 4.0, {}) && isGreenNear(3.0, 4.0, {}) && !isGreenNear(1.5, 4.0, {}));
        view.setPaths({{"ring", Kind::Rings, colour, {{3.0, 4.0}}}});
        QVERIFY(isGreenNear(3.0, 4.0, {9.0, 0.0}) && isGreenNear(3.0, 4.0, {0.0, -9.0}) && !isGreenNear(3.0, 4.0, {}));
        view.setPaths({{"cross", Kind::Crosses, colour, {{3.0, 4.0}}}});
        QVERIFY(isGreenNear(3.0, 4.0, {}) && isGreenNear(3.0, 4.0, {5.0, 5.0}) && !isGreenNear(3.0, 4.0, {9.0, 0.0}));
    }

    void hostileNamesStayOnOneLine()
    {
        CellPicture view;
        view.setPicture({std::string(5000, 'x'), "m\n\u202e", 0.0, 1.0, 1, false}, ranges(1), {0.0f}, {0.0, 1.0}, "P");
        const QString title = view.axisTitle(QwtAxis::XBottom).text();
        QVERIFY2(title.size() < 60, qPrintable(title));
        QVERIFY(!title.contains(QLatin1Char('\n')) && !title.contains(QChar(0x202e)));
    }

    void emptySaysWhatToDo()
    {
        CellPicture view;
        view.setEmptySentence("Nothing yet.");
        test::show(view);
        const QImage before = view.grab().toImage();
        view.setEmptySentence("");
        QVERIFY(view.grab().toImage() != before);
        view.setPicture({"x", "", 0.0, 1.0, 1, false}, {"y", "", 0.0, 1.0, 1, false}, {1.0f}, {0.0, 1.0}, "P");
        QVERIFY(view.isAxisVisible(QwtAxis::XBottom));
        view.clear();
        QVERIFY(!view.isAxisVisible(QwtAxis::XBottom));
        QTest::mouseClick(view.canvas(), Qt::LeftButton);
        QTest::keyClick(&view, Qt::Key_Down);
    }

private:
    static Axis stages(Index count) { return {"stage", "", 1.0, 1.0, count, false}; }
    static Axis ranges(Index count) { return {"range", "m", 100.0, 10.0, count, false}; }
    static QRgb colourOf(double share) { return ColourMap::named(ColourMap::defaultName()).at(share) | 0xff000000; }
};

FAINTLINE_WINDOW_TEST(tst_CellPicture)
#include "tst_CellPicture.moc"

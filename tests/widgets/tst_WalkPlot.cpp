#include "widgets/plot/WalkPlot.h"

#include "widgets/base/Theme.h"
#include "widgets/plot/BarPlot.h"
#include "widgets/plot/CellPicture.h"

#include <qwt_scale_div.h>
#include <qwt_text.h>

#include <QSignalSpy>
#include <QtTest>

#include <memory>

using namespace faintline;

namespace {

QSet<QRgb> coloursOf(QwtPlot &plot)
{
    QSet<QRgb> colours;
    const QImage image = plot.canvas()->grab().toImage();
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            colours.insert(image.pixel(x, y) | 0xff000000);
    return colours;
}

void show(QWidget &view)
{
    view.resize(640, 360);
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
}

} // namespace

/// The plots of sequential tests: what is drawn, what a click asks for.
class tst_WalkPlot : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void everyHypothesisHasItsColour();
    void boundariesCutOffAndFixedSizeAreMarked();
    void aClickTakesTheNearestWalk();
    void endsBeyondTheEdgeCanBeClicked();
    void keysGoFromWalkToWalk();
    void fewerWalksForgetTheSelection();
    void wrongDecisionsAreRinged();
    void longWalksAreDrawn();
    void stagesAreWholeNumbers();
    void barsStandWhereTheyBelong();
    void aBarCanBeClicked();
    void cellsLieWhereTheirValuesSay();
    void oneBrightCellAmongManyIsSeen();
    void pathsAreNamed();
    void emptySaysWhatToDo();
    void themesChange();

private:
    static std::vector<WalkPlot::Walk> twoWalks()
    {
        return {{{-2.0, -4.0, -7.5}, SprtDecision::H0, false, false},
                {{1.0, 3.0, 5.0, 8.0}, SprtDecision::H1, true, false}};
    }
    static std::unique_ptr<WalkPlot> plot(std::vector<WalkPlot::Walk> walks = twoWalks())
    {
        auto made = std::make_unique<WalkPlot>();
        made->setTest({1e-3, 1e-3, 10}, Index(6));
        made->setWalks(std::move(walks));
        show(*made);
        return made;
    }
};

void tst_WalkPlot::everyHypothesisHasItsColour()
{
    const Theme::Colours &theme = Theme::colours(Theme::Kind::Light);
    const auto both = plot();
    both->setSelected(1);
    QVERIFY(coloursOf(*both).contains(theme.curves[1].rgb()));
    both->setSelected(0);
    QVERIFY(coloursOf(*both).contains(theme.curves[0].rgb()));
    const auto unknown = plot({{{0.5, 1.0}, SprtDecision::Undecided, std::nullopt, false}});
    unknown->setSelected(0);
    const QSet<QRgb> colours = coloursOf(*unknown);
    QVERIFY(colours.contains(theme.curves[2].rgb()));
    QVERIFY(!colours.contains(theme.curves[1].rgb()));
}

void tst_WalkPlot::boundariesCutOffAndFixedSizeAreMarked()
{
    const auto view = plot();
    QCOMPARE(view->marks().size(), std::size_t(4));
    QVERIFY(std::abs(view->marks()[0].at - std::log(999.0)) < 1e-9);
    QVERIFY(std::abs(view->marks()[1].at + std::log(999.0)) < 1e-9);
    QVERIFY(view->marks()[0].words.contains("6.91"));
    QCOMPARE(view->marks()[2].at, 6.0);
    QCOMPARE(view->marks()[3].at, 10.0);
    QVERIFY(view->ySpan().contains(view->marks()[0].at) && view->ySpan().contains(view->marks()[1].at));
    QVERIFY(view->xSpan().contains(10.0));
    view->setTest({1e-3, 1e-3, 0}, {});
    QCOMPARE(view->marks().size(), std::size_t(2));
}

void tst_WalkPlot::aClickTakesTheNearestWalk()
{
    const auto view = plot();
    QSignalSpy walks(view.get(), &WalkPlot::walkActivated);
    QSignalSpy places(view.get(), &MarkedPlot::activated);
    QTest::mouseClick(view->canvas(), Qt::LeftButton, {}, (view->position(1, 2) + QPointF(4, 3)).toPoint());
    QCOMPARE(walks.count(), 1);
    QCOMPARE(walks[0][0].toInt(), 1);
    QCOMPARE(places.count(), 1);
    QVERIFY(std::abs(places[0][0].toDouble() - 2.0) < 0.3);
    QTest::mouseClick(view->canvas(), Qt::LeftButton, {}, view->position(0, 3).toPoint());
    QCOMPARE(walks[1][0].toInt(), 0);
    QTest::mouseClick(view->canvas(), Qt::LeftButton, {}, view->canvasPosition(9.0, 0.0).toPoint()); // far from any
    QCOMPARE(walks.count(), 2);
    QCOMPARE(places.count(), 3);
}

void tst_WalkPlot::endsBeyondTheEdgeCanBeClicked()
{
    const auto view = plot({{{1.0, 400.0}, SprtDecision::H1, true, false}});
    const QPointF end = view->position(0, 2);
    QVERIFY(end.y() >= 0.0);
    QSignalSpy walks(view.get(), &WalkPlot::walkActivated);
    QTest::mouseClick(view->canvas(), Qt::LeftButton, {}, QPoint(qRound(end.x()), 5));
    QCOMPARE(walks.count(), 1);
}

void tst_WalkPlot::keysGoFromWalkToWalk()
{
    const auto view = plot();
    QSignalSpy walks(view.get(), &WalkPlot::walkActivated);
    view->setSelected(0);
    QTest::keyClick(view.get(), Qt::Key_Down);
    QTest::keyClick(view.get(), Qt::Key_Up); // there is none before the first
    QCOMPARE(walks.count(), 2);
    QCOMPARE(walks[0][0].toInt(), 1);
    QCOMPARE(walks[1][0].toInt(), 0);
}

void tst_WalkPlot::fewerWalksForgetTheSelection()
{
    const auto view = plot();
    view->setSelected(1);
    view->setWalks({twoWalks().front()});
    QCOMPARE(view->selected(), -1);
    view->setSelected(7);
    QCOMPARE(view->selected(), -1);
    view->setWalks({});
    view->grab();
}

void tst_WalkPlot::wrongDecisionsAreRinged()
{
    const QRgb ring = Theme::colours(Theme::Kind::Light).error.rgb();
    QVERIFY(!coloursOf(*plot()).contains(ring));
    std::vector<WalkPlot::Walk> walks = twoWalks();
    walks[0].hasTarget = true; // missed
    QVERIFY(coloursOf(*plot(walks)).contains(ring));
    walks[0].hasTarget.reset(); // not known: nothing is wrong
    QVERIFY(!coloursOf(*plot(walks)).contains(ring));
}

void tst_WalkPlot::longWalksAreDrawn()
{
    WalkPlot::Walk walk;
    walk.lnLambda.assign(300000, -1.0);
    const auto view = plot({walk});
    view->setSelected(0);
    QVERIFY(coloursOf(*view).contains(Theme::colours(Theme::Kind::Light).curves[2].rgb()));
    QVERIFY(view->xSpan().contains(300000.0));
}

void tst_WalkPlot::stagesAreWholeNumbers()
{
    const auto view = plot();
    for (const double tick : view->axisScaleDiv(QwtAxis::XBottom).ticks(QwtScaleDiv::MajorTick))
        QCOMPARE(tick, std::round(tick));
}

void tst_WalkPlot::barsStandWhereTheyBelong()
{
    BarPlot view;
    view.setBars({{"noise", 0, {0.0, 0.0, 4.0}}, {"target", 1, {8.0, 0.0, 0.0}}}, 1);
    show(view);
    const QImage image = view.canvas()->grab().toImage();
    const Theme::Colours &theme = Theme::colours(Theme::Kind::Light);
    const auto at = [&](double x, double y) { return image.pixel(view.canvasPosition(x, y).toPoint()) | 0xff000000; };
    QCOMPARE(at(2.8, 2.0), theme.curves[0].rgb());
    QCOMPARE(at(1.2, 6.0), theme.curves[1].rgb());
    QVERIFY(at(2.8, 4.5) != theme.curves[0].rgb()); // above its bar
    QVERIFY(at(2.0, 1.0) != theme.curves[0].rgb());
    view.setBars({{"empty", 0, {3.0, 0.0}}, {"occupied", 1, {0.0, 2.0}}}, 1, true);
    const QImage wide = view.canvas()->grab().toImage();
    QCOMPARE(wide.pixel(view.canvasPosition(1.3, 1.0).toPoint()) | 0xff000000, theme.curves[0].rgb());
    QCOMPARE(wide.pixel(view.canvasPosition(1.7, 1.0).toPoint()) | 0xff000000, theme.curves[1].rgb());
    view.setLeastHeight(40.0);
    QVERIFY(view.ySpan().contains(40.0));
}

void tst_WalkPlot::aBarCanBeClicked()
{
    BarPlot view;
    view.setBars({{"all", 0, {1.0, 2.0, 3.0}}}, 5);
    show(view);
    QSignalSpy bars(&view, &BarPlot::barActivated);
    QTest::mouseClick(view.canvas(), Qt::LeftButton, {}, view.canvasPosition(6.1, 1.0).toPoint());
    QCOMPARE(bars.count(), 1);
    QCOMPARE(bars[0][0].toInt(), 6);
    view.setSelected(6); // the others fade
    const QImage image = view.canvas()->grab().toImage();
    const QRgb full = Theme::colours(Theme::Kind::Light).curves[0].rgb();
    QCOMPARE(image.pixel(view.canvasPosition(6.0, 0.5).toPoint()) | 0xff000000, full);
    QVERIFY((image.pixel(view.canvasPosition(5.0, 0.5).toPoint()) | 0xff000000) != full);
}

void tst_WalkPlot::cellsLieWhereTheirValuesSay()
{
    CellPicture view;
    // Two columns of three cells; the brightest is the middle cell of the second.
    view.setPicture({"stage", "", 1.0, 1.0, 2, false}, {"range", "m", 100.0, 10.0, 3, false}, {0, 0, 0, 0, 1, 0},
                    {0.0, 1.0}, "P");
    show(view);
    const QImage image = view.canvas()->grab().toImage();
    const auto lightness = [&](double x, double y) { return qGray(image.pixel(view.canvasPosition(x, y).toPoint())); };
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

void tst_WalkPlot::oneBrightCellAmongManyIsSeen()
{
    CellPicture view;
    std::vector<float> values(3000 * 4000, 0.0f);
    values[1500 * 4000 + 2000] = 1.0f;
    view.setPicture({"stage", "", 1.0, 1.0, 3000, false}, {"cell", "", 0.0, 1.0, 4000, false}, std::move(values),
                    {0.0, 1.0}, "P");
    show(view);
    const QImage image = view.canvas()->grab().toImage();
    int bright = 0;
    for (int y = 3; y < image.height() - 3; ++y) // within the canvas's frame
        for (int x = 3; x < image.width() - 3; ++x)
            bright += qGray(image.pixel(x, y)) > 200 ? 1 : 0;
    QVERIFY2(bright >= 1 && bright <= 9, qPrintable(QString::number(bright)));
}

void tst_WalkPlot::pathsAreNamed()
{
    CellPicture view;
    view.setPicture({"stage", "", 1.0, 1.0, 4, false}, {"range", "cell", 0.0, 1.0, 8, false},
                    std::vector<float>(32, 0.0f), {0.0, 1.0}, "P");
    show(view);
    const QColor colour(10, 250, 20);
    QVERIFY(!coloursOf(view).contains(colour.rgb()));
    view.setPaths({{"truth", CellPicture::Path::Kind::Line, colour, {{1.0, 2.0}, {4.0, 6.0}}}});
    QVERIFY(coloursOf(view).contains(colour.rgb()));
    view.setPaths({{"nowhere", CellPicture::Path::Kind::Rings, colour, {}}});
    QVERIFY(!coloursOf(view).contains(colour.rgb()));
}

void tst_WalkPlot::emptySaysWhatToDo()
{
    CellPicture view;
    view.setEmptySentence("Nothing yet.");
    show(view);
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

void tst_WalkPlot::themesChange()
{
    const auto view = plot();
    view->setPalette(Theme::palette(Theme::Kind::Dark));
    QVERIFY(coloursOf(*view).contains(Theme::colours(Theme::Kind::Dark).canvas.rgb()));
}

QTEST_MAIN(tst_WalkPlot)
#include "tst_WalkPlot.moc"

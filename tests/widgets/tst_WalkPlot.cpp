#include "support/test.h"
#include "widgets/plot/WalkPlot.h"

#include "pixels.h"
#include "widgets/base/Theme.h"

#include <qwt_scale_div.h>

#include <memory>

using namespace faintline;

/// The walks of sequential tests: what is drawn, what a click asks for.
class tst_WalkPlot : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void everyHypothesisHasItsColour()
    {
        const Theme::Colours &theme = Theme::colours(Theme::Kind::Light);
        const auto both = plot();
        both->setSelected(1);
        QVERIFY(test::coloursOf(*both).contains(theme.curves[1].rgb()));
        both->setSelected(0);
        QVERIFY(test::coloursOf(*both).contains(theme.curves[0].rgb()));
        const auto unknown = plot({{{0.5, 1.0}, SprtDecision::Undecided, std::nullopt, false}});
        unknown->setSelected(0);
        const QSet<QRgb> colours = test::coloursOf(*unknown);
        QVERIFY(colours.contains(theme.curves[2].rgb()));
        QVERIFY(!colours.contains(theme.curves[1].rgb()));
    }

    void boundariesCutOffAndFixedSizeAreMarked()
    {
        const auto view = plot();
        QCOMPARE(view->marks().size(), std::size_t(4));
        QVERIFY(std::abs(view->marks()[0].at - std::log(999.0)) < 1e-9);
        QVERIFY(std::abs(view->marks()[1].at + std::log(999.0)) < 1e-9);
        QVERIFY(view->marks()[0].words.contains("6.91"));
        QCOMPARE(view->marks()[2].at, 6.0);
        QCOMPARE(view->marks()[3].at, 10.0);
        QVERIFY(test::spanOf(*view, QwtAxis::YLeft).contains(view->marks()[0].at)
                && test::spanOf(*view, QwtAxis::YLeft).contains(view->marks()[1].at));
        QVERIFY(test::spanOf(*view, QwtAxis::XBottom).contains(10.0));
        view->setTest({1e-3, 1e-3, 0}, {});
        QCOMPARE(view->marks().size(), std::size_t(2));
    }

    void aClickTakesTheNearestWalk()
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

    void endsBeyondTheEdgeCanBeClicked()
    {
        const auto view = plot({{{1.0, 400.0}, SprtDecision::H1, true, false}});
        const QPointF end = view->position(0, 2);
        QVERIFY(end.y() >= 0.0);
        QSignalSpy walks(view.get(), &WalkPlot::walkActivated);
        QTest::mouseClick(view->canvas(), Qt::LeftButton, {}, QPoint(qRound(end.x()), 5));
        QCOMPARE(walks.count(), 1);
    }

    void keysGoFromWalkToWalk()
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

    void fewerWalksForgetTheSelection()
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

    void wrongDecisionsAreRinged()
    {
        const QRgb ring = Theme::colours(Theme::Kind::Light).error.rgb();
        QVERIFY(!test::coloursOf(*plot()).contains(ring));
        std::vector<WalkPlot::Walk> walks = twoWalks();
        walks[0].hasTarget = true; // missed
        QVERIFY(test::coloursOf(*plot(walks)).contains(ring));
        walks[0].hasTarget.reset(); // not known: nothing is wrong
        QVERIFY(!test::coloursOf(*plot(walks)).contains(ring));
    }

    void longWalksAreDrawn()
    {
        WalkPlot::Walk walk;
        walk.lnLambda.assign(300000, -1.0);
        const auto view = plot({walk});
        view->setSelected(0);
        QVERIFY(test::coloursOf(*view).contains(Theme::colours(Theme::Kind::Light).curves[2].rgb()));
        QVERIFY(test::spanOf(*view, QwtAxis::XBottom).contains(300000.0));
    }

    void stagesAreWholeNumbers()
    {
        const auto view = plot();
        for (const double tick : view->axisScaleDiv(QwtAxis::XBottom).ticks(QwtScaleDiv::MajorTick))
            QCOMPARE(tick, std::round(tick));
    }

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
        test::show(*made);
        return made;
    }
};

FAINTLINE_WINDOW_TEST(tst_WalkPlot)
#include "tst_WalkPlot.moc"

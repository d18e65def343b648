#include "support/test.h"
#include "widgets/base/TimeStack.h"

#include "pictures.h"
#include "pixels.h"
#include "widgets/base/Theme.h"
#include "widgets/plot/StripPlot.h"
#include "widgets/waterfall/ColourBar.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QVBoxLayout>

using namespace faintline;

namespace {

/// Two pictures whose frequencies need labels of different widths, one with a bar of colours, and two curves, one with
/// an axis on the right.
struct Column {
    Viewport viewport;
    QWidget window;
    WaterfallView *upper = new WaterfallView("upper");
    WaterfallView *lower = new WaterfallView("lower");
    QWidget *upperPane = ColourBar::pane(upper);
    StripPlot *curve = new StripPlot("D (nat)");
    StripPlot *both = new StripPlot("ln K (nat)");
    TimeStack stack;

    Column()
    {
        viewport.setExtents({0.0, 200.0}, {99.0, 119.0}, 1.0, 2.0);
        auto *layout = new QVBoxLayout(&window);
        layout->setSpacing(0);
        for (QWidget *widget : std::initializer_list<QWidget *>{upperPane, lower, curve, both})
            layout->addWidget(widget, 1);
        for (WaterfallView *view : {upper, lower}) {
            view->direction().set(WaterfallView::Orientation::LeftToRight);
            view->setMinimumSize(100, 80);
            view->setViewport(&viewport);
        }
        for (StripPlot *strip : {curve, both}) {
            strip->setViewport(&viewport);
            strip->setSeries("D", test::timeAxis(200), std::vector<float>(200, 1.0f));
        }
        both->setSeries("right", test::timeAxis(200), std::vector<float>(200, 12345.0f), StripPlot::Side::Right);
        upper->setPicture(test::countingPicture(200, 10), test::hzAxis(10));
        lower->setPicture(test::countingPicture(200, 10), test::hzAxis(10, 100.0, 1234.567));
        stack.add(*upper, *upperPane);
        stack.add(*lower, *lower);
        stack.add(*curve, *curve);
        stack.add(*both, *both);
    }

    std::vector<ThemedPlot *> plots() const { return {upper, lower, curve, both}; }

    /// Left and right edge of a canvas in the window.
    std::pair<int, int> edges(const ThemedPlot &plot) const
    {
        const int left = plot.canvas()->mapTo(&window, QPoint()).x();
        return {left, left + plot.canvas()->width()};
    }

    bool areAligned() const
    {
        for (const ThemedPlot *plot : plots())
            if (plot->isVisible() && edges(*plot) != edges(*upper))
                return false;
        return true;
    }

    void show(QSize size = {700, 700})
    {
        test::show(window, size);
        QCoreApplication::processEvents();
    }
};

bool labelsTime(const ThemedPlot &plot)
{
    return plot.isAxisVisible(QwtAxis::XBottom);
}

} // namespace

/// Canvases on one time axis.
class tst_TimeStack : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void canvasesHaveTheSameEdges()
    {
        Column column;
        column.show();
        QVERIFY(!column.areAligned()); // by themselves they are not
        column.stack.setOn(true);
        QCoreApplication::processEvents();
        QVERIFY(column.areAligned());
        column.window.resize(900, 640);
        QCoreApplication::processEvents();
        QVERIFY(column.areAligned());
        QVERIFY(column.edges(*column.upper).second > 700);
        column.upperPane->findChild<ColourBar *>()->hide();
        QCoreApplication::processEvents();
        QVERIFY(column.areAligned());
        column.lower->setPicture(test::countingPicture(200, 10), test::hzAxis(10, 1e5, 98765.4321));
        column.viewport.setExtents({0.0, 20000.0}, {1e5, 1.1e6}, 1.0, 2.0);
        QCoreApplication::processEvents();
        QVERIFY(column.areAligned());
    }

    /// The same time is the same pixel.
    void aTimeIsAtOnePlace()
    {
        Column column;
        column.stack.setOn(true);
        column.show();
        column.viewport.zoomTo({37.0, 149.0}, {103.0, 113.0});
        QCoreApplication::processEvents();
        QVERIFY(column.areAligned());
        for (const double seconds : {37.0, 80.0, 149.0}) {
            const double here = column.both->transform(QwtAxis::XBottom, seconds);
            for (const ThemedPlot *plot : column.plots())
                QVERIFY2(std::abs(plot->transform(QwtAxis::XBottom, seconds) - here) <= 1.0,
                         qPrintable(QString::number(plot->transform(QwtAxis::XBottom, seconds) - here)));
        }
    }

    void onlyTheLowestVisibleLabelsTime()
    {
        Column column;
        column.stack.setOn(true);
        column.show();
        QVERIFY(!labelsTime(*column.upper) && !labelsTime(*column.lower) && !labelsTime(*column.curve));
        QVERIFY(labelsTime(*column.both));
        column.both->hide();
        QCoreApplication::processEvents();
        QVERIFY(labelsTime(*column.curve) && !labelsTime(*column.lower));
        column.curve->hide();
        QCoreApplication::processEvents();
        QVERIFY(labelsTime(*column.lower) && !labelsTime(*column.upper));
        column.both->show();
        QCoreApplication::processEvents();
        QVERIFY(labelsTime(*column.both) && !labelsTime(*column.lower));
        QVERIFY(column.areAligned());
    }

    void switchedOffEachIsByItself()
    {
        Column column;
        column.show();
        std::vector<QRect> before;
        for (const ThemedPlot *plot : column.plots())
            before.push_back(plot->canvas()->geometry());
        column.stack.setOn(true);
        QCoreApplication::processEvents();
        column.stack.setOn(false);
        QCoreApplication::processEvents();
        for (std::size_t i = 0; i < before.size(); ++i) {
            QCOMPARE(column.plots()[i]->canvas()->geometry(), before[i]);
            QVERIFY(labelsTime(*column.plots()[i]));
        }
    }

    /// A part is as it would be without the others.
    void aPartHasItsOwnAxis()
    {
        Column column;
        column.stack.setOn(true);
        column.show();
        const auto edges = column.edges(*column.upper);
        {
            const TimeStack::Part part(column.stack, *column.upperPane);
            QVERIFY(labelsTime(*column.upper));
            QCOMPARE(column.upper->sideRooms(), QMargins());
        }
        QVERIFY(!labelsTime(*column.upper));
        QVERIFY(column.edges(*column.upper) == edges);
        QVERIFY(column.areAligned());
    }

    void aPlotInAWindowOfItsOwnIsByItself()
    {
        Column column;
        column.stack.setOn(true);
        column.show();
        column.upperPane->setParent(nullptr);
        column.upperPane->show();
        QCoreApplication::processEvents();
        QVERIFY(labelsTime(*column.upper));
        QCOMPARE(column.upper->sideRooms(), QMargins());
        QVERIFY(labelsTime(*column.both) && !labelsTime(*column.lower));
        QVERIFY(column.edges(*column.lower) == column.edges(*column.both));
        delete column.upperPane; // the stack forgets it
        column.window.resize(500, 500);
        QCoreApplication::processEvents();
        QVERIFY(column.edges(*column.lower) == column.edges(*column.both));
    }
};

FAINTLINE_WINDOW_TEST(tst_TimeStack)
#include "tst_TimeStack.moc"

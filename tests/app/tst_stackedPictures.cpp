// Pictures side by side, or above each other on one time axis.

#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "app/views/WindowViews.h"
#include "support/test.h"
#include "widgets/plot/StripPlot.h"

using namespace faintline;
using namespace faintline::test;
using Orientation = WaterfallView::Orientation;

namespace {

const QByteArray lines = R"({"sampleRateHz": 2000, "durationSeconds": 40, "noise": {"deviation": 0.1},
    "lines": [{"snrDb": 15, "referenceSeconds": 0.5, "frequencyHz": 320}]})";

void makeQuick(AnalysisSettings &settings)
{
    settings.spectrogram.windowSeconds = 0.5;
    setSetting(settings, "detector.kind", "energy");
}

QPoint cornerOf(const QWidget &widget, const QWidget &window)
{
    return widget.mapTo(&window, QPoint());
}

/// Left and right edge of a canvas in the window.
std::pair<int, int> edges(const ThemedPlot &plot, const QWidget &window)
{
    const int left = cornerOf(*plot.canvas(), window).x();
    return {left, left + plot.canvas()->width()};
}

bool labelsTime(const ThemedPlot &plot)
{
    return plot.isAxisVisible(QwtAxis::XBottom);
}

} // namespace

class tst_stackedPictures : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void areAboveEachOtherWhenTimeRunsFromLeftToRight_data()
    {
        QTest::addColumn<QSize>("size");
        QTest::newRow("small") << QSize(1280, 800);
        QTest::newRow("large") << QSize(1920, 1080);
    }

    void areAboveEachOtherWhenTimeRunsFromLeftToRight()
    {
        QFETCH(QSize, size);
        const auto window = newWindow(size);
        QVERIFY(openAndSettle(*window, writeFile(m_folder, "lines.json", lines), makeQuick));
        Workbench &bench = window->workbench();
        const WaterfallView &input = *bench.input(), &output = *bench.output();
        QCoreApplication::processEvents();
        QCOMPARE(cornerOf(input, *window).y(), cornerOf(output, *window).y());
        QVERIFY2(input.width() >= 350 && output.width() >= 350, qPrintable(QString::number(input.width())));

        for (int i = 0; i < 2; ++i) // newest on top, oldest on top, left to right
            QTest::keyClick(bench.output(), Qt::Key_O);
        QCOMPARE(output.direction().orientation(), Orientation::LeftToRight);
        QCoreApplication::processEvents();
        std::vector<ThemedPlot *> all{bench.input(), bench.output()};
        for (StripPlot *strip : {bench.statisticPlot(), bench.regulationPlot()})
            if (strip->isVisible())
                all.push_back(strip);
        QVERIFY(all.size() >= 3); // there is room for a curve
        for (std::size_t i = 1; i < all.size(); ++i) {
            QVERIFY(cornerOf(*all[i], *window).y() >= cornerOf(*all[i - 1], *window).y() + all[i - 1]->height());
            QVERIFY(edges(*all[i], *window) == edges(*all[0], *window));
        }
        for (const ThemedPlot *plot : all)
            QCOMPARE(labelsTime(*plot), plot == all.back());
        for (const WaterfallView *view : {&input, &output})
            QVERIFY2(view->canvas()->height() >= 150, qPrintable(QString::number(view->canvas()->height())));

        window->document().viewport().zoomTo({10.0, 20.0}, {100.0, 200.0});
        QCoreApplication::processEvents();
        for (const ThemedPlot *plot : all) {
            QVERIFY(edges(*plot, *window) == edges(*all[0], *window));
            QVERIFY(std::abs(plot->transform(QwtAxis::XBottom, 15.0) - input.transform(QwtAxis::XBottom, 15.0)) <= 1.0);
        }

        QTest::keyClick(bench.output(), Qt::Key_O);
        QCoreApplication::processEvents();
        QCOMPARE(cornerOf(input, *window).y(), cornerOf(output, *window).y());
        QVERIFY(labelsTime(*bench.statisticPlot()) && labelsTime(input));
    }

    /// The frequency axis of the one needs wider labels, and its bar of colours may be hidden.
    void staysAlignedWithALayer()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, writeFile(m_folder, "lines.json", lines), makeQuick));
        Workbench &bench = window->workbench();
        bench.output()->direction().set(Orientation::LeftToRight);
        QTest::keyClick(bench.output(), Qt::Key_V); // a layer has a key instead of the bar
        QCoreApplication::processEvents();
        QVERIFY(edges(*bench.input(), *window) == edges(*bench.output(), *window));
        QVERIFY(edges(*bench.input(), *window) == edges(*bench.statisticPlot(), *window));
    }

    void aSessionAndTheLayoutKeepIt()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, writeFile(m_folder, "lines.json", lines), makeQuick));
        Workbench &bench = window->workbench();
        const QByteArray sideBySide = bench.saveSplitters();
        bench.output()->direction().set(Orientation::LeftToRight);
        const ViewState view = bench.viewState();
        bench.output()->direction().set(Orientation::NewestOnTop);
        bench.restore(view);
        bench.restoreSplitters(sideBySide); // sizes of another arrangement
        QCoreApplication::processEvents();
        QVERIFY(cornerOf(*bench.output(), *window).y() > cornerOf(*bench.input(), *window).y());
        QVERIFY(edges(*bench.input(), *window) == edges(*bench.output(), *window));
    }

    /// The picture of a view has a time axis although a view below it has one, too.
    void aPictureOfOneViewHasItsOwnAxis()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, writeFile(m_folder, "lines.json", lines), makeQuick));
        Workbench &bench = window->workbench();
        bench.output()->direction().set(Orientation::LeftToRight);
        QCoreApplication::processEvents();
        QVERIFY(!labelsTime(*bench.input()));
        const QImage without = bench.inputView()->grab().toImage();
        const QImage with = window->views().grab("input").toImage();
        QVERIFY(!labelsTime(*bench.input()));
        QCOMPARE(with.size(), without.size());
        const auto lowestRows = [](const QImage &image) {
            return image.copy(0, image.height() - 24, image.width(), 24);
        };
        QVERIFY(lowestRows(with) != lowestRows(without));
        QVERIFY(bench.inputView()->grab().toImage() == without);
    }

    void historiesOfPingsShareTheAxisOfLnK()
    {
        const auto window = newWindow({1400, 1000});
        QVERIFY(openAndSettle(*window,
                              writeFile(m_folder, "pings.json",
                                        R"({"kind": "pings", "pings": 12, "rangeCells": 120, "beams": 8, "targets": [
    {"snrDb": 15, "rangeMetres": 3500, "bearingDegrees": 90}]})")));
        const PingBench &bench = window->pingBench();
        QCoreApplication::processEvents();
        const WaterfallView &range = *bench.alongHistory(), &bearing = *bench.acrossHistory();
        const auto *regulation = bench.findChildren<StripPlot *>().front();
        QVERIFY(regulation->isVisible());
        QVERIFY(cornerOf(bearing, *window).y() >= cornerOf(range, *window).y() + range.height());
        QVERIFY(edges(range, *window) == edges(bearing, *window));
        QVERIFY(edges(range, *window) == edges(*regulation, *window));
        QVERIFY(!labelsTime(range) && !labelsTime(bearing) && labelsTime(*regulation));
        bench.acrossHistory()->direction().set(Orientation::NewestOnTop);
        QCoreApplication::processEvents();
        QCOMPARE(range.direction().orientation(), Orientation::NewestOnTop);
        QCOMPARE(cornerOf(range, *window).y(), cornerOf(bearing, *window).y());
    }
};

FAINTLINE_WINDOW_TEST(tst_stackedPictures)
#include "tst_stackedPictures.moc"

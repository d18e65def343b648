// The start page: pictures of what comes with the program, there at once, which a click opens.

#include "app/document/OutputLayers.h"
#include "app/features/opening/Card.h"
#include "app/features/opening/WelcomePage.h"
#include "app/features/opening/scenarios.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/Workbench.h"
#include "app/features/sequential/SequentialPanel.h"
#include "app/features/sequential/TrajectoryPage.h"
#include "app/headless/comparePictures.h"
#include "app/headless/settleViews.h"
#include "app/openWindow.h"
#include "support/test.h"
#include "widgets/base/Theme.h"
#include "widgets/base/TimeStack.h"
#include "widgets/plot/CellPicture.h"
#include "widgets/plot/WalkPlot.h"

#include <qwt_plot_canvas.h>
#include <qwt_plot_item.h>

#include <QPainter>
#include <QPushButton>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr QSize half(448, 72); // two of them above each other, and a gap, make a picture
constexpr int gap = 2;

/// The plot's canvas in that size, without marks and keys. `pane`: the plot, or the widget that contains it.
QImage bare(QwtPlot &plot, double highestMark, QWidget &pane)
{
    for (QwtPlotItem *item : plot.itemList())
        if (item->z() > highestMark)
            item->hide();
    pane.setParent(nullptr);
    pane.show();
    for (int pass = 0; pass < 3; ++pass) {
        pane.resize(pane.size() + half - plot.canvas()->contentsRect().size());
        QCoreApplication::sendPostedEvents();
        plot.updateLayout();
    }
    plot.replot();
    QCoreApplication::processEvents();
    return plot.canvas()->grab(plot.canvas()->contentsRect()).toImage().convertToFormat(QImage::Format_RGB32);
}

QImage above(const QImage &upper, const QImage &lower)
{
    QImage both(half.width(), 2 * half.height() + gap, QImage::Format_RGB32);
    both.fill(Qt::black);
    QPainter painter(&both);
    painter.drawImage(0, 0, upper);
    painter.drawImage(0, half.height() + gap, lower);
    return both;
}

QImage linePicture(MainWindow &window)
{
    Workbench &bench = window.workbench();
    bench.output()->direction().set(WaterfallView::Orientation::LeftToRight);
    bench.layers().setLayer(OutputLayer::Presence);
    QWidget &input = *bench.inputView(), &output = *bench.outputView();
    const TimeStack::Part alone(bench.timeStack(), input);
    const QImage upper = bare(*bench.input(), 2.0, input);
    for (int pass = 0; pass < 2; ++pass) { // the layer is computed for the size, and its heading takes some
        bare(*bench.output(), 2.0, output);
        if (!settle(bench.layers()))
            return {};
    }
    return above(upper, bare(*bench.output(), 2.0, output));
}

QImage sonarPicture(const Analysis &analysis)
{
    const Axis &range = analysis.grid().axes.front();
    Viewport viewport;
    const Viewport::Box full = WaterfallView::extents(analysis.inputAlong.front()->time(), range);
    viewport.setExtents(full.time, full.frequency);
    const auto picture = [&](const std::shared_ptr<const PeakPyramid> &values, std::optional<double> threshold) {
        WaterfallView view(QString{});
        view.setViewport(&viewport);
        view.direction().set(WaterfallView::Orientation::LeftToRight);
        if (threshold)
            view.setThreshold(*threshold);
        view.display().setLayer(PictureDisplay::ThresholdLayer, false);
        view.setPicture(values, range);
        return bare(view, 2.0, view);
    };
    return above(picture(analysis.inputAlong.front(), {}),
                 picture(analysis.statisticAlong.front(), analysis.threshold));
}

/// Of one scan, and the walks of the tests.
QImage radarPicture(MainWindow &window)
{
    SequentialPanel &panel = window.panel<SequentialPanel>();
    CellPicture &scan = panel.trajectory().scan();
    return above(bare(scan, 10.0, scan), bare(panel.walk(), 20.0, panel.walk()));
}

/// Of 8 × 8 pixels, those with another colour: other rounding on another processor, or a track that lies a pixel or a
/// frame beside, does not date a picture; a track that is missing does.
int changedBlocks(const QImage &expected, const QImage &actual)
{
    const auto coarse = [](const QImage &picture) {
        return picture.scaled(picture.size() / 8, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
    };
    const QImage a = coarse(expected), b = coarse(actual);
    constexpr int visible = 20;
    int changed = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const QColor one = a.pixelColor(x, y), other = b.pixelColor(x, y);
            changed += std::abs(one.red() - other.red()) > visible || std::abs(one.green() - other.green()) > visible
                       || std::abs(one.blue() - other.blue()) > visible;
        }
    return changed;
}

} // namespace

class tst_Welcome : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Dark); }

    void showsAllPicturesAtOnce()
    {
        const auto window = newWindow();
        QVERIFY(window->welcome().isVisible());
        const auto cards = window->welcome().findChildren<Card *>();
        QCOMPARE(cards.size(), 6);
        for (const Card *card : cards) {
            QVERIFY2(QFile::exists(card->scenario().path), qPrintable(card->scenario().path));
            const QImage picture(card->scenario().picture);
            QCOMPARE(picture.size(), QSize(half.width(), 2 * half.height() + gap));
        }
        QVERIFY(!window->controller().isBusy());
        QVERIFY(!window->sequentialTests().isBusy());
    }

    void aClickOpensTheRecording()
    {
        const auto window = newWindow();
        Card *card = window->welcome().findChild<Card *>();
        QTest::mouseClick(card, Qt::LeftButton);
        QVERIFY(window->workbench().isVisible()); // at once, with what it waits for
        QVERIFY(settle(*window));
        QCOMPARE(window->document().sourcePath(), exampleRecordings().front().path);
        QVERIFY(window->document().analysis());
        QVERIFY(!window->document().shownEvents().empty());
    }

    void aMissingPartOfATrackDatesAPicture()
    {
        const QImage kept(scenarios().front().picture);
        QImage without = kept;
        QPainter(&without).fillRect(kept.width() / 2, half.height() + gap, kept.width(), half.height(), Qt::black);
        QVERIFY(changedBlocks(kept, without) > 10);
    }

    void theFaintLineIsFoundWhole()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, scenarios().front().path));
        const std::vector<Event> events = window->document().shownEvents();
        QCOMPARE(events.size(), std::size_t(1));
        const TruthLine &line = window->document().truth().lines.front();
        QVERIFY(events.front().onsetSeconds < line.startSeconds + 10.0);
        QVERIFY(std::abs(events.front().endSeconds - line.endSeconds) < 2.0);
    }

    void anExampleWithSettingsHasNoFileToSaveTo()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, scenarios().back().path));
        AnalysisSettings expected = preset("billon").settings;
        expected.spectrogram.windowSeconds = 0.5;
        expected.decide.falseAlarmsPerHour = 48; // one per block of 75 s
        QCOMPARE(window->document().settings(), expected);
        QCOMPARE(window->document().sessionPath(), QString());
        QVERIFY(!window->document().truth().lines.empty());
    }

    void picturesAreThoseOfTheProgram_data()
    {
        QTest::addColumn<QString>("path");
        QTest::addColumn<QString>("picture");
        for (const auto &list : {exampleRecordings(), scenarios()})
            for (const Scenario &one : list)
                if (!one.picture.isEmpty())
                    QTest::newRow(qPrintable(QFileInfo(one.picture).baseName())) << one.path << one.picture;
    }

    /// FAINTLINE_START_PICTURES=FOLDER keeps them, to replace those in resources/pictures/start.
    void picturesAreThoseOfTheProgram()
    {
        QFETCH(QString, path);
        QFETCH(QString, picture);
        const auto window = newWindow();
        window->open(path);
        QVERIFY(QTest::qWaitFor([&] { return !window->controller().isBusy() && !window->sequentialTests().isBusy(); },
                                patience));
        const bool isOfScans = window->document().isEmpty();
        const QImage made = isOfScans                       ? radarPicture(*window)
                            : window->pingBench().isInUse() ? sonarPicture(*window->document().analysis())
                                                            : linePicture(*window);
        if (const QString folder = qEnvironmentVariable("FAINTLINE_START_PICTURES"); !folder.isEmpty())
            QVERIFY(made.save(folder + QLatin1Char('/') + QFileInfo(picture).fileName()));
        const QImage kept(picture);
        QCOMPARE(made.size(), kept.size());
        QVERIFY2(changedBlocks(kept, made) < 5, qPrintable(QString::number(changedBlocks(kept, made))));
    }
};

FAINTLINE_WINDOW_TEST(tst_Welcome)
#include "tst_Welcome.moc"

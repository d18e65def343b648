// The states of a line's frames, the law by which they follow each other, and what else the detector says of its
// output.

#include "app/document/OutputLayers.h"
#include "app/features/inspect/LawPanel.h"
#include "app/features/inspect/StateSlicePanel.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/plot/LawPlot.h"
#include "widgets/waterfall/LayerItem.h"
#include "widgets/waterfall/SliceMarks.h"

#include <qwt_plot_canvas.h>
#include <qwt_text.h>

#include <QDockWidget>
#include <QTabBar>

#include <cmath>

using namespace faintline;
using namespace faintline::test;

namespace {

double total(const std::vector<double> &law)
{
    double sum = -law.front();
    for (const double h : law)
        sum += 2.0 * h;
    return sum;
}

/// Takes a bar a little below its top and moves it by so much of the ordinate.
void dragBar(LawPlot &plot, int change, double by, bool isLetGo = true)
{
    const auto i = std::size_t(std::abs(change));
    const double h = i < plot.law().size() ? plot.law()[i] : 0.0;
    const QPoint from = plot.canvasPosition(change, 0.5 * h).toPoint();
    const QPoint to = plot.canvasPosition(change, 0.5 * h + by).toPoint();
    QTest::mousePress(plot.canvas(), Qt::LeftButton, {}, from);
    QTest::mouseMove(plot.canvas(), (from + to) / 2);
    QTest::mouseMove(plot.canvas(), to);
    if (isLetGo)
        QTest::mouseRelease(plot.canvas(), Qt::LeftButton, {}, to);
}

} // namespace

class tst_StateSpace : public WindowTest
{
    Q_OBJECT

    QString m_scene;

    LawPlot &law() { return *m_window->panel<StateSlicePanel>().law().plot(0); }
    const std::vector<double> &setting() { return m_window->document().settings().model.slopeChange; }

private slots:
    void initTestCase()
    {
        m_scene = writeFile(m_folder, "line.json", R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 40,
            "lines": [{"snrDb": 9, "frequencyHz": 200, "driftHzPerSecond": 0.5}]})");
    }

    void init()
    {
        m_window = newWindow({1600, 1400}); // bars of a height at which a pixel is little
        QVERIFY(openAndSettle(*m_window, m_scene, [](AnalysisSettings &settings) {
            settings.model = laws::billon();
            settings.spectrogram.windowSeconds = 0.5;
            settings.detector = SmdSettings{SmdSettings::Reset::Fixed, 0.8};
            settings.decide.by = DecideSettings::By::Nats;
            settings.decide.thresholdNats = 20.0;
        }));
    }

    void cleanup() { m_window.reset(); }

    void theSliceFollowsTheCursor()
    {
        m_window->showView("slice");
        QVERIFY(settle(m_window->panel<StateSlicePanel>()));
        StateSlicePanel &states = m_window->panel<StateSlicePanel>();
        const Analysis &analysis = *m_window->document().analysis();
        QCOMPARE(states.view()->picture()->cells(), analysis.grid().size());
        QCOMPARE(states.view()->picture()->rowCount(0), Index(5)); // slopes
        QVERIFY(states.findChild<SliceMarks *>()->best());
        // The line's frames: the best state is the line's, and a track goes through it.
        Viewport &viewport = m_window->document().viewport();
        const double seconds = analysis.time().value(double(analysis.time().nearest(30.0)));
        viewport.setCursor({seconds, 205.0});
        QVERIFY(settle(m_window->panel<StateSlicePanel>()));
        QVERIFY(std::abs(states.findChild<SliceMarks *>()->best()->column - (200.0 + 0.5 * seconds)) < 3.0);
        QVERIFY(!states.findChild<SliceMarks *>()->paths().empty());
        m_window->controller().previewThreshold(40.0);
        QCOMPARE(states.view()->threshold(), std::optional(40.0));
        m_window->controller().previewThreshold(analysis.threshold);
        const QString there = sentenceOf(states);
        QVERIFY2(there.startsWith(QStringLiteral("Frame %1 at").arg(analysis.time().nearest(30.0) + 1)),
                 qPrintable(there));
        // Step on, and back: the same picture.
        const auto row = [&] {
            const auto bytes = states.view()->picture()->row(0, 2);
            return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
        };
        const auto before = row();
        QTest::keyClick(m_window->workbench().output(), Qt::Key_L);
        QVERIFY(settle(m_window->panel<StateSlicePanel>()));
        QVERIFY(sentenceOf(states) != there);
        QTest::keyClick(m_window->workbench().output(), Qt::Key_J);
        QVERIFY(settle(m_window->panel<StateSlicePanel>()));
        QCOMPARE(sentenceOf(states), there);
        QCOMPARE(row(), before);
        // A click in the slice takes its frequency, not its slope.
        const QPointF at = states.view()->positionOf({states.view()->viewport()->time().high * 0.8, 300.0});
        QTest::mouseClick(states.view()->canvas(), Qt::LeftButton, {}, at.toPoint());
        QVERIFY(std::abs(viewport.cursor()->hz - 300.0) < 5.0);
        QCOMPARE(viewport.cursor()->seconds, seconds);
    }

    void fineSlopesHaveTheirRows()
    {
        QVERIFY(openAndSettle(*m_window, m_scene, [](AnalysisSettings &settings) {
            settings.spectrogram.windowSeconds = 0.5;
            settings.detector = SmdSettings{SmdSettings::Reset::Fixed, 0.03};
            settings.decide.by = DecideSettings::By::Nats;
            settings.decide.thresholdNats = 20.0;
        }));
        m_window->showView("slice");
        QVERIFY(settle(m_window->panel<StateSlicePanel>()));
        StateSlicePanel &states = m_window->panel<StateSlicePanel>();
        QCOMPARE(states.view()->picture()->rowCount(0), Index(17)); // -1 … 1 in eighths of a bin
        const Axis &time = m_window->document().analysis()->time();
        m_window->document().viewport().setCursor({time.value(double(time.nearest(30.0))), 215.0});
        QVERIFY(settle(states));
        // The line drifts by 0.5 Hz/s; neighbouring slopes are 1 Hz / 0.25 s / 8 apart.
        QVERIFY(std::abs(states.findChild<SliceMarks *>()->best()->column - 215.0) < 3.0);
        QVERIFY2(std::abs(states.findChild<SliceMarks *>()->best()->row - 0.5) <= 0.5,
                 qPrintable(QString::number(states.findChild<SliceMarks *>()->best()->row)));
        const QString change = law().axisTitle(QwtAxis::XBottom).text();
        QVERIFY2(change.contains(QStringLiteral("(1/8 bin/frame)")), qPrintable(change));
        QCOMPARE(law().law(), (std::vector<double>{0.9, 0.05}));
    }

    void theRangeIsThatOfTheCanvasAsItIs()
    {
        m_window->showView("slice");
        QVERIFY(settle(m_window->panel<StateSlicePanel>()));
        const WaterfallView &view = *m_window->panel<StateSlicePanel>().view();
        const Span narrow = view.range();
        auto *dock = qobject_cast<QDockWidget *>(m_window->panel<StateSlicePanel>().parentWidget());
        m_window->resizeDocks({dock}, {500}, Qt::Horizontal);
        QCoreApplication::processEvents();
        const Span wide = view.range();
        QVERIFY(!(wide == narrow));
        // As if the picture had come only now.
        Viewport &viewport = m_window->document().viewport();
        const Viewport::Point cursor = *viewport.cursor();
        for (const double seconds : {cursor.seconds + 1.0, cursor.seconds}) {
            viewport.setCursor({seconds, cursor.hz});
            QVERIFY(settle(m_window->panel<StateSlicePanel>()));
        }
        QCOMPARE(view.range(), wide);
    }

    void frequenciesAreTheWaterfalls()
    {
        m_window->showView("slice");
        QVERIFY(settle(m_window->panel<StateSlicePanel>()));
        Viewport &viewport = m_window->document().viewport();
        viewport.zoomTo(viewport.time(), {150.0, 250.0});
        QCOMPARE(m_window->panel<StateSlicePanel>().view()->viewport()->frequency(), (Span{150.0, 250.0}));
        m_window->panel<StateSlicePanel>().view()->viewport()->zoomTo(
            m_window->panel<StateSlicePanel>().view()->viewport()->time(), {180.0, 220.0});
        QCOMPARE(viewport.frequency(), (Span{180.0, 220.0}));
    }

    void aBarIsDraggedAndUndone()
    {
        m_window->showView("slice");
        m_window->panel<StateSlicePanel>().findChild<QTabBar *>()->setCurrentIndex(1);
        QVERIFY(settle(m_window->panel<StateSlicePanel>()));
        QVERIFY(law().isVisible());
        const std::vector<double> before = setting();
        const QString words = sentenceOf(m_window->panel<StateSlicePanel>().law());
        QVERIFY(words.contains(QStringLiteral("1.10 nat")));
        const int steps = m_window->document().undoStack().count();

        QCoreApplication::processEvents(); // the bars find their places
        dragBar(law(), 0, 0.3);
        QVERIFY2(std::abs(setting()[0] - (before[0] + 0.3)) < 0.02, qPrintable(QString::number(setting()[0])));
        QVERIFY(std::abs(total(setting()) - 1.0) < 1e-9);
        QCOMPARE(m_window->document().undoStack().count(), steps + 1);
        QVERIFY(sentenceOf(m_window->panel<StateSlicePanel>().law()) != words);
        QVERIFY(settle(*m_window));
        QCOMPARE(m_window->document().analysis()->model.space.axes()[0].rateChange, setting());

        // The one more bar that stands ready, on the other side.
        dragBar(law(), -2, 0.1);
        QCOMPARE(setting().size(), std::size_t(3));
        QVERIFY(std::abs(setting()[2] - 0.1) < 0.02);
        QVERIFY(std::abs(total(setting()) - 1.0) < 1e-9);

        m_window->document().undoStack().undo();
        m_window->document().undoStack().undo();
        QCOMPARE(setting(), before);
        QCOMPARE(law().law(), before);
    }

    void layersByKey()
    {
        OutputLayers &layers = m_window->workbench().layers();
        WaterfallView &output = *m_window->workbench().output();
        QCOMPARE(layers.layer(), OutputLayer::Statistic);
        QVERIFY(!itemOf<LayerItem>(output).picture());
        const QImage statistic = output.grab().toImage();
        QTest::keyClick(&output, Qt::Key_V);
        QCOMPARE(layers.layer(), OutputLayer::Rate);
        QVERIFY(settle(m_window->workbench().layers()));
        QVERIFY(itemOf<LayerItem>(output).picture());
        const QImage rate = output.grab().toImage();
        QVERIFY(rate != statistic);
        QVERIFY(output.title().text().contains(QStringLiteral("slope")));
        QTest::keyClick(&output, Qt::Key_V, Qt::ShiftModifier);
        QVERIFY(layers.isOverlay());
        QVERIFY(output.grab().toImage() != rate);
        QVERIFY(output.title().text().contains(QStringLiteral("Statistic")));
        // What is opaque follows the threshold while it is dragged.
        const QImage overlay = itemOf<LayerItem>(output).image();
        m_window->controller().previewThreshold(2.0 * m_window->document().shownThreshold());
        QVERIFY(itemOf<LayerItem>(output).image() != overlay);
        m_window->controller().previewThreshold(m_window->document().analysis()->threshold);
        QCOMPARE(itemOf<LayerItem>(output).image(), overlay);
        for (int i = 0; i < 4; ++i)
            QTest::keyClick(&output, Qt::Key_V);
        QCOMPARE(layers.layer(), OutputLayer::Presence);
        QVERIFY(settle(m_window->workbench().layers()));
        const std::vector<float> &presence = itemOf<LayerItem>(output).picture()->presence;
        QVERIFY(*std::max_element(presence.begin(), presence.end()) > 0.9f);
        QVERIFY(!layers.readingAt({13.0, {206.5}})); // a picture of tracks has no age of a path
        QTest::keyClick(&output, Qt::Key_V);
        QCOMPARE(layers.layer(), OutputLayer::Statistic);
        QVERIFY(settle(m_window->workbench().layers()));
    }

    void aLayerIsOfWhatIsSeen()
    {
        OutputLayers &layers = m_window->workbench().layers();
        layers.setLayer(OutputLayer::Age);
        QVERIFY(settle(m_window->workbench().layers()));
        const WaterfallView &output = *m_window->workbench().output();
        const Index whole = itemOf<LayerItem>(output).picture()->rows * itemOf<LayerItem>(output).picture()->perRow;
        QVERIFY(whole >= m_window->document().analysis()->time().count);
        m_window->document().viewport().zoomTo({10.0, 14.0}, {190.0, 230.0});
        QVERIFY(settle(m_window->workbench().layers()));
        const LayerPicture &picture = *itemOf<LayerItem>(output).picture();
        QCOMPARE(picture.perRow, Index(1));
        QCOMPARE(picture.perColumn, Index(1));
        QVERIFY(picture.rows < 25);
        QCOMPARE(picture.firstRow, m_window->document().analysis()->time().nearest(10.0));
        // The read-out's figures are the cell's own.
        m_window->document().viewport().setCursor({13.0, 206.5});
        QVERIFY(settle(m_window->workbench().layers()));
        const auto reading = layers.readingAt({13.0, {206.5}});
        QVERIFY(reading);
        LayerReplay replay(m_window->document().analysis());
        const Analysis &analysis = *m_window->document().analysis();
        const CellReading exact =
            readCell(analysis, replay.at(analysis.time().nearest(13.0)), analysis.grid().axes[0].nearest(206.5));
        QCOMPARE(reading->ageSeconds, exact.ageSeconds);
        QCOMPARE(reading->ratePerSecond, exact.ratePerSecond);
        QCOMPARE(reading->statistic, exact.statistic);
    }

    void nothingIsComputedUnasked()
    {
        OutputLayers &layers = m_window->workbench().layers();
        m_window->document().viewport().setCursor({20.0, 210.0});
        QVERIFY(!isBusy(layers));
        QVERIFY(!layers.readingAt({20.0, {210.0}}));
        m_window->showView("slice");
        QVERIFY(settle(m_window->workbench().layers()));
        QVERIFY(layers.readingAt({20.0, {210.0}})); // watched with the states
    }
};

FAINTLINE_WINDOW_TEST(tst_StateSpace)
#include "tst_StateSpace.moc"

// A sonar's pings in the window: opened, stepped through, saved and reopened.

#include "app/base/MessageBar.h"
#include "app/base/filePath.h"
#include "app/document/OutputLayers.h"
#include "app/features/events/Comparer.h"
#include "app/features/inspect/LatencyPanel.h"
#include "app/features/inspect/LawPanel.h"
#include "app/features/inspect/NoiseFitPanel.h"
#include "app/features/inspect/StateSlicePanel.h"
#include "app/features/inspect/WhyPanel.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "app/ping.h"
#include "exchange/ModelFile.h"
#include "exchange/Session.h"
#include "scene/SimulatedPings.h"
#include "signal/formats/NumPy.h"
#include "signal/formats/gridFile.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/events/EventTable.h"
#include "widgets/pings/PingMap.h"
#include "widgets/pings/PolarView.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/plot/LawPlot.h"
#include "widgets/table/ColumnTable.h"
#include "widgets/waterfall/LayerItem.h"

#include <qwt_plot_canvas.h>
#include <qwt_text.h>

#include <QCheckBox>
#include <QMenu>
#include <QMenuBar>
#include <QSlider>
#include <QSplitter>
#include <QTabBar>
#include <QTableView>

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace faintline;
using namespace faintline::test;

namespace {

/// Small enough to be analysed at once: nine rates a cell.
const char *const scene = R"({"kind": "pings", "pings": 24, "rangeCells": 120, "beams": 8, "seed": 5, "targets": [
    {"snrDb": 11, "rangeMetres": 3500, "bearingDegrees": 90, "appearPing": 4, "legs": [{"rangeCellsPerPing": 1}]},
    {"snrDb": 11, "rangeMetres": 3900, "bearingDegrees": 315, "appearPing": 5, "legs": [{"rangeCellsPerPing": -1,
    "beamsPerPing": 0.15}]}]})";

AnalysisSettings nineRates(AnalysisSettings settings)
{
    settings.model.motion = Motion::Slopes;
    settings.model.lowestSlope = -1;
    settings.model.highestSlope = 1;
    settings.detector = SmdSettings{SmdSettings::Reset::Mean, 0.0};
    settings.decide.thresholdNats = 22.0;
    settings.decide.inhibitCells = {2.0, 1.0};
    settings.decide.forgetCells = {4.0, 1.0};
    settings.track.windowCells = {4.0, 1.0};
    return settings;
}

bool openWithNineRates(MainWindow &window, const QString &path)
{
    return openAndSettle(window, path, [](AnalysisSettings &settings) { settings = nineRates(settings); });
}

} // namespace

/// The chart of a panel with that ordinate.
static const Chart &chartOf(const QWidget &panel, const std::string &y)
{
    for (const ChartPlot *plot : panel.findChildren<ChartPlot *>())
        if (plot->chart().yLabel == y)
            return plot->chart();
    qFatal("no chart of %s", y.c_str());
}

class tst_PingBench : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;

    QString path(const QString &name) const { return m_folder.filePath(name); }

    std::unique_ptr<MainWindow> window(bool remembers = false) const
    {
        auto result = newWindow(
            {1400, 900}, remembers ? std::make_unique<QSettings>(path("memory.ini"), QSettings::IniFormat) : nullptr);
        return result;
    }

private slots:
    void initTestCase()
    {
        Theme::apply(Theme::Kind::Light);
        writeFile(m_folder, "pings.json", scene);
        const SimulatedPings pings(*sourceAt(path("pings.json")).pings);
        std::vector<float> y(std::size_t(pings.time().count * pings.grid().size()));
        pings.read(0, pings.time().count, y);
        NumPyWriter stack(path("stack.npy").toStdString(), {24, 120, 8});
        stack.write(y);
        stack.finish();
        QFile grid(path("stack.grid.json"));
        QVERIFY(grid.open(QIODevice::WriteOnly));
        grid.write(QByteArray::fromStdString(gridFileText({pings.grid(), pings.time()})));
    }

    void aSceneOpensOnTheBenchOfPings()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        QVERIFY(w->pingBench().isVisible());
        QVERIFY(!w->workbench().isVisible());
        const Analysis &analysis = *w->document().analysis();
        QVERIFY(w->document().isCurrent());
        QVERIFY(analysis.tracks.size() >= 2);
        QCOMPARE(analysis.inhibitions.size(), std::size_t(24));
        QCOMPARE(analysis.statisticAlong.size(), std::size_t(2));
        QVERIFY(w->pingBench().input()->plane()->picture());
        QVERIFY(readingOf(w->pingBench()).startsWith("ping "));
        QVERIFY(w->eventTable().table()->model()->rowCount() > 0);
        QVERIFY(w->windowTitle().contains("pings.json"));
    }

    void aStackOfFramesIsTheSame()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        const auto simulated = w->document().analysis();
        QVERIFY(openWithNineRates(*w, path("stack.npy")));
        const auto read = w->document().analysis();
        QVERIFY(read != simulated);
        QCOMPARE(read->lnK, simulated->lnK);
        QCOMPARE(read->tracks.size(), simulated->tracks.size());
        QCOMPARE(read->grid(), simulated->grid());
        QVERIFY(w->document().pingTruth().targets.empty()); // a stack knows none
        QVERIFY(w->pingBench().isVisible());
    }

    void stepsAndPlaysBothWays()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        PingBench &bench = w->pingBench();
        bench.showPing(10);
        QCOMPARE(pingShown(*w), Index(10));
        QTest::keyClick(bench.output()->plane(), Qt::Key_L);
        QCOMPARE(pingShown(*w), Index(11));
        QTest::keyClick(bench.output()->plane(), Qt::Key_J);
        QTest::keyClick(bench.output()->plane(), Qt::Key_J);
        QCOMPARE(pingShown(*w), Index(9));
        auto *slider = bench.findChild<QSlider *>();
        QCOMPARE(slider->value(), 9);
        slider->setValue(15);
        QCOMPARE(pingShown(*w), Index(15));
        QVERIFY(readingOf(bench).startsWith("ping 16/24"));
        const auto shown = bench.input()->plane()->picture();
        bench.stepFrames(-100);
        QCOMPARE(pingShown(*w), Index(0));
        QVERIFY(bench.input()->plane()->picture() != shown);

        QSignalSpy playing(&bench, &Bench::playingChanged);
        QTest::keyClick(bench.output()->plane(), Qt::Key_Space);
        QCOMPARE(playing.count(), 1);
        QTRY_VERIFY(pingShown(*w) >= 2);
        bench.setPlayingBackward(true);
        QTRY_COMPARE(pingShown(*w), Index(0));
        QTRY_COMPARE(playing.last().first().toBool(), false); // it ends at the first ping
    }

    void picturesHaveOneCursor()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        PingBench &bench = w->pingBench();
        bench.showPing(8);
        const WaterfallView &history = *bench.alongHistory();
        const Axis &time = w->document().analysis()->time();
        const QPointF at = history.positionOf({time.value(17.0), 3800.0});
        QTest::mouseClick(bench.alongHistory()->canvas(), Qt::LeftButton, {}, at.toPoint());
        QCOMPARE(pingShown(*w), Index(17));
        QVERIFY(std::abs(bench.viewports().map().cursor()->seconds - 3800.0) < 20.0);
    }

    void anEventBringsItsPing()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        const Event event = w->document().shownEvents().front();
        w->pingBench().selectEvent(event.id);
        QCOMPARE(w->pingBench().viewports().place().seconds, event.detectSeconds);
        QCOMPARE(w->pingBench().viewports().across(), event.position[1]);
        // The cell it was found in is now kept from the detector for it.
        QVERIFY2(readingOf(w->pingBench()).contains(QStringLiteral("inhibited: track %1").arg(event.id)),
                 qPrintable(readingOf(w->pingBench())));
    }

    void inhibitionCanBeHidden()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        w->pingBench().selectEvent(w->document().shownEvents().front().id);
        PingMap &map = *w->pingBench().output();
        const QImage with = map.grab().toImage();
        for (QCheckBox *box : w->pingBench().findChildren<QCheckBox *>())
            if (box->text() == "Inhibited")
                QTest::mouseClick(box, Qt::LeftButton, {}, {8, box->height() / 2});
        QVERIFY(map.grab().toImage() != with);
    }

    void theConventionalDetectorCanBeShownBeside()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        PingBench &bench = w->pingBench();
        const std::vector<Track> &found = w->document().analysis()->conventional;
        QVERIFY(!found.empty()); // 11 dB show in a ping by themselves
        bench.showPing(found.front().detectFrame);
        const QImage without = bench.output()->grab().toImage();
        for (QCheckBox *box : bench.findChildren<QCheckBox *>())
            if (box->text() == "Conventional")
                QTest::mouseClick(box, Qt::LeftButton, {}, {8, box->height() / 2});
        QVERIFY(bench.output()->grab().toImage() != without);
    }

    void theBestStatesAreTheStatistic()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        StateSlicePanel &states = w->panel<StateSlicePanel>();
        w->pingBench().showPing(18);
        w->showView("slice");
        QVERIFY(settle(states));
        QVERIFY(states.view()->picture());
        QCOMPARE(states.view()->picture()->cells(), Index(3)); // range × its three rates
        QVERIFY2(sentenceOf(states).startsWith("Ping 19:"), qPrintable(sentenceOf(states)));

        states.setAxes(0, 1);
        states.setMaximised(true);
        QVERIFY(settle(states));
        const PeakPyramid &slice = *states.view()->picture();
        const PeakPyramid &map = *w->pingBench().output()->plane()->picture();
        QCOMPARE(slice.rowCount(0), map.rowCount(0));
        for (Index row = 0; row < map.rowCount(0); ++row)
            QVERIFY(std::ranges::equal(slice.row(0, row), map.row(0, row)));

        // Backwards, too.
        w->pingBench().showPing(5);
        QVERIFY(settle(states));
        QVERIFY(std::ranges::equal(states.view()->picture()->row(0, 40),
                                   w->pingBench().output()->plane()->picture()->row(0, 40)));
    }

    void theLawOfBothRatesIsDragged()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        w->showView("slice");
        w->panel<StateSlicePanel>().findChild<QTabBar *>()->setCurrentIndex(1);
        QCoreApplication::processEvents(); // the bars find their places
        QCOMPARE(std::ssize(w->panel<StateSlicePanel>().findChildren<LawPlot *>()),
                 1); // a slope set has one law for both axes
        LawPlot &plot = *w->panel<StateSlicePanel>().law().plot(0);
        const std::vector<double> before = w->document().settings().model.slopeChange;
        const QPoint from = plot.canvasPosition(1, 0.2).toPoint();
        const QPoint to = plot.canvasPosition(1, 0.05).toPoint();
        QTest::mousePress(plot.canvas(), Qt::LeftButton, {}, from);
        QTest::mouseMove(plot.canvas(), to);
        QTest::mouseRelease(plot.canvas(), Qt::LeftButton, {}, to);
        const double pixel = std::abs(plot.invTransform(QwtAxis::YLeft, 1.0) - plot.invTransform(QwtAxis::YLeft, 0.0));
        const std::vector<double> after = w->document().settings().model.slopeChange;
        QVERIFY2(after.size() == 2 && std::abs(after[1] - (before[1] - 0.15)) < 1.5 * pixel,
                 qPrintable(QString("%1 of %2, a pixel %3").arg(after.back()).arg(after.size()).arg(pixel)));
        QTest::keyClick(w.get(), Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(w->document().settings().model.slopeChange, before);
        // Targets that turn have a law for each of their rates.
        QSignalSpy settled(&w->controller(), &AnalysisController::settled);
        w->controller().edit("model.motion", std::string("manoeuvring"), "motion");
        QCOMPARE(std::ssize(w->panel<StateSlicePanel>().findChildren<LawPlot *>()), 2);
        emit w->panel<StateSlicePanel>().law().lawRequested("model.bearingRateChange", {0.8, 0.1});
        QCOMPARE(w->document().settings().model.bearingRateChange, (std::vector<double>{0.8, 0.1}));
        QVERIFY(settled.wait(patience));
        QCOMPARE(w->document().analysis()->model.space.axes()[1].rateChange, (std::vector<double>{0.8, 0.1}));
    }

    void theNoiseFitSpeaksOfBearings()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        w->showView("noisefit");
        QVERIFY(settle(w->panel<NoiseFitPanel>()));
        const QAbstractItemModel &table = *childOf<ColumnTable>(w->panel<NoiseFitPanel>()).model();
        QVERIFY2(table.rowCount() > 0, qPrintable(sentenceOf(w->panel<NoiseFitPanel>())));
        QCOMPARE(table.headerData(0, Qt::Horizontal).toString(), "Band (°)");
    }

    void theLadderOfACell()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        w->pingBench().selectEvent(w->document().shownEvents().front().id);
        QTest::keyClick(w.get(), Qt::Key_W);
        QVERIFY(settle(w->panel<WhyPanel>()));
        WhyPanel &why = w->panel<WhyPanel>();
        const Explanation &explanation = *why.explanation();
        QVERIFY2(sentenceOf(why).startsWith("Detected"), qPrintable(sentenceOf(why)));
        const QAbstractItemModel &ladder = *childOf<ColumnTable>(why, "The best path, newest step first").model();
        QCOMPARE(ladder.rowCount(), int(explanation.steps.size()));
        QCOMPARE(ladder.columnCount(), 8); // time, range, bearing, λ, ln P, ln K, sum, second best
        QVERIFY(ladder.headerData(1, Qt::Horizontal).toString().startsWith("Range"));
        double sum = explanation.offset;
        for (const PathStep &step : explanation.steps)
            sum += step.logLikelihoodRatio + step.lnTransition + step.lnK;
        QVERIFY(std::abs(sum - explanation.displayed) < 1e-3 * std::abs(sum));
        // A step back is another cell's ladder.
        const int rows = ladder.rowCount();
        QTest::keyClick(w->pingBench().output()->plane(), Qt::Key_J);
        QVERIFY(settle(why));
        QVERIFY(ladder.rowCount() < rows);
    }

    void latencyOfTheScene()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("stack.npy")));
        QVERIFY(w->panel<LatencyPanel>().obstacle().contains("scene"));
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        QVERIFY2(w->panel<LatencyPanel>().obstacle().isEmpty(), qPrintable(w->panel<LatencyPanel>().obstacle()));
        w->panel<LatencyPanel>().start(3);
        QVERIFY(settle(w->panel<LatencyPanel>()));
        const Chart &pd = chartOf(w->panel<LatencyPanel>(), "Pd");
        QCOMPARE(pd.curves.size(), std::size_t(2));
        for (std::size_t i = 1; i < pd.curves[0].points.size(); ++i)
            QVERIFY(pd.curves[0].points[i].y >= pd.curves[0].points[i - 1].y);
        QVERIFY(pd.curves[0].points.back().y >= pd.curves[1].points.back().y); // what is confirmed is detected
        double counted = 0.0;
        for (const Curve::Point &point : chartOf(w->panel<LatencyPanel>(), "targets").curves[0].points)
            counted += point.y;
        QCOMPARE(counted, 6.0 * pd.curves[0].points.back().y); // two targets, three runs
        QVERIFY(sentenceOf(w->panel<LatencyPanel>()).contains("6 targets in 3 runs"));
    }

    void aSessionComesBackAsItWas()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        PingBench &bench = w->pingBench();
        bench.viewports().setPlace({400.0, {3600.0, 90.0}});
        bench.viewports().map().zoomTo({3400.0, 3800.0}, {0.0, 225.0});
        bench.setPolar(true);
        Session session;
        session.source = w->document().source();
        session.settings = w->document().settings();
        session.view = toJson(bench.viewState());
        writeSession(pathBytes(path("s.faintline")), session);

        const Session back = readSession(pathBytes(path("s.faintline")));
        QVERIFY(back.source.pings);
        QCOMPARE(*back.source.pings, *session.source.pings);
        QVERIFY(openAndSettle(*w, path("s.faintline")));
        QCOMPARE(bench.viewports().place(), (PingViewports::Place{400.0, {3600.0, 90.0}}));
        QCOMPARE(bench.viewports().map().time(), (Span{3400.0, 3800.0}));
        QCOMPARE(bench.viewports().map().frequency(), (Span{0.0, 225.0}));
        QVERIFY(bench.output()->isPolar());
        QCOMPARE(w->document().settings(), session.settings);
    }

    void aStackInASessionIsKnownByItsHash()
    {
        Session session;
        session.source = sourceAt(path("stack.npy"));
        writeSession(pathBytes(path("stack.faintline")), session);
        const Session back = readSession(pathBytes(path("stack.faintline")));
        QVERIFY(back.source.isStack());
        QCOMPARE(back.recordingHash.size(), std::size_t(64));
        QVERIFY(openSource(back.source).frames);
    }

    void linesComeBackToTheirBench()
    {
        writeFile(m_folder, "lines.json",
                  R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 20, "lines": [{"snrDb": 8,
               "frequencyHz": 200}]})");
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        QVERIFY(openAndSettle(*w, path("lines.json")));
        QVERIFY(w->workbench().isVisible());
        QVERIFY(!w->pingBench().isVisible());
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        QVERIFY(w->pingBench().isVisible());
    }

    void nothingStaysUnderANewName()
    {
        writeFile(m_folder, "before.json",
                  R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 20, "lines": [{"snrDb": 8,
               "frequencyHz": 200}]})");
        const auto w = window();
        QVERIFY(openAndSettle(*w, path("before.json")));
        QVERIFY(w->workbench().input()->picture());
        // Looked at as soon as it is open: the analysis may follow at once, where its calibration is known.
        QStringList left;
        int openings = 0;
        connect(&w->document(), &Document::opened, this, [&] {
            ++openings;
            if (w->document().analysis())
                left << "analysis";
            if (w->pingBench().output()->plane()->picture())
                left << "map";
            if (w->workbench().input()->picture())
                left << "waterfall";
            if (w->eventTable().table()->model()->rowCount() > 0)
                left << "events";
        });
        w->open(path("pings.json"), {}, [](AnalysisSettings &settings) { settings = nineRates(settings); });
        QVERIFY(settle(*w));
        QVERIFY(w->pingBench().isVisible());
        QCOMPARE(openings, 1);
        QCOMPARE(left, QStringList());
        QVERIFY(w->pingBench().output()->plane()->picture());
        writeFile(m_folder, "other.json", QByteArray(scene).replace("\"seed\": 5", "\"seed\": 6"));
        w->open(path("other.json"), {}, [](AnalysisSettings &settings) { settings = nineRates(settings); });
        QVERIFY(settle(*w));
        QCOMPARE(openings, 2);
        QCOMPARE(left, QStringList());
    }

    void framesOfAnotherScaleAreToldOf()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("stack.npy")));
        QCOMPARE(w->messages().text(), QString());
        QFile stack(path("stack.npy"));
        QVERIFY(stack.open(QIODevice::ReadOnly));
        QByteArray bytes = stack.readAll();
        const qsizetype values = 24 * 120 * 8;
        for (qsizetype i = bytes.size() - values * qsizetype(sizeof(float)); i < bytes.size();
             i += qsizetype(sizeof(float))) {
            float y = 0.0f;
            std::memcpy(&y, bytes.constData() + i, sizeof y);
            y *= 5.0f;
            std::memcpy(bytes.data() + i, &y, sizeof y);
        }
        writeFile(m_folder, "loud.npy", bytes);
        QFile::copy(path("stack.grid.json"), path("loud.grid.json"));
        QVERIFY(openWithNineRates(*w, path("loud.npy")));
        QVERIFY2(w->messages().text().contains("the mean of the noise is about 5"), qPrintable(w->messages().text()));
    }

    void recordedPingsAreNormalised()
    {
        const NumPyArray stack = readNumPy(path("stack.npy").toStdString());
        QByteArray header = "{'descr': '<i2', 'fortran_order': False, 'shape': (24, 120, 8), }";
        header = header.leftJustified(128 - 10 - 1, ' ') + '\n';
        QByteArray bytes = QByteArray("\x93NUMPY\x01\x00", 8) + char(header.size()) + '\0' + header;
        for (std::size_t i = 0; i < stack.values.size(); ++i) { // reverberation that falls by 30 dB
            const double mean = std::pow(10.0, 6.0 - 3.0 * double(i / 8 % 120) / 120.0);
            const auto value = std::int16_t(std::lround(std::min(32767.0, std::sqrt(mean * double(stack.values[i])))));
            bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
        }
        writeFile(m_folder, "raw.npy", bytes);
        QFile::copy(path("stack.grid.json"), path("raw.grid.json"));

        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("raw.npy")));
        QVERIFY2(w->messages().text().contains("int16, taken as magnitude from its distribution"),
                 qPrintable(w->messages().text()));
        Document &document = w->document();
        QVERIFY(document.isCurrent());
        QVERIFY(document.analysis()->tracks.size() >= 2);
        const NormalisedFramesPointer before = document.frames();
        w->comparer().keep();
        w->comparer().setActive(true);
        w->controller().edit("pings.guardCells", 5, "Change guard cells");
        QVERIFY(settle(*w));
        QVERIFY(document.isCurrent());
        // The same pings, normalised anew, are still compared.
        QVERIFY(w->comparer().isOfWhatIsOpen());
        QTRY_VERIFY(w->comparer().result() && w->comparer().result()->b == document.analysis());
        QCOMPARE(w->comparer().result()->a->frames, before);
        QVERIFY(document.frames() != before);
        QCOMPARE(document.openedSource().normalisation.pings.guardCells, 5);
        document.undoStack().undo();
        QVERIFY(settle(*w));
        QVERIFY(document.isCurrent());
        QCOMPARE(document.frames(), before);
        // In a session: the same settings, without a question.
        Session session;
        session.source = document.source();
        session.settings = document.settings();
        session.settings.pings.guardCells = 4;
        writeSession(pathBytes(path("raw.faintline")), session);
        QVERIFY(openAndSettle(*w, path("raw.faintline")));
        QCOMPARE(document.settings().pings.guardCells, 4);
        QVERIFY(!w->comparer().isOfWhatIsOpen());
        QCOMPARE(document.openedSource().normalisation.pings.guardCells, 4);
    }

    void aMistakeIsALine()
    {
        const auto w = window();
        QStringList failures;
        connect(&w->controller(), &AnalysisController::failed, this,
                [&](const Error &error) { failures << error.what(); });
        writeFile(m_folder, "bad.json", R"({"kind": "pings", "moons": 1})");
        QVERIFY(openWithNineRates(*w, path("bad.json")));
        QCOMPARE(failures.size(), 1);
        QVERIFY2(failures.first().contains("moons"), qPrintable(failures.first()));
    }

    void layersAreOfThePingShown()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        PingBench &bench = w->pingBench();
        OutputLayers &layers = w->workbench().layers();
        bench.showPing(15);
        QVERIFY(!readingOf(bench).contains("path age")); // nothing is computed unasked
        const QImage statistic = bench.output()->grab().toImage();
        QTest::keyClick(bench.output()->plane(), Qt::Key_V);
        QCOMPARE(layers.layer(), OutputLayer::Rate);
        QVERIFY(settle(layers));
        QVERIFY(bench.output()->plane()->title().text().contains("range rate"));
        QVERIFY(bench.output()->grab().toImage() != statistic);
        // The picture and the read-out are the replay's own.
        const auto analysis = w->document().analysis();
        LayerReplay replay(analysis);
        const CellLayers &exact = replay.at(15);
        QVERIFY(itemOf<LayerItem>(*bench.output()->plane()).picture());
        QCOMPARE(itemOf<LayerItem>(*bench.output()->plane()).picture()->rows, Index(120));
        for (Index cell = 0; cell < 960; ++cell) {
            const CellReading there =
                readPixel(*itemOf<LayerItem>(*bench.output()->plane()).picture(),
                          itemOf<LayerItem>(*bench.output()->plane()).picture()->pixelAt(cell / 8, cell % 8));
            const CellReading expected = readCell(*analysis, exact, cell);
            QVERIFY(std::abs(there.ratePerSecond - expected.ratePerSecond) < 1e-5);
            QVERIFY(std::abs(there.ageSeconds - expected.ageSeconds) < 1e-3);
        }
        QVERIFY(readingOf(bench).contains("path age"));
        // The next one is of bearings, which lines have not; from above, too.
        QTest::keyClick(bench.output()->plane(), Qt::Key_V);
        QCOMPARE(layers.layer(), OutputLayer::SecondRate);
        QTest::keyClick(bench.output()->plane(), Qt::Key_V);
        QCOMPARE(layers.layer(), OutputLayer::Age);
        QVERIFY(settle(layers));
        bench.setPolar(true);
        QVERIFY(settle(layers));
        const QImage age = bench.output()->grab().toImage();
        QTest::keyClick(bench.output()->polar(), Qt::Key_V, Qt::ShiftModifier);
        QVERIFY(layers.isOverlay());
        QVERIFY(bench.output()->grab().toImage() != age);
        // Another ping's layer is not this one's: it goes at once and comes anew.
        bench.stepFrames(1);
        QVERIFY(!itemOf<LayerItem>(*bench.output()->plane()).picture());
        QVERIFY(settle(layers));
        QVERIFY(itemOf<LayerItem>(*bench.output()->plane()).picture());
        layers.setLayer(OutputLayer::SecondRate);
        QVERIFY(settle(layers));
        writeFile(m_folder, "line.json",
                  R"({"kind": "lines", "sampleRateHz": 500, "durationSeconds": 10, "lines": []})");
        QVERIFY(openAndSettle(*w, path("line.json")));
        QCOMPARE(layers.layer(), OutputLayer::Rate);
    }

    void aLayerReachesTheLastBeamInView()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        Viewport &viewport = w->pingBench().viewports().map();
        viewport.zoomTo(viewport.time(), {157.5, 337.5}); // beams 4 to 7, up to the edge of the last
        OutputLayers &layers = w->workbench().layers();
        layers.setLayer(OutputLayer::Age);
        QVERIFY(settle(layers));
        const auto picture = itemOf<LayerItem>(*w->pingBench().output()->plane()).picture();
        QVERIFY(picture);
        QCOMPARE(picture->firstColumn, Index(4));
        QCOMPARE(picture->columns, Index(4));
    }

    void aChangedDetectorIsSeenAtOnceOnThePingShown()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        PingBench &bench = w->pingBench();
        bench.showPing(20);
        const auto before = w->document().analysis();
        const auto shownBefore = bench.output()->plane()->picture();
        QSignalSpy settled(&w->controller(), &AnalysisController::settled);
        QStringList order;
        connect(&w->document(), &Document::provisionalChanged, this, [&] {
            if (!w->document().provisional())
                return;
            order << "provisional";
            QCOMPARE(w->document().analysis(), before);
            QCOMPARE(before->time().nearest(w->document().provisional()->time().first), Index(20));
            QVERIFY(bench.output()->plane()->title().text().contains("provisional"));
            QVERIFY(bench.output()->plane()->picture() != shownBefore);
            bench.stepFrames(-1); // it is of that ping only
            QVERIFY(!bench.output()->plane()->title().text().contains("provisional"));
            bench.stepFrames(1);
            QVERIFY(bench.output()->plane()->title().text().contains("provisional"));
        });
        connect(&w->document(), &Document::analysisChanged, this, [&] { order << "analysis"; });
        w->controller().edit("model.snr", FieldValue(before->settings.model.snr * 1.3), "Change");
        QVERIFY(settled.wait(patience));
        QCOMPARE(order, (QStringList{"provisional", "analysis"}));
        QVERIFY(!bench.output()->plane()->title().text().contains("provisional"));
        QVERIFY(w->document().isCurrent());
    }

    void rejectedTracksAreFaintOnTheMaps()
    {
        const auto w = window();
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        PingBench &bench = w->pingBench();
        const Track &track = w->document().analysis()->tracks.front();
        bench.showPing(track.detectFrame + 3);
        const Grid &grid = w->document().analysis()->grid();
        const auto point = std::find_if(track.points.begin(), track.points.end(),
                                        [&](const TrackPoint &p) { return p.frame == pingShown(*w); });
        QVERIFY(point != track.points.end());
        const std::vector<Index> c = grid.coordinates(point->cell);
        const PingMarks::Place place{grid.axes[0].value(double(c[0])), grid.axes[1].value(double(c[1]))};
        for (const bool isPolar : {false, true}) {
            bench.setPolar(isPolar);
            QCOMPARE(bench.output()->trackAt(place), track.id);
            QCOMPARE(bench.output()->trackAt({place.along + 300.0, place.across + 90.0}), 0);
        }
        bench.setPolar(false);
        // A right click on it says whom the keys are about.
        QMenu menu;
        emit bench.output()->plane()->contextMenuRequested(&menu, place.along, place.across);
        const QList<QAction *> offered = menu.actions();
        QVERIFY(std::any_of(offered.begin(), offered.end(),
                            [](const QAction *action) { return action->shortcut() == Qt::Key_X; }));
        QCOMPARE(w->eventTable().selectedEvent(), track.id);
        bench.input()->setSelectedTrack(0);
        bench.output()->setSelectedTrack(0);
        const QImage before = bench.output()->grab().toImage();
        bench.output()->plane()->setFocus();
        QTest::keyClick(bench.output()->plane(), Qt::Key_X);
        QCOMPARE(w->document().annotations().reviews.size(), std::size_t(1));
        QCOMPARE(w->document().annotations().reviews.front().verdict, Verdict::Rejected);
        QVERIFY(bench.output()->grab().toImage() != before);
        QTest::keyClick(bench.output()->plane(), Qt::Key_U);
        QVERIFY(bench.output()->grab().toImage() == before);
        QMenu nothing;
        emit bench.output()->plane()->contextMenuRequested(&nothing, place.along + 300.0, place.across + 90.0);
        QVERIFY(nothing.isEmpty());
    }

    void splittersAreRemembered()
    {
        QList<QList<int>> shares;
        const auto splitters = [](const MainWindow &w) { return w.findChildren<QSplitter *>(); };
        const auto sharesOf = [&](MainWindow &w) {
            QList<QList<int>> result;
            for (const QSplitter *splitter : splitters(w))
                if (w.pingBench().isAncestorOf(splitter))
                    result << splitter->sizes();
            return result;
        };
        {
            const auto w = window(true);
            QVERIFY(openWithNineRates(*w, path("pings.json")));
            const QList<QList<int>> asBuilt = sharesOf(*w);
            QCOMPARE(asBuilt.size(), 3);
            for (QSplitter *splitter : splitters(*w))
                if (w->pingBench().isAncestorOf(splitter)) {
                    QList<int> sizes = splitter->sizes();
                    sizes.front() -= 40;
                    sizes.back() += 40;
                    splitter->setSizes(sizes);
                }
            shares = sharesOf(*w);
            QVERIFY(shares != asBuilt);
            w->close();
        }
        {
            const auto w = window(true); // lines only: what is not seen stays remembered
            QVERIFY(openAndSettle(*w, path("line.json")));
            w->close();
        }
        const auto w = window(true);
        QVERIFY(openWithNineRates(*w, path("pings.json")));
        QCOMPARE(sharesOf(*w), shares);
    }
};

FAINTLINE_WINDOW_TEST(tst_PingBench)
#include "tst_PingBench.moc"

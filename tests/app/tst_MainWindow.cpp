// The window from outside: what a person does, and what is to be seen then.

#include "app/base/MessageBar.h"
#include "app/base/filePath.h"
#include "app/commands/KeysOverlay.h"
#include "app/document/OutputLayers.h"
#include "app/features/opening/WelcomePage.h"
#include "app/features/pictures/PlainInput.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "app/views/WindowViews.h"
#include "exchange/Session.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/events/EventModel.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/plot/StripPlot.h"
#include "widgets/waterfall/LayerItem.h"

#include <qwt_plot_canvas.h>
#include <qwt_scale_map.h>

#include <QDockWidget>
#include <QDropEvent>
#include <QLabel>
#include <QMenuBar>
#include <QStatusBar>
#include <QTableView>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace faintline;
using namespace faintline::test;

namespace {

/// 16-bit mono WAV: noise and a tone that drifts.
QByteArray wav(int rate, double seconds)
{
    const int count = int(rate * seconds);
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0.0, 2000.0);
    QByteArray samples;
    QDataStream data(&samples, QIODevice::WriteOnly);
    data.setByteOrder(QDataStream::LittleEndian);
    for (int i = 0; i < count; ++i) {
        const double t = double(i) / rate;
        const double phase = 2.0 * std::numbers::pi * (200.0 * t + 0.5 * t * t);
        data << static_cast<qint16>(std::lround(noise(random) + 800.0 * std::sin(phase)));
    }
    QByteArray file;
    QDataStream header(&file, QIODevice::WriteOnly);
    header.setByteOrder(QDataStream::LittleEndian);
    header.writeRawData("RIFF", 4);
    header << quint32(36 + samples.size());
    header.writeRawData("WAVEfmt ", 8);
    header << quint32(16) << quint16(1) << quint16(1) << quint32(rate) << quint32(2 * rate) << quint16(2)
           << quint16(16);
    header.writeRawData("data", 4);
    header << quint32(samples.size());
    return file + samples;
}

/// Where a statistic lies on the canvas of the threshold plot.
QPoint positionOf(ExceedancePlot &plot, double nats)
{
    const QwtScaleMap map = plot.canvasMap(QwtAxis::XBottom);
    return {int(std::lround(map.transform(nats))), plot.canvas()->height() / 2};
}

void drop(QWidget &widget, const QString &path)
{
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(path)});
    QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&widget, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent event(QPointF(50.0, 50.0), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&widget, &event);
}

} // namespace

class tst_MainWindow : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;
    QString m_scene;

    QString path(const QString &name) const { return m_folder.filePath(name); }

    static void choose(MainWindow &window, const QString &action)
    {
        for (QAction *one : window.findChildren<QAction *>())
            if (one->text().remove(QLatin1Char('&')) == action && !one->menu())
                return one->trigger();
        QFAIL("no such action");
    }

    std::unique_ptr<MainWindow> window(bool remembers = false) const
    {
        return newWindow({1400, 900},
                         remembers ? std::make_unique<QSettings>(path("memory.ini"), QSettings::IniFormat) : nullptr);
    }

private slots:
    void stoppedSaysSo()
    {
        MainWindow window;
        window.setAsking(false);
        window.show();
        const auto says = [&window](const QString &words) {
            const auto labels = window.findChildren<QLabel *>();
            return std::any_of(labels.begin(), labels.end(),
                               [&](const QLabel *label) { return label->text().startsWith(words); });
        };
        // As soon as it is open, in the midst of its first analysis.
        connect(&window.document(), &Document::opened, &window, [&] {
            QTimer::singleShot(0, &window, [&] {
                QVERIFY(says("Reading"));
                window.controller().stop();
            });
        });
        QTemporaryDir folder;
        const QString path = writeFile(
            folder, "long.json", R"({"kind": "lines", "sampleRateHz": 48000, "durationSeconds": 36000, "lines": []})");
        QVERIFY(openAndSettle(window, path));
        QVERIFY(!window.document().analysis());
        QVERIFY(says("Stopped"));
    }

    void initTestCase()
    {
        Theme::apply(Theme::Kind::Dark);
        m_scene = writeFile(m_folder, "scene.json",
                            R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 60, "lines": [
            {"snrDb": 9, "referenceSeconds": 0.5, "startSeconds": 5, "durationSeconds": 40, "frequencyHz": 120,
             "driftHzPerSecond": 1},
            {"snrDb": 4, "referenceSeconds": 0.5, "startSeconds": 20, "durationSeconds": 20, "frequencyHz": 350}]})");
        writeFile(m_folder, "tone.wav", wav(1000, 60.0));
        writeFile(m_folder, "text.wav", "This is no sound.");
        writeFile(m_folder, "short.wav", wav(1000, 0.01));
    }

    void beginsWithThePicturesAndNoDialog()
    {
        auto window = this->window();
        QVERIFY(window->welcome().isVisible());
        QVERIFY(!window->workbench().isVisible());
        QVERIFY(!window->controller().isBusy());
        QCOMPARE(window->messages().text(), QString());
    }

    void opensAScenario()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, m_scene));
        QVERIFY(window->workbench().isVisible());
        QVERIFY(window->workbench().input()->picture());
        QVERIFY(window->workbench().output()->picture());
        QVERIFY(window->document().shownEvents().size() >= 2);
        QCOMPARE(shownIds(window->eventTable()).size(), window->document().shownEvents().size());
        QCOMPARE(window->document().truth().lines.size(), std::size_t(2));
        QVERIFY(window->windowTitle().startsWith("scene.json"));
        QVERIFY(window->document().viewport().cursor());
        QCOMPARE(window->workbench().output()->threshold(), window->document().analysis()->threshold);
    }

    void opensAWavThatIsDropped()
    {
        auto window = this->window();
        drop(*window, path("tone.wav"));
        QVERIFY(settle(*window));
        QCOMPARE(window->messages().text(), QString());
        const std::vector<Event> events = window->document().shownEvents();
        QVERIFY(!events.empty());
        QVERIFY(events.front().position.back() > 190.0 && events.front().position.back() < 270.0);
        // All of the first five seconds: both pictures with ranges from the data, marks, a cursor, a threshold to drag,
        // a sentence.
        for (const WaterfallView *view : {window->workbench().input(), window->workbench().output()}) {
            QVERIFY(view->isVisible());
            QVERIFY(view->picture());
            QVERIFY(view->isRangeAutomatic());
            QCOMPARE(view->range(), view->automaticRange());
            QVERIFY(view->range().width() > 5.0);
            QVERIFY(view->display().shows(PictureDisplay::EventLayer));
        }
        QCOMPARE(shownIds(window->eventTable()).size(), events.size());
        QVERIFY(window->document().viewport().cursor());
        QVERIFY(window->thresholdPlot().isVisible());
        const auto labels = window->statusBar()->findChildren<QLabel *>();
        QVERIFY(std::any_of(labels.begin(), labels.end(),
                            [](const QLabel *label) { return label->text().contains("threshold"); }));
        QVERIFY(!QApplication::activeModalWidget());
    }

    void theThresholdIsDraggedAndUndone()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, m_scene));
        Document &document = window->document();
        ExceedancePlot &plot = window->thresholdPlot();
        const std::vector<int> before = shownIds(window->eventTable());
        const auto isPreview = [&window] {
            const auto labels = window->eventTable().findChildren<QLabel *>();
            return std::ranges::any_of(labels,
                                       [](const QLabel *label) { return label->text().startsWith("Preview: "); });
        };
        std::map<int, double> places;
        for (const Event &event : document.shownEvents())
            places[event.id] = event.position.front();
        QVERIFY(!isPreview());
        const double threshold = document.analysis()->threshold;
        double strongest = 0.0;
        double weakest = 1e9;
        for (const Event &event : document.shownEvents()) {
            strongest = std::max(strongest, event.statistic);
            weakest = std::min(weakest, event.statistic);
        }
        const double between = std::min(0.5 * (weakest + strongest), weakest + 1.0); // on the axis
        QVERIFY(before.size() >= 2 && between > weakest);

        // While it moves: fewer events, at once, and nothing runs.
        QTest::mousePress(plot.canvas(), Qt::LeftButton, {}, positionOf(plot, threshold));
        QTest::mouseMove(plot.canvas(), positionOf(plot, between));
        QVERIFY(!window->controller().isBusy());
        QVERIFY2(std::abs(document.shownThreshold() - between) < 0.5,
                 qPrintable(QString("%1, wanted %2 of %3 … %4, now %5")
                                .arg(document.shownThreshold())
                                .arg(between)
                                .arg(weakest)
                                .arg(strongest)
                                .arg(threshold)));
        QVERIFY(shownIds(window->eventTable()).size() < before.size());
        QVERIFY(!shownIds(window->eventTable()).empty());
        QVERIFY(isPreview()); // what the detector finds at this threshold is not known yet
        QCOMPARE(*window->workbench().output()->threshold(), document.shownThreshold());
        QCOMPARE(document.undoStack().count(), 0);

        // Let go: a setting, and the chain runs.
        QTest::mouseRelease(plot.canvas(), Qt::LeftButton, {}, positionOf(plot, between));
        QCOMPARE(document.undoStack().count(), 1);
        QVERIFY(window->controller().isBusy());
        QVERIFY(isPreview());
        QVERIFY(settle(*window));
        QVERIFY(document.isCurrent());
        QVERIFY(!isPreview());
        for (const Event &event : document.shownEvents()) // the numbers of the same lines
            QVERIFY(places.contains(event.id) && std::abs(places.at(event.id) - event.position.front()) < 10.0);
        QVERIFY2(std::abs(document.analysis()->threshold - between) < 0.5,
                 qPrintable(QString("%1, wanted %2").arg(document.analysis()->threshold).arg(between)));
        QVERIFY(shownIds(window->eventTable()).size() < before.size());

        QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(settle(*window));
        QCOMPARE(document.settings(), AnalysisSettings());
        QCOMPARE(document.analysis()->threshold, threshold);
        QCOMPARE(shownIds(window->eventTable()), before);

        QTest::keyClick(window.get(), Qt::Key_Y, Qt::ControlModifier);
        QVERIFY(settle(*window));
        QVERIFY(std::abs(document.analysis()->threshold - between) < 0.5);
    }

    void theThresholdKeepsItsPlaceInOtherUnits()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, m_scene));
        const double threshold = window->document().analysis()->threshold;
        for (const auto unit :
             {ExceedancePlot::Unit::PfaPerCell, ExceedancePlot::Unit::Nats, ExceedancePlot::Unit::FalseAlarmsPerHour}) {
            emit window->thresholdPlot().unitRequested(unit);
            QVERIFY(settle(*window));
            QVERIFY(std::abs(window->document().analysis()->threshold - threshold) < 0.1);
        }
        QCOMPARE(window->document().settings().decide.by, DecideSettings::By::FalseAlarmsPerHour);
    }

    void keysDoWhatTheSheetSays()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, m_scene));
        Document &document = window->document();
        WaterfallView *input = window->workbench().input();
        WaterfallView *output = window->workbench().output();
        output->setFocus();

        const auto orientation = output->direction().orientation();
        QTest::keyClick(output, Qt::Key_O);
        QVERIFY(output->direction().orientation() != orientation);
        QCOMPARE(input->direction().orientation(), output->direction().orientation());

        QTest::keyClick(output, Qt::Key_L, Qt::ShiftModifier);
        QVERIFY(input->isLogarithmic() && output->isLogarithmic());
        QVERIFY(window->workbench().viewState().isLogarithmic);
        QTest::keyClick(output, Qt::Key_L, Qt::ShiftModifier);
        QVERIFY(!output->isLogarithmic());

        const QString map = output->display().colourMap().name();
        QTest::keyClick(output, Qt::Key_C);
        QVERIFY(output->display().colourMap().name() != map);
        QCOMPARE(input->display().colourMap().name(), output->display().colourMap().name());

        document.viewport().zoomTo({10.0, 20.0}, {100.0, 200.0});
        QVERIFY(!document.viewport().showsAll());
        QTest::keyClick(output, Qt::Key_Backspace);
        QVERIFY(document.viewport().showsAll());
        document.viewport().zoomTo({10.0, 20.0}, {100.0, 200.0});
        QTest::keyClick(output, Qt::Key_0);
        QVERIFY(document.viewport().showsAll());

        QTest::keyClick(output, Qt::Key_M);
        QVERIFY(output->display().isMeasuring() && input->display().isMeasuring());
        QTest::keyClick(output, Qt::Key_M);
        QVERIFY(!output->display().isMeasuring());

        output->setRange(0.0, 10.0);
        QTest::keyClick(output, Qt::Key_A);
        QVERIFY(output->isRangeAutomatic());
        QTest::keyClick(output, Qt::Key_BraceLeft);
        QVERIFY(!output->isRangeAutomatic());

        document.viewport().setCursor({10.0, 100.0});
        QTest::keyClick(output, Qt::Key_L);
        QVERIFY(std::abs(document.viewport().cursor()->seconds - 10.0 - document.analysis()->time().step) < 1e-9);
        QTest::keyClick(output, Qt::Key_J);
        QVERIFY(std::abs(document.viewport().cursor()->seconds - 10.0) < 1e-9);
        const double hz = document.viewport().cursor()->hz;
        QTest::keyClick(output, output->direction().orientation() == WaterfallView::Orientation::LeftToRight
                                    ? Qt::Key_Up
                                    : Qt::Key_Right);
        QVERIFY(document.viewport().cursor()->hz > hz);

        QTest::keyClick(output, Qt::Key_Space);
        const double seconds = document.viewport().cursor()->seconds;
        QTRY_VERIFY(document.viewport().cursor()->seconds > seconds);
        QTest::keyClick(output, Qt::Key_Space);

        const double threshold = document.shownThreshold();
        QTest::keyClick(output, Qt::Key_Period);
        QTest::keyClick(output, Qt::Key_Period);
        QVERIFY(settle(*window));
        QVERIFY(std::abs(document.analysis()->threshold - threshold - 0.5) < 0.1);
        QCOMPARE(document.undoStack().count(), 2);
        for (int i = 0; i < 3; ++i) // held
            QTest::keyPress(output, Qt::Key_Comma);
        QTest::keyRelease(output, Qt::Key_Comma);
        QVERIFY(settle(*window));
        QVERIFY(std::abs(document.analysis()->threshold - threshold + 0.25) < 0.1);
        QCOMPARE(document.undoStack().count(), 3);
    }

    void nGoesFromEventToEvent()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, m_scene));
        WaterfallView *output = window->workbench().output();
        output->setFocus();
        const std::vector<int> ids = shownIds(window->eventTable());
        QVERIFY(ids.size() >= 2);
        QTest::keyClick(output, Qt::Key_N);
        const int first = window->eventTable().selectedEvent();
        QTest::keyClick(output, Qt::Key_N);
        const int second = window->eventTable().selectedEvent();
        QVERIFY(first != 0 && second != 0 && first != second);
        QCOMPARE(output->selectedEvent(), second);
        QCOMPARE(window->workbench().input()->selectedEvent(), second);
        const Viewport::Point cursor = *window->document().viewport().cursor();
        for (const Event &event : window->document().shownEvents())
            if (event.id == second)
                QVERIFY(std::abs(cursor.seconds - event.detectSeconds) < 1.0);
        QTest::keyClick(output, Qt::Key_N, Qt::ShiftModifier);
        QCOMPARE(window->eventTable().selectedEvent(), first);
    }

    void anEventBelowTheThresholdIsScrolledTo()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, m_scene));
        Document &document = window->document();
        const Event event = document.shownEvents().front();
        Viewport &viewport = document.viewport();
        const Viewport::Point elsewhere{1.0, 480.0};
        viewport.setCursor(elsewhere);
        viewport.zoomTo({0.0, 2.0}, {470.0, 490.0});
        QVERIFY(!viewport.frequency().contains(event.position.front()));
        document.setShownThreshold(1e6);
        QVERIFY(document.shownEvents().empty());
        emit window->eventTable().eventActivated(event.id);
        QVERIFY(viewport.frequency().contains(event.position.front()));
        QVERIFY(viewport.time().contains(event.onsetSeconds));
        QCOMPARE(*viewport.cursor(), elsewhere); // no event is shown that it could move to
    }

    void f1ShowsTheKeysAndAnyKeyTakesThemAway()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, m_scene));
        auto *sheet = window->findChild<KeysOverlay *>();
        QTest::keyClick(window.get(), Qt::Key_F1);
        QVERIFY(sheet->isVisible());
        QTest::keyClick(sheet, Qt::Key_A);
        QVERIFY(!sheet->isVisible());
        QTest::keyClick(window->workbench().output(), Qt::Key_Question);
        QVERIFY(sheet->isVisible());
        QTest::mouseClick(sheet, Qt::LeftButton);
        QVERIFY(!sheet->isVisible());
    }

    void f5LeavesThePicturesAndTheReadOut()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, m_scene));
        QVERIFY(window->eventTable().isVisible());
        QTest::keyClick(window->workbench().output(), Qt::Key_F5);
        QVERIFY(!window->eventTable().isVisible());
        QVERIFY(!window->menuBar()->isVisible());
        QVERIFY(window->workbench().output()->isVisible());
        QVERIFY(window->readOut().isVisible());
        QTest::keyClick(window->workbench().output(), Qt::Key_F5);
        QVERIFY(window->eventTable().isVisible());
        QVERIFY(window->menuBar()->isVisible());
    }

    void escapeLeavesAPresentation()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, m_scene));
        QTest::keyClick(window->workbench().output(), Qt::Key_F5);
        QVERIFY(!window->menuBar()->isVisible());
        QTest::keyClick(window->workbench().output(), Qt::Key_Escape);
        QVERIFY(window->menuBar()->isVisible());
        window->controller().run(); // and stops what runs again
        QTest::keyClick(window->workbench().output(), Qt::Key_Escape);
        QVERIFY(settle(*window));
        QVERIFY(window->menuBar()->isVisible());
    }

    void theNewestSettingsWin()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, m_scene));
        QSignalSpy analysed(&window->document(), &Document::analysisChanged);
        QSignalSpy refined(&window->controller(), &AnalysisController::refined);
        connect(&window->document(), &Document::analysisChanged, window.get(),
                [&] { QCOMPARE(window->document().analysis()->settings.model.snr, 2.0); });
        for (int i = 1; i <= 20; ++i)
            window->controller().edit("model.snr", 0.1 * i, "Change the SNR");
        QVERIFY(settle(*window));
        QVERIFY(window->document().isCurrent());
        QCOMPARE(window->document().analysis()->settings.model.snr, 2.0);
        QCOMPARE(analysed.count(), 1 + refined.count()); // a first estimate comes before the refined one
    }

    void cancelKeepsWhatIsShown()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, m_scene));
        const auto before = window->document().analysis();
        window->controller().edit("model.snr", 2.0, "Change the SNR"); // as above: one calibration less
        QVERIFY(window->controller().isBusy());
        QTest::keyClick(window.get(), Qt::Key_Escape);
        QVERIFY(!window->controller().isBusy());
        QCOMPARE(window->document().analysis(), before);
        QVERIFY(!window->document().isCurrent());
        QTest::keyClick(window.get(), Qt::Key_R, Qt::ControlModifier);
        QVERIFY(settle(*window));
        QVERIFY(window->document().isCurrent());
    }

    /// The same slopes in the other unit: nothing moves, and the analysis belongs to the settings.
    void slopesInEitherUnit()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, m_scene));
        const auto &document = window->document();
        const StateSpace before = document.analysis()->model.space;
        const Axis frequency = document.analysis()->grid().axes.back();
        const double hertz = frequency.step / document.analysis()->time().step;
        window->controller().edit("model.slopeUnit", std::string("hzPerSecond"), "Other unit");
        QVERIFY(settle(*window));
        QVERIFY(document.isCurrent());
        QVERIFY(std::abs(document.settings().model.highestSlope / hertz - 1.0) < 1e-3);
        QVERIFY(document.analysis()->settings.model == ModelSettings());
        window->controller().edit("model.highestSlope", 0.3 * hertz, "Slower");
        QVERIFY(settle(*window));
        QVERIFY(document.isCurrent());
        QCOMPARE(document.analysis()->settings.model.highestSlope, 0.375);
        QCOMPARE(document.analysis()->model.space.axes().front().rateCount, before.axes().front().rateCount - 5);
        QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier);
        QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(settle(*window));
        QVERIFY(document.isCurrent());
        QVERIFY(document.settings().model == ModelSettings());
    }

    void refusalsAreSentences()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, path("none.wav")));
        QVERIFY2(window->messages().text().contains("none.wav"), qPrintable(window->messages().text()));
        QVERIFY(window->welcome().isVisible());
        QVERIFY(openAndSettle(*window, path("text.wav")));
        QVERIFY2(window->messages().text().contains("text.wav"), qPrintable(window->messages().text()));

        QVERIFY(openAndSettle(*window, m_scene));
        QCOMPARE(window->messages().text(), QString());
        const auto before = window->document().analysis();
        QVERIFY(openAndSettle(*window, path("text.wav")));
        QVERIFY(!window->messages().text().isEmpty());
        QCOMPARE(window->document().analysis(), before); // what was open still is
        QVERIFY(window->workbench().isVisible());

        // Settings no single field can refuse: said, and undone as any other.
        window->controller().edit("model.lowestSlope", 5.0, "Change the slope");
        QVERIFY(settle(*window));
        QVERIFY2(window->messages().text().contains("lowestSlope"), qPrintable(window->messages().text()));
        QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(settle(*window));
        QCOMPARE(window->messages().text(), QString());
        QVERIFY(window->document().isCurrent());
    }

    void aRecordingThatIsTooShortSaysSoAndLeavesTheForm()
    {
        auto window = this->window();
        window->open(path("short.wav"), {},
                     [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 1.0; });
        QVERIFY(settle(*window));
        QVERIFY(!window->messages().text().isEmpty());
        QVERIFY(window->workbench().isVisible());
        QVERIFY(!window->document().analysis());
    }

    void sessionsComeBack()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, path("tone.wav")));
        writeSession(pathBytes(path("s.faintline")), {window->document().source(), {}, window->document().settings()});
        QVERIFY(openAndSettle(*window, path("s.faintline")));
        QVERIFY(window->windowTitle().startsWith("s.faintline"));

        window->controller().edit("model.snr", 2.0, "Change the SNR");
        QVERIFY(settle(*window));
        QVERIFY(window->isWindowModified());
        window->document().viewport().zoomTo({10.0, 20.0}, {100.0, 200.0});
        window->workbench().output()->display().setColourMap("viridis");
        const Viewport::Box visible = window->document().viewport().visible();
        QSignalSpy saved(window.get(), &MainWindow::saved);
        QTest::keyClick(window.get(), Qt::Key_S, Qt::ControlModifier);
        QVERIFY(saved.wait(patience));
        QVERIFY(!window->isWindowModified());

        auto other = this->window();
        QVERIFY(openAndSettle(*other, path("s.faintline")));
        QCOMPARE(other->document().settings(), window->document().settings());
        QVERIFY(other->document().viewport().visible() == visible);
        QCOMPARE(other->workbench().input()->display().colourMap().name(), "viridis");
        QCOMPARE(other->document().shownEvents().size(), window->document().shownEvents().size());
        QVERIFY(!other->isWindowModified());
    }

    void savedViewsAreMadeAgain()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, m_scene));
        window->workbench().output()->display().setColourMap("cividis");
        window->document().viewport().zoomTo({4.0, 16.0}, {100.0, 300.0});
        for (const QString &name : {QString("input"), QString("output"), QString("threshold")}) {
            const QString file = path(name + ".png");
            window->views().saveTo(name, file);
            QProcess replay;
            replay.start(QStringLiteral(FAINTLINE_BINARY_DIR "/app/faintline"), {"replay", file});
            QVERIFY(replay.waitForFinished(patience));
            QVERIFY2(replay.readAllStandardOutput() == name.toUtf8() + ".png: the same pixels\n",
                     replay.readAllStandardError().constData());
        }
        window->views().saveTo("window", path("window.png")); // where its panels are, it does not tell
        QProcess replay;
        replay.start(QStringLiteral(FAINTLINE_BINARY_DIR "/app/faintline"), {"replay", path("window.png")});
        QVERIFY(replay.waitForFinished(patience));
        const QByteArray error = replay.readAllStandardError();
        QVERIFY2(error.startsWith("error: ") && error.contains("cannot be reproduced") && error.count('\n') == 1,
                 error.constData());
    }

    void aFirstWindowShowsWhatWasFoundBelowTheInput()
    {
        {
            auto window = this->window(true);
            QSignalSpy pictures(&window->document(), &Document::picturesGrew);
            QVERIFY(openAndSettle(*window, m_scene));
            QVERIFY(!pictures.isEmpty()); // before the result
            Workbench &bench = window->workbench();
            const auto top = [&](const QWidget *view) { return view->mapTo(window.get(), QPoint()).y(); };
            QVERIFY(top(bench.input()) + bench.input()->height() <= top(bench.output()));
            QCOMPARE(bench.output()->direction().orientation(), WaterfallView::Orientation::LeftToRight);
            QVERIFY(settle(bench.layers()));
            QCOMPARE(itemOf<LayerItem>(*bench.output()).picture()->presence.empty(), false);
            QVERIFY(bench.output()->heading().contains("found"));
            QTest::keyClick(bench.output(), Qt::Key_F);
            QVERIFY(bench.output()->heading().startsWith("Statistic D"));
            for (const char *dock : {"thresholdDock", "settingsDock", "eventsDock", "whyDock"})
                QVERIFY2(window->findChild<QDockWidget *>(dock)->isVisible(), dock);
            for (const char *dock : {"pipelineDock", "noiseDock", "noiseFitDock", "statesDock"})
                QVERIFY2(!window->findChild<QDockWidget *>(dock)->isVisible(), dock);
            window->close();
        }
        auto window = this->window(true); // as it was left
        QCOMPARE(window->workbench().layers().chosen(), OutputLayer::Statistic);
        window.reset();
        QFile::remove(path("memory.ini"));
    }

    void remembersFilesAndLayout()
    {
        {
            auto window = this->window(true);
            QVERIFY(openAndSettle(*window, path("tone.wav")));
            QVERIFY(openAndSettle(*window, m_scene));
            window->workbench().output()->display().setColourMap("cividis");
            window->close();
        }
        auto window = this->window(true);
        QVERIFY(openAndSettle(*window, m_scene));
        QCOMPARE(window->workbench().output()->display().colourMap().name(), "cividis");
        QSettings memory(path("memory.ini"), QSettings::IniFormat);
        QCOMPARE(memory.value("recent").toStringList(), (QStringList{m_scene, path("tone.wav")}));
    }

    void closesInTheMiddleOfAJob()
    {
        QElapsedTimer clock;
        clock.start();
        for (int i = 0; i < 5; ++i) {
            auto window = this->window();
            window->open(path("tone.wav"));
            QTest::qWait(20 * i);
        }
        QVERIFY(clock.elapsed() < 20000 * slowdown);
    }

    void theInputIsShownAsPlainDbAndBack()
    {
        auto window = this->window();
        QVERIFY(openAndSettle(*window, path("tone.wav")));
        WaterfallView *input = window->workbench().input();
        PlainInput &plain = window->workbench().plainInput();
        const auto overNoise = input->picture();
        QTest::keyClick(window.get(), Qt::Key_D, Qt::ShiftModifier);
        QVERIFY(isBusy(plain));
        QVERIFY(settle(plain));
        QVERIFY(input->isPlain() && input->picture() != overNoise);
        QVERIFY2(input->heading().contains("full scale²/Hz"), qPrintable(input->heading()));
        // Another analysis shows its own.
        window->controller().edit("spectrogram.windowSeconds", 0.5, "window");
        QVERIFY(settle(*window));
        QVERIFY(settle(plain));
        QVERIFY(input->isPlain());
        QCOMPARE(input->picture()->time(), window->document().analysis()->time());
        QTest::keyClick(window.get(), Qt::Key_D, Qt::ShiftModifier);
        QVERIFY(!input->isPlain());
        QCOMPARE(input->picture(), window->document().analysis()->input);
        QVERIFY(input->isRangeAutomatic());
    }

    void snrsAreGivenInTheChosenBandwidth()
    {
        {
            auto window = this->window(true);
            QVERIFY(openAndSettle(*window, m_scene));
            const QAbstractItemModel &table = *window->eventTable().table()->model();
            const auto snr = [&] { return table.index(0, EventModel::Snr).data().toDouble(); };
            const double ofABin = snr();
            choose(*window, "of 2500 Hz, as WSJT-X gives it");
            const Event &event = window->document().shownEvents().front();
            // A Hann window's bin has a noise bandwidth of 1.5 resolution cells.
            QVERIFY(std::abs(snr() - ofABin - 10.0 * std::log10(1.5 / (2500.0 * event.windowSeconds))) < 0.11);
            QCOMPARE(table.headerData(EventModel::Snr, Qt::Horizontal).toString(), QString("SNR (dB in 2500 Hz)"));
            QVERIFY(std::abs(event.snrDb - ofABin) < 0.06); // files have that of the bin
        }
        auto window = this->window(true);
        QVERIFY(openAndSettle(*window, m_scene));
        const QAbstractItemModel &table = *window->eventTable().table()->model();
        QCOMPARE(table.headerData(EventModel::Snr, Qt::Horizontal).toString(), QString("SNR (dB in 2500 Hz)"));
    }

    void resetsAreShownOnDemand()
    {
        auto window = this->window();
        window->resize(1400, 1000);
        QVERIFY(openAndSettle(*window, m_scene));
        QVERIFY(window->workbench().regulationPlot()->isVisible());
        choose(*window, "Analyse");
        QVERIFY(!window->workbench().regulationPlot()->isVisible());
        choose(*window, "Researcher");
        QVERIFY(window->workbench().regulationPlot()->isVisible());
    }
};

FAINTLINE_WINDOW_TEST(tst_MainWindow)
#include "tst_MainWindow.moc"

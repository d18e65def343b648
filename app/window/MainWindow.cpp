#include "app/window/MainWindow.h"

#include "app/base/MessageBar.h"
#include "app/base/distinctLabels.h"
#include "app/base/filePath.h"
#include "app/base/screenSizes.h"
#include "app/control/OutputLayers.h"
#include "app/control/Playback.h"
#include "app/control/ShownEvents.h"
#include "app/control/hint.h"
#include "app/document/Recovery.h"
#include "app/document/SessionSaver.h"
#include "app/help/EquationSheet.h"
#include "app/help/KeysOverlay.h"
#include "app/lessons/Lesson.h"
#include "app/lessons/LessonGuide.h"
#include "app/lessons/LessonList.h"
#include "app/panels/EvaluatePanel.h"
#include "app/panels/ExperimentsPanel.h"
#include "app/panels/PipelinePanel.h"
#include "app/panels/ReproductionPanel.h"
#include "app/panels/SequentialPanel.h"
#include "app/panels/SweepPanel.h"
#include "app/views/ChartMenus.h"
#include "app/views/ReportWriter.h"
#include "app/views/WindowViews.h"
#include "app/welcome/WelcomePage.h"
#include "app/window/CommandPalette.h"
#include "app/window/Commands.h"
#include "app/window/Listening.h"
#include "app/window/Opener.h"
#include "app/window/Panels.h"
#include "app/window/ToolBar.h"
#include "app/window/TrialViewer.h"
#include "app/window/currentView.h"
#include "app/window/settingCommands.h"
#include "app/workspace/PingBench.h"
#include "app/workspace/Workbench.h"
#include "widgets/base/icon.h"
#include "widgets/base/labelText.h"
#include "widgets/events/EventCard.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/plot/WalkPlot.h"

#include <QCloseEvent>
#include <QDockWidget>
#include <QFileDialog>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QStackedWidget>
#include <QToolBar>

namespace faintline {

namespace {

    /// Qt moves the panels behind a tab off the window and leaves them visible.
    bool isBehindTab(const QWidget *widget)
    {
        for (; widget && !widget->isWindow(); widget = widget->parentWidget())
            if (const auto *dock = qobject_cast<const QDockWidget *>(widget))
                return dock->visibleRegion().isEmpty();
        return false;
    }

} // namespace

MainWindow::MainWindow(std::unique_ptr<QSettings> memory, const QString &recoveryFolder, QWidget *parent)
    : QMainWindow(parent), m_memory(std::move(memory)), m_recoveryFolder(recoveryFolder)
{
    setObjectName(QStringLiteral("MainWindow"));
    setAnimated(false);
    m_panels = new Panels(*this);
    m_views = new WindowViews(*this, this);
    buildCentre();
    buildPanels();
    buildBottom();
    buildStatusBar();
    m_lessons = new LessonGuide(*this, *this);
    m_opener = new Opener(*this, *m_lessons, m_memory, *this);
    m_saver = new SessionSaver(
        m_document, [this] { return viewState(); }, this);
    m_recovery = new Recovery(
        m_document, [this] { return viewState(); }, m_recoveryFolder, this);
    m_report = new ReportWriter(m_document, *m_views, this);
    m_trials = std::make_unique<TrialViewer>(m_experiments, this);
    m_chartMenus = new ChartMenus(*this, this);
    m_commands = makeCommands(*this);
    nameWhatHolds();
    buildToolBar();
    connectCommands();
    connectDocument();
    connectController();
    connectLessons();
    connectParts();
    m_keys = new KeysOverlay(this);
    m_equation = new EquationSheet(this);
    m_palette = new CommandPalette(this);
    m_settingsMenu = new QMenu(tr("Setting"), this);
    resize(1440, 900);
    m_panels->rememberDefault();
    restoreLayout();
    showWelcome();
    showHint();
    showTitle();
}

MainWindow::~MainWindow()
{
    hide(); // panels hide while what they show still exists
    m_listening->disconnect();
    m_listening->run().disconnect(m_listening);
    m_controller.disconnect(this); // running jobs end after the widgets are destroyed
    m_document.disconnect(this);
    m_comparer.disconnect();
    m_check.disconnect();
    m_experiments.disconnect();
    m_sequentialTests.disconnect();
    m_trials.reset();
}

/// Names focusable container widgets after the panel that contains them.
void MainWindow::nameWhatHolds()
{
    for (QWidget *widget : findChildren<QWidget *>()) {
        const bool isHolder = widget->inherits("QScrollArea") || widget->inherits("QTabWidget");
        if (!isHolder || !widget->accessibleName().isEmpty())
            continue;
        QWidget *panel = widget->parentWidget();
        while (panel && panel->windowTitle().isEmpty() && panel != this)
            panel = panel->parentWidget();
        widget->setAccessibleName(panel && panel != this ? panel->windowTitle() : tr("Welcome"));
    }
}

void MainWindow::buildToolBar()
{
    auto *bar = new ToolBar(tr("Tools"));
    addToolBar(bar);
    bar->setObjectName(QStringLiteral("toolBar"));
    const auto add = [this, bar](std::initializer_list<const char *> names, bool keepsText) {
        for (const char *name : names)
            bar->addAction(m_commands->action(name), QLatin1String(name), keepsText);
    };
    add({"open"}, true);
    QAction *examples = m_commands->menu(tr("&File/Exa&mples"))->menuAction();
    examples->setToolTip(tr("Open a recording or a simulated scene that comes with the program"));
    bar->addAction(examples, QStringLiteral("scenario"), true);
    bar->addSeparator();
    add({"run", "stop"}, true);
    bar->addSeparator();
    add({"orientation", "colours", "show-all"}, false);
    bar->addSeparator();
    add({"step-back", "play", "step-forward"}, false);
    bar->addSeparator();
    add({"next-event"}, false);
}

/// What is on or off, and shown or changed in other places as well.
void MainWindow::connectCommands()
{
    const auto toggle = [this](const char *name, auto set) {
        QAction *action = m_commands->action(name);
        action->setCheckable(true);
        connect(action, &QAction::toggled, this, set);
        return action;
    };
    WaterfallView *input = m_workbench->input(), *output = m_workbench->output();
    QAction *harmonics = toggle("harmonics", [input, output](bool isOn) {
        input->setHarmonics(isOn);
        output->setHarmonics(isOn);
    });
    connect(input, &WaterfallView::harmonicsChanged, harmonics, &QAction::setChecked);
    connect(output, &WaterfallView::harmonicsChanged, harmonics, &QAction::setChecked);
    QAction *sidebands = toggle("sidebands", [output](bool isOn) { output->setSidebands(isOn); });
    connect(output, &WaterfallView::sidebandsChanged, sidebands,
            [sidebands](double hz) { sidebands->setChecked(hz > 0.0); });
    toggle("regulation", [this](bool isOn) { m_workbench->setRegulationWanted(isOn); })->setChecked(true);
    QAction *stop = m_commands->action("stop");
    stop->setEnabled(false);
    m_events->card().setActions({m_commands->action("why"), m_commands->action("hear"), harmonics,
                                 m_commands->action("straighten"), m_commands->action("doppler")});

    QAction *play = toggle("play", &MainWindow::setPlaying);
    connect(play, &QAction::toggled, play,
            [play](bool isOn) { play->setIcon(icon(isOn ? QStringLiteral("pause") : QStringLiteral("play"))); });
    connect(m_playback, &Playback::playingChanged, play, &QAction::setChecked);
    // Space also presses the focused button, so it plays only in the pictures.
    play->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    removeAction(play);
    for (Bench *one : std::initializer_list<Bench *>{m_workbench, m_pings}) {
        connect(one, &Bench::playingChanged, play, &QAction::setChecked);
        one->addAction(play);
    }

    QAction *presenting = toggle("present", [this, stop](bool isPresenting) {
        stop->setEnabled(isPresenting || m_controller.isBusy());
        m_panels->setPresenting(isPresenting);
        Theme::setPlotScale(isPresenting ? 1.5 : 1.0);
        m_lessons->present(isPresenting);
    });
    connect(&m_controller, &AnalysisController::busyChanged, stop,
            [stop, presenting](bool isBusy) { stop->setEnabled(isBusy || presenting->isChecked()); });
    connect(m_lessons, &LessonGuide::finished, this, [this](const QString &path) {
        m_memory.addDoneLesson(path);
        m_lessonList->setDone(m_memory.doneLessons());
        m_commands->refresh();
    });
    m_lessonList->setDone(m_memory.doneLessons());
}

/// The document stays open.
void MainWindow::putBenchAside()
{
    saveLayout();
    m_pages->show();
    m_pages->setCurrentWidget(m_welcome);
    m_panels->hide();
    m_legend->hide();
    for (QToolBar *bar : m_bottomBars)
        bar->hide();
    m_commands->setShown(false);
}

void MainWindow::showWelcome()
{
    if (!m_listening->mayLeave(tr("going to the welcome page")))
        return;
    m_lessons->leave();
    m_commands->action("present")->setChecked(false);
    putBenchAside();
    m_welcome->setRecent(m_memory.recent());
}

void MainWindow::showWorkbench()
{
    m_pages->show();
    if (m_pages->currentWidget() == &bench())
        return;
    m_panels->setLeastPictures(bench().hasReadOut() ? Panels::leastWithBars : Panels::leastAlone);
    m_pages->setCurrentWidget(&bench());
    if (const QByteArray panels = m_memory.layout().panels; panels.isEmpty() || !restoreState(panels))
        takeLayout(m_memory.isKept() ? Panels::analyse() : Panels::researcher());
    showBars();
    m_legend->show();
    m_commands->setShown(true);
    bench().firstView()->setFocus();
}

void MainWindow::showHint()
{
    m_hint->setText(hint(m_document, m_controller.isBusy(), bench().hint()));
}

void MainWindow::showTitle()
{
    const QString path = m_document.sessionPath().isEmpty() ? m_document.sourcePath() : m_document.sessionPath();
    const QString name =
        path.isEmpty() ? m_document.sourceName() : distinctLabel(absolutePath(path), m_memory.recent());
    setWindowTitle(m_document.isEmpty() ? tr("Faintline") : tr("%1[*] — Faintline").arg(name));
    setWindowModified(m_document.isModified());
}

void MainWindow::showError(const Error &error)
{
    m_messages->showMessage(MessageBar::Kind::Error, QString::fromStdString(error.where()),
                            QString::fromStdString(error.why()));
}

void MainWindow::showFailure(const Error &error)
{
    showError(error);
    if (m_document.isEmpty())
        return showWelcome();
    if (m_document.analysis())
        return;
    // Opened but not analysable: the form is needed to change the settings.
    bench().setEmptySentence(tr("No analysis with these settings."));
    m_events->setEmptySentence(tr("No analysis with these settings."));
    m_threshold->setCalibration({}, 0.0);
    m_events->setEvents({});
    showWorkbench();
}

/// Read-out and overview, of which low windows have the first alone.
void MainWindow::showBars()
{
    for (QToolBar *bar : m_bottomBars)
        bar->setVisible(!bench().hasReadOut() && (bar == m_bottomBars.front() || height() >= overviewFrom));
}

void MainWindow::resizeEvent(QResizeEvent *event)
{
    QMainWindow::resizeEvent(event);
    const bool isOther = (event->oldSize().height() >= overviewFrom) != (height() >= overviewFrom);
    const bool isPresenting = !menuBar()->isVisible();
    if (isOther && !isPresenting && m_pages->currentWidget() == &bench())
        showBars();
}

void MainWindow::closeEvent(QCloseEvent *event)
{
    if (m_listening->isRunning()) { // received samples are written and analysed first
        event->ignore();
        if (m_listening->isLeaving() || !m_opener->isAsking()
            || QMessageBox::question(this, tr("Listening"), tr("Stop listening and close the window?"))
                   == QMessageBox::Yes)
            m_listening->leave();
        return;
    }
    if (!m_saver->mayLose(tr("closing"), [this] { close(); }))
        return event->ignore();
    m_lessons->leave();
    saveLayout();
    m_controller.stop();
    event->accept();
}

bool MainWindow::focusNextPrevChild(bool next)
{
    const QWidget *first = nullptr; // of those behind a tab
    while (QMainWindow::focusNextPrevChild(next)) {
        if (focusWidget() == first || !isBehindTab(focusWidget()))
            return true;
        first = first ? first : focusWidget();
    }
    return false;
}

void MainWindow::takeLayout(const QString &name)
{
    m_panels->takeLayout(name);
    m_commands->action("regulation")->setChecked(name != Panels::analyse());
}

void MainWindow::saveLayout()
{
    if (m_pages->currentWidget() == m_welcome || m_commands->action("present")->isChecked())
        return;
    m_panels->restoreMaximised();
    const ViewState view = m_workbench->viewState();
    WindowMemory::Layout layout = m_memory.layout(); // keeps the layout of the hidden bench
    (&bench() == m_pings ? layout.pingSplitters : layout.splitters) = bench().saveSplitters();
    layout.geometry = saveGeometry();
    layout.panels = saveState();
    layout.colourMap = view.colourMap;
    layout.orientation = view.orientation;
    layout.isLogarithmic = view.isLogarithmic;
    layout.isRadioAxis = view.isRadioAxis;
    const std::string_view layer = outputLayerNames[std::size_t(m_workbench->layers().chosen())];
    layout.layer = QString::fromLatin1(layer.data(), qsizetype(layer.size()));
    layout.isRegulationShown = m_commands->action("regulation")->isChecked();
    m_memory.setLayout(layout);
}

void MainWindow::restoreLayout()
{
    const WindowMemory::Layout layout = m_memory.layout();
    restoreGeometry(layout.geometry);
    if (!layout.splitters.isEmpty())
        m_workbench->restoreSplitters(layout.splitters);
    if (!layout.pingSplitters.isEmpty())
        m_pings->restoreSplitters(layout.pingSplitters);
    m_workbench->restore({{}, {}, layout.orientation, layout.colourMap, layout.isLogarithmic, layout.isRadioAxis});
    m_commands->action("regulation")->setChecked(layout.isRegulationShown);
    const auto layer = std::ranges::find(outputLayerNames, layout.layer.toStdString());
    if (layer != outputLayerNames.end())
        m_workbench->layers().setLayer(OutputLayer(layer - outputLayerNames.begin()));
}

void MainWindow::setSnrBandwidth(double hz)
{
    m_memory.setSnrBandwidthHz(hz);
    m_shownEvents->setSnrBandwidth(hz);
}

void MainWindow::exportReport()
{
    const QString path = QFileDialog::getSaveFileName(
        this, tr("Export report"), nameBeside(m_document.sourcePath(), QStringLiteral(".html")), tr("Report (*.html)"));
    if (!path.isEmpty())
        m_report->write(path);
}

void MainWindow::reproduce(const Reproducible &reproducible, bool quick)
{
    ReproduceOptions options;
    options.quick = quick;
    showWorkbench();
    show(panel<ExperimentsPanel>());
    m_experiments.start(reproducible, options);
}

void MainWindow::showExperiment(int id)
{
    const Experiments::Entry *entry = m_experiments.entry(id);
    if (!entry)
        return;
    if (entry->reproduction) {
        panel<ReproductionPanel>().show(entry->reproduction);
        return show(panel<ReproductionPanel>());
    }
    if (entry->reproducible)
        return;
    const bool isSweep = entry->campaign && std::holds_alternative<SweepExperiment>(entry->campaign->experiment);
    isSweep ? panel<SweepPanel>().show(id) : panel<EvaluatePanel>().show(id);
    QWidget &shown = isSweep ? static_cast<QWidget &>(panel<SweepPanel>()) : panel<EvaluatePanel>();
    if (!m_document.isEmpty())
        return show(shown);
    showAlone(shown, tr("%1 — Faintline").arg(entry->name), tr("The curves grow while the experiment runs."));
}

void MainWindow::show(QWidget &panel)
{
    m_panels->show(panel);
}

void MainWindow::showView(const QString &name)
{
    show(*m_views->named(name));
}

void MainWindow::showAlone(QWidget &panel, const QString &title, const QString &hint)
{
    m_messages->dismiss();
    if (m_document.isEmpty() || m_pages->currentWidget() == m_welcome) {
        m_pages->hide(); // makes room for the panel
        setWindowTitle(title);
        m_hint->setText(hint);
    }
    show(panel);
}

void MainWindow::openScans(const ScanTest &test)
{
    m_commands->action("present")->setEnabled(true);
    if (m_lessons->isRunning())
        putBenchAside(); // an open recording has nothing to do with the lesson
    auto &sequential = panel<SequentialPanel>();
    showAlone(sequential, tr("Radar scans — Faintline"),
              tr("Click a walk to follow that test. J and L step through its stages."));
    sequential.start(test);
    sequential.walk().setFocus(); // for J and L
}

void MainWindow::goTo(int event)
{
    bench().selectEvent(event);
    m_events->setSelectedEvent(event);
}

void MainWindow::open(const QString &path, const OpenOptions &options, const AnalysisController::Adjust &adjust)
{
    m_opener->open(path, options, adjust);
}

void MainWindow::openNow(const QString &path, const OpenOptions &options, const AnalysisController::Adjust &adjust)
{
    m_opener->openNow(path, options, adjust);
}

void MainWindow::newScene()
{
    m_opener->newScene();
}

void MainWindow::offerRecovery()
{
    m_opener->offerRecovery(m_recoveryFolder);
}

void MainWindow::listenTo(LiveRun::OpenSource source, const QString &folder,
                          const std::optional<AnalysisSettings> &settings, const RotationSettings &rotation)
{
    m_listening->start(std::move(source), folder, settings, rotation);
}

LiveRun &MainWindow::live()
{
    return m_listening->run();
}

LiveBar &MainWindow::liveBar()
{
    return m_listening->bar();
}

bool MainWindow::mayLeave(const QString &what, const std::function<void()> &next)
{
    return m_listening->mayLeave(what) && m_saver->mayLose(what, next);
}

void MainWindow::setAsking(bool isAsking)
{
    m_opener->setAsking(isAsking);
    m_saver->setAsking(isAsking);
}

void MainWindow::showWritten(const QString &path)
{
    m_messages->showMessage(MessageBar::Kind::Notice, tr("Written"),
                            labelText(pathBytes(absolutePath(path)), longestPath));
}

/// Plays sound; without sound only the cursor moves. In a live run the picture continues.
void MainWindow::setPlaying(bool isPlaying)
{
    if (m_document.takesAnalyses()) {
        if (!isPlaying)
            m_playback->stop();
        else if (&bench() == m_workbench && (m_playback->isPlaying() || m_playback->start()))
            return;
    }
    bench().setPlaying(isPlaying);
}

void MainWindow::setTheme(Theme::Kind kind)
{
    Theme::apply(kind);
    m_memory.setTheme(kind);
}

void MainWindow::showEquation()
{
    const QString name = currentView(*this, *this);
    const bool isOfTracks =
        m_workbench->layers().layer() == OutputLayer::Presence && !m_workbench->layers().isOverlay();
    const QString detector = isOfTracks
                                 ? QStringLiteral("presence")
                                 : QString::fromLatin1(detectorNames[m_document.settings().detector.index()].data());
    // If the first view is a map, input and output are maps, too.
    const bool isMap = bench().firstViewName() == QLatin1String("map")
                       && (name == QLatin1String("input") || name == QLatin1String("output"));
    m_equation->toggle(equationOf(isMap ? QStringLiteral("map") : name, detector), m_lessons->widgetNamed(name));
}

void MainWindow::showPalette()
{
    m_commands->refresh();
    m_settingsMenu->clear();
    QList<QAction *> commands = menuBar()->actions();
    if (m_pages->currentWidget() != m_welcome) {
        listSettings(*m_settingsMenu, *panel<PipelinePanel>().form(), [this] { show(panel<PipelinePanel>()); });
        commands << m_settingsMenu->menuAction();
    }
    m_palette->open(commands);
}

void MainWindow::about()
{
    QMessageBox::about(this, tr("About Faintline"),
                       tr("<b>Faintline %1</b><p>Track-before-detect for faint lines that drift and wander.</p>"
                          "<p>Free software under the GNU General Public License, version 3 or later.</p>"
                          "<p>Based in part on the work of the Qwt project (http://qwt.sf.net).</p>")
                           .arg(QStringLiteral(FAINTLINE_VERSION)));
}

} // namespace faintline

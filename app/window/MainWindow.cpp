#include "app/window/MainWindow.h"

#include "app/base/MessageBar.h"
#include "app/base/distinctLabels.h"
#include "app/base/filePath.h"
#include "app/base/statisticUnit.h"
#include "app/control/BoxAnalysis.h"
#include "app/control/EventReviews.h"
#include "app/control/OutputLayers.h"
#include "app/control/ThresholdCurves.h"
#include "app/control/hint.h"
#include "app/control/scanScenario.h"
#include "app/document/OwnPresets.h"
#include "app/document/Recovery.h"
#include "app/document/SessionSaver.h"
#include "app/help/EquationSheet.h"
#include "app/help/KeysOverlay.h"
#include "app/lessons/Lesson.h"
#include "app/lessons/LessonGuide.h"
#include "app/panels/ComparePanel.h"
#include "app/panels/EvaluatePanel.h"
#include "app/panels/ExperimentsPanel.h"
#include "app/panels/HandLinePanel.h"
#include "app/panels/InfoPanel.h"
#include "app/panels/InjectDialog.h"
#include "app/panels/LatencyPanel.h"
#include "app/panels/LearnMotionDialog.h"
#include "app/panels/NoiseFitPanel.h"
#include "app/panels/OpenOptionsDialog.h"
#include "app/panels/PipelinePanel.h"
#include "app/panels/ReproductionPanel.h"
#include "app/panels/SequentialPanel.h"
#include "app/panels/SpectrumPanel.h"
#include "app/panels/StateSlicePanel.h"
#include "app/panels/SurveyPanel.h"
#include "app/panels/SweepPanel.h"
#include "app/panels/ThresholdPanel.h"
#include "app/panels/TrialViewer.h"
#include "app/panels/WhyPanel.h"
#include "app/views/ReportWriter.h"
#include "app/views/WindowViews.h"
#include "app/welcome/ScenarioCard.h"
#include "app/welcome/WelcomePage.h"
#include "app/window/ActivityBar.h"
#include "app/window/CommandPalette.h"
#include "app/window/Panels.h"
#include "app/window/currentView.h"
#include "app/workspace/PingBench.h"
#include "app/workspace/Workbench.h"
#include "spectrum/NoiseNormaliser.h"
#include "widgets/base/ReadOut.h"
#include "widgets/base/labelText.h"
#include "widgets/events/EventTable.h"
#include "widgets/pings/PingMap.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/waterfall/OverviewStrip.h"

#include <QCloseEvent>
#include <QDateTime>
#include <QDir>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolBar>
#include <QUrl>
#include <QVBoxLayout>

namespace faintline {

namespace {

    ExceedancePlot::Unit unitOf(DecideSettings::By by)
    {
        switch (by) {
        case DecideSettings::By::Nats:
            return ExceedancePlot::Unit::Nats;
        case DecideSettings::By::PfaPerCell:
            return ExceedancePlot::Unit::PfaPerCell;
        case DecideSettings::By::FalseAlarmsPerHour:
            break;
        }
        return ExceedancePlot::Unit::FalseAlarmsPerHour;
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
    buildDocks();
    buildBottom();
    buildStatusBar();
    m_lessons = new LessonGuide(*this, *this);
    buildMenus();
    buildToolBar();
    connectDocument();
    connectController();
    connectViews();
    connectSurvey();
    connectEvaluation();
    m_keys = new KeysOverlay(this);
    m_equation = new EquationSheet(this);
    m_palette = new CommandPalette(this);
    resize(1440, 900);
    m_panels->rememberDefault();
    restoreLayout();
    showWelcome();
    showHint();
    showTitle();
}

MainWindow::~MainWindow()
{
    m_controller.disconnect(this); // what is still running ends after the widgets are gone
    m_document.disconnect(this);
    m_comparer.disconnect();
    m_check.disconnect();
    m_experiments.disconnect();
    m_sequentialTests.disconnect();
    for (QDockWidget *dock : findChildren<QDockWidget *>()) // which outlive the document, and then are hidden
        disconnect(dock, &QDockWidget::visibilityChanged, nullptr, nullptr);
    m_trials.reset();
}

// ---- building -------------------------------------------------------------------------------------------------------

void MainWindow::buildCentre()
{
    m_messages = new MessageBar;
    m_welcome = new WelcomePage;
    m_workbench = new Workbench(m_document);
    m_pages = new QStackedWidget;
    m_pages->addWidget(m_welcome);
    m_pages->addWidget(m_workbench);
    m_pings = new PingBench(m_document, m_workbench->layers());
    m_pages->addWidget(m_pings);
    // What is not seen must not keep a small window from showing what is.
    const auto measureCurrent = [this](int current) {
        for (int i = 0; i < m_pages->count(); ++i) {
            const auto policy = i == current ? QSizePolicy::Expanding : QSizePolicy::Ignored;
            m_pages->widget(i)->setSizePolicy(policy, policy);
        }
    };
    connect(m_pages, &QStackedWidget::currentChanged, this, measureCurrent);
    measureCurrent(m_pages->currentIndex());

    auto *centre = new QWidget;
    auto *layout = new QVBoxLayout(centre);
    layout->setSizeConstraint(QLayout::SetMaximumSize); // while the pages are hidden, a panel gets their room
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_messages);
    layout->addWidget(m_pages, 1);
    setCentralWidget(centre);
}

void MainWindow::buildDocks()
{
    m_ownPresets = new OwnPresets(m_memory.presetFolder(), this);
    m_pipeline = new PipelinePanel(m_document, m_controller, *m_ownPresets);
    m_threshold = new ExceedancePlot;
    m_threshold->setObjectName(QStringLiteral("threshold"));
    m_threshold->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    new ThresholdCurves(m_document, *m_threshold, this);
    m_events = new EventTable;
    m_events->setEmptySentence(tr("No event at this threshold."));
    m_reviews = new EventReviews(
        m_document, *m_events,
        {m_workbench->input(), m_workbench->output(), m_pings->rangeHistory(), m_pings->bearingHistory()}, this);
    m_reviews->addMaps({m_pings->input(), m_pings->output()});
    m_boxAnalysis = new BoxAnalysis(m_document, m_controller, {m_workbench->input(), m_workbench->output()}, this);
    m_why = new WhyPanel(m_document, m_pings->viewports());
    m_info = new InfoPanel(m_document, m_controller, m_check);
    m_noiseFit = new NoiseFitPanel(m_document);
    m_states = new StateSlicePanel(m_document, m_pings->viewports());
    m_latency = new LatencyPanel(m_document);
    m_handLine = new HandLinePanel(m_document, *m_workbench);
    m_compare = new ComparePanel(m_document, m_controller, m_comparer);
    m_spectrum = new SpectrumPanel(m_document);
    m_evaluate = new EvaluatePanel(m_document, m_experiments);
    m_sweep = new SweepPanel(m_document, m_experiments);
    m_experimentList = new ExperimentsPanel(m_experiments);
    m_reproduction = new ReproductionPanel;
    m_survey = new SurveyPanel(m_document, m_controller);
    m_sequential = new SequentialPanel(m_document, m_sequentialTests);

    using Place = Panels::Place;
    m_panels->add(QStringLiteral("pipelineDock"), tr("Pipeline"), m_pipeline, Place::Left);
    // The threshold above the events it decides about: one sees both while dragging.
    m_panels->add(QStringLiteral("thresholdDock"), tr("Threshold"),
                  new ThresholdPanel(*m_threshold, m_controller, m_check), Place::RightTop);
    m_panels->add(QStringLiteral("eventsDock"), tr("Events"), m_events, Place::RightBottom);
    m_panels->add(QStringLiteral("whyDock"), tr("Why"), m_why, Place::RightBottom);
    m_panels->add(QStringLiteral("noiseDock"), tr("Noise"), m_info, Place::RightBottom);
    m_panels->add(QStringLiteral("noiseFitDock"), tr("Noise fit"), m_noiseFit, Place::RightBottom);
    m_panels->add(QStringLiteral("statesDock"), tr("States"), m_states, Place::RightBottom);
    m_panels->add(QStringLiteral("handDock"), tr("By hand"), m_handLine, Place::RightBottom);
    m_handLine->parentWidget()->hide(); // until it is asked for
    m_panels->add(QStringLiteral("evaluateDock"), tr("Pd and ROC"), m_evaluate, Place::Bottom);
    m_panels->add(QStringLiteral("spectrumDock"), tr("Spectrum"), m_spectrum, Place::Bottom);
    m_panels->add(QStringLiteral("compareDock"), tr("Compare"), m_compare, Place::Bottom);
    m_panels->add(QStringLiteral("sweepDock"), tr("Sweep"), m_sweep, Place::Bottom);
    m_panels->add(QStringLiteral("surveyDock"), tr("Survey"), m_survey, Place::Bottom);
    m_panels->add(QStringLiteral("experimentsDock"), tr("Experiments"), m_experimentList, Place::Bottom);
    m_panels->add(QStringLiteral("reproductionDock"), tr("Reproduction"), m_reproduction, Place::Bottom);
    m_panels->add(QStringLiteral("sequentialDock"), tr("Sequential test"), m_sequential, Place::Bottom);
    m_panels->add(QStringLiteral("latencyDock"), tr("Latency"), m_latency, Place::Bottom);
}

void MainWindow::buildBottom()
{
    const auto addBar = [this](const QString &name, const QString &title, QWidget *widget) {
        auto *bar = new QToolBar(title);
        bar->setObjectName(name);
        bar->setMovable(false);
        bar->setFloatable(false);
        bar->addWidget(widget);
        widget->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        addToolBar(Qt::BottomToolBarArea, bar);
        m_bottomBars.push_back(bar);
    };
    m_overview = new OverviewStrip;
    m_overview->setViewport(&m_document.viewport());
    m_readOut = new ReadOut;
    addBar(QStringLiteral("readOutBar"), tr("Read-out"), m_readOut); // the first one is the lowest
    addToolBarBreak(Qt::BottomToolBarArea);
    addBar(QStringLiteral("overviewBar"), tr("Overview"), m_overview);
}

void MainWindow::buildStatusBar()
{
    m_hint = new QLabel;
    m_hint->setTextFormat(Qt::PlainText);
    m_hint->setContentsMargins(8, 0, 0, 0);
    m_hint->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_activity = new ActivityBar;
    statusBar()->setSizeGripEnabled(false);
    statusBar()->addWidget(m_hint, 1);
    statusBar()->addPermanentWidget(m_activity);
}

// ---- what is open ---------------------------------------------------------------------------------------------------

void MainWindow::open(const QString &path, const OpenOptions &options, const AnalysisController::Adjust &adjust)
{
    if (SurveyPanel::isSurvey(path))
        return openSurvey(path);
    if (const bool isOfScans = isScanScenario(path); isOfScans || isLesson(path)) {
        try {
            return isOfScans ? openScans(readScanTest(path)) : startLesson(readLesson(path));
        } catch (const Error &error) {
            return showError(error);
        }
    }
    const auto next = [this, path, options, adjust] { openNow(path, options, adjust); };
    if (m_saver->mayLose(tr("opening something else"), next))
        next();
}

void MainWindow::startLesson(const Lesson &lesson)
{
    const auto next = [this, lesson] { m_lessons->start(lesson); };
    if (m_saver->mayLose(tr("starting the lesson"), next))
        next();
}

void MainWindow::openNow(const QString &path, const OpenOptions &options, const AnalysisController::Adjust &adjust)
{
    OpenOptions chosen = options;
    if (m_isAsking && needsRawOptions(path, options)) {
        OpenOptionsDialog dialog(path, this);
        if (dialog.exec() != QDialog::Accepted)
            return;
        chosen = dialog.options();
    }
    m_welcome->stop();
    if (!isVisible()) {
        for (Bench *one : std::initializer_list<Bench *>{m_workbench, m_pings})
            one->setEmptySentence(tr("Reading %1 …").arg(fileLabel(path)));
        showWorkbench();
    }
    m_controller.open(path, chosen, adjust);
}

void MainWindow::offerRecovery()
{
    const QStringList left = Recovery::leftBehind(m_recoveryFolder);
    if (left.isEmpty())
        return;
    const QString when = QFileInfo(left.first()).lastModified().toString(QStringLiteral("yyyy-MM-dd hh:mm"));
    m_messages->showMessage(MessageBar::Kind::Notice, tr("Unsaved work"),
                            tr("of %1 can be restored; the program ended unexpectedly.").arg(when), tr("Restore"),
                            [this, session = left.first()] {
                                m_welcome->stop();
                                // What was left behind goes when it is kept again.
                                connect(
                                    m_recovery, &Recovery::kept, this, [session] { Recovery::discard(session); },
                                    Qt::SingleShotConnection);
                                m_controller.recover(session);
                            });
}

void MainWindow::openScenario(ScenarioCard *card)
{
    if (!card->analysis())
        return open(card->scenario().path);
    const auto next = [this, card] {
        m_welcome->stop();
        m_controller.adopt(card->opened(), card->analysis());
    };
    if (m_saver->mayLose(tr("opening something else"), next))
        next();
}

void MainWindow::openScans(const ScanTest &test)
{
    m_welcome->stop();
    m_messages->dismiss();
    if (m_document.isEmpty()) {
        m_pages->hide(); // the panel gets its room
        m_presentAction->setEnabled(true);
        setWindowTitle(tr("Radar scans — Faintline"));
        m_hint->setText(tr("Click a walk to follow that test. J and L step through its stages."));
    }
    m_panels->show(m_sequential);
    m_sequential->start(test);
}

void MainWindow::openSurvey(const QString &path)
{
    try {
        m_survey->open(path);
    } catch (const Error &error) {
        return showError(error);
    }
    m_welcome->stop();
    m_messages->dismiss();
    if (m_document.isEmpty()) {
        m_pages->hide(); // the panel gets its room
        setWindowTitle(tr("Survey — Faintline"));
        m_hint->setText(tr("Double-click an event to open its recording there."));
    }
    m_panels->show(m_survey);
}

void MainWindow::chooseFile()
{
    const QString folder = m_memory.recent().isEmpty() ? QString() : QFileInfo(m_memory.recent().first()).path();
    const QString path =
        pathOf(QFileDialog::getOpenFileUrl(this, tr("Open"), QUrl::fromLocalFile(folder), openFilter()));
    if (!path.isEmpty())
        open(path);
}

void MainWindow::chooseRawFile()
{
    const QString path = pathOf(QFileDialog::getOpenFileUrl(this, tr("Open as raw samples")));
    if (path.isEmpty())
        return;
    OpenOptionsDialog dialog(path, this);
    if (dialog.exec() == QDialog::Accepted)
        open(path, dialog.options());
}

void MainWindow::openDropped(const QStringList &files)
{
    m_files.setFiles({});
    if (files.size() > 1) {
        QStringList absolute;
        for (const QString &file : files)
            absolute << absolutePath(file);
        m_files.setFiles(absolute);
        connect(
            &m_document, &Document::opened, this,
            [this, count = files.size()] {
                m_messages->showMessage(MessageBar::Kind::Notice, tr("%1 files").arg(count),
                                        tr("The first of them is shown. Ctrl+Page Down goes to the next."));
            },
            static_cast<Qt::ConnectionType>(Qt::QueuedConnection | Qt::SingleShotConnection));
    }
    open(files.front());
}

void MainWindow::goToFile(int by)
{
    const QString path = m_files.neighbour(m_document.source().path, by);
    if (path.isEmpty()) {
        m_messages->showMessage(MessageBar::Kind::Notice, m_document.source().name(),
                                by > 0 ? tr("This is the last recording of its folder.")
                                       : tr("This is the first recording of its folder."));
        return;
    }
    const auto next = [this, path] {
        AnalysisSettings settings = m_document.settings();
        settings.selection.fromSeconds = settings.selection.toSeconds =
            0.0; // a part of one recording is none of another
        openNow(path, m_document.source().options, [settings](AnalysisSettings &opened) { opened = settings; });
    };
    // The settings go along: only what was said about events could be lost.
    if (m_document.annotations().isEmpty() || m_saver->mayLose(tr("opening something else"), next))
        next();
}

void MainWindow::showWritten(const QString &path)
{
    m_messages->showMessage(MessageBar::Kind::Notice, tr("Written"),
                            labelText(pathBytes(absolutePath(path)), longestPath));
}

void MainWindow::offerIq()
{
    const OpenOptions options = m_document.source().options;
    if (!m_document.recording())
        return m_iqAction->setVisible(false);
    const RecordingInfo &info = m_document.recording()->info();
    const bool isPossible = !m_document.source().scene && !info.isComplex && info.channelCount % 2 == 0;
    m_iqAction->setVisible(isPossible || options.iq);
    if (isPossible && info.channelCount == 2)
        m_messages->showMessage(MessageBar::Kind::Notice, m_document.source().name(),
                                tr("Two channels; showing the first. Treat them as I/Q?"), tr("Treat as I/Q"),
                                [this] { m_iqAction->trigger(); });
}

void MainWindow::showWelcome()
{
    m_lessons->leave();
    saveLayout();
    m_presentAction->setChecked(false);
    m_pages->show();
    m_pages->setCurrentWidget(m_welcome);
    m_panels->hide();
    for (QToolBar *bar : m_bottomBars)
        bar->hide();
    for (QAction *action : m_viewActions)
        action->setEnabled(false);
    m_panelsMenu->setEnabled(false);
    m_welcome->setRecent(m_memory.recent());
    m_welcome->start();
}

void MainWindow::showWorkbench()
{
    m_pages->show();
    if (m_pages->currentWidget() == &bench())
        return;
    m_welcome->stop();
    m_pages->setCurrentWidget(&bench());
    if (const QByteArray panels = m_memory.layout().panels; panels.isEmpty() || !restoreState(panels))
        m_panels->takeDefault();
    for (QToolBar *bar : m_bottomBars)
        bar->setVisible(!bench().hasReadOut());
    for (QAction *action : m_viewActions)
        action->setEnabled(true);
    m_panelsMenu->setEnabled(true);
    bench().firstView()->setFocus();
}

void MainWindow::showAnalysis()
{
    const Analysis &analysis = *m_document.analysis();
    const Axis &frequency = analysis.grid().axes.front(); // of pings: the range
    m_readOut->setResolution(analysis.time().step, frequency.step);
    const QString unit = statisticUnit(analysis.settings);
    m_threshold->setStatisticUnit(unit);
    m_readOut->setStatisticUnit(unit);
    m_events->setStatisticUnit(unit);
    m_threshold->setCalibration(analysis.calibration, analysis.cellFramesPerHour);
    m_threshold->setHistogram(analysis.statisticCounts);
    m_threshold->setUnit(unitOf(analysis.settings.decide.by));
    m_events->setAxes(analysis.grid().axes);
    const RecordingInfo info = m_document.recording() ? m_document.recording()->info() : RecordingInfo();
    m_events->setOrigin(info.startUnixSeconds, info.centreHz);
    m_overview->setPicture(analysis.inputAlong.front(), frequency);
    showWorkbench();
}

void MainWindow::showEvents()
{
    const std::vector<Event> events = m_document.shownEvents();
    m_events->setEvents(events);
    m_overview->setEvents(eventsAlong(events, 0));
    showHint();
}

void MainWindow::showHint()
{
    m_hint->setText(hint(m_document, m_controller.isBusy(), bench().hint()));
}

void MainWindow::showTitle()
{
    const QString path = m_document.sessionPath().isEmpty() ? m_document.source().path : m_document.sessionPath();
    const QString name =
        path.isEmpty() ? m_document.source().name() : distinctLabel(absolutePath(path), m_memory.recent());
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
    // Opened, but it could not be analysed: whoever changes the settings needs the form.
    bench().setEmptySentence(tr("No analysis with these settings."));
    m_threshold->setCalibration({}, 0.0);
    m_events->setEvents({});
    showWorkbench();
}

void MainWindow::closeEvent(QCloseEvent *event)
{
    if (!m_saver->mayLose(tr("closing"), [this] { close(); }))
        return event->ignore();
    m_lessons->leave();
    saveLayout();
    m_welcome->stop();
    m_controller.stop();
    event->accept();
}

void MainWindow::fillRecentMenu()
{
    m_recentMenu->clear();
    for (const QString &path : m_memory.recent())
        m_recentMenu->addAction(buttonText(distinctLabel(path, m_memory.recent())), this, [this, path] { open(path); })
            ->setToolTip(asHtml(labelText(pathBytes(path), longestPath)));
    if (m_recentMenu->isEmpty())
        m_recentMenu->addAction(tr("No recent files"))->setEnabled(false);
}

void MainWindow::saveLayout()
{
    if (m_pages->currentWidget() == m_welcome || m_presentAction->isChecked())
        return;
    const ViewState view = m_workbench->viewState();
    WindowMemory::Layout layout = m_memory.layout(); // of the bench that is not seen as it was
    (&bench() == m_pings ? layout.pingSplitters : layout.splitters) = bench().saveSplitters();
    layout.geometry = saveGeometry();
    layout.panels = saveState();
    layout.colourMap = view.colourMap;
    layout.orientation = view.orientation;
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
    m_workbench->restore({{}, {}, layout.orientation, layout.colourMap});
}

void MainWindow::setAsking(bool isAsking)
{
    m_isAsking = isAsking;
    m_saver->setAsking(isAsking);
}

// ---- the rest -------------------------------------------------------------------------------------------------------

void MainWindow::exportReport()
{
    const QString path = QFileDialog::getSaveFileName(this, tr("Export report"),
                                                      nameBeside(m_document.source().path, QStringLiteral(".html")),
                                                      tr("Report (*.html)"));
    if (!path.isEmpty())
        m_report->write(path);
}

void MainWindow::injectLine()
{
    const auto &analysis = m_document.analysis();
    const Spectrogram *spectrogram = analysis ? analysis->frames->spectrogram() : nullptr;
    if (!spectrogram)
        return;
    const RecordingInfo &info = m_document.recording()->info();
    const Viewport &viewport = m_document.viewport();
    const Viewport::Point at =
        viewport.cursor().value_or(Viewport::Point{viewport.full().time.middle(), viewport.full().frequency.middle()});
    InjectDialog dialog(info, at.seconds, at.hz, spectrogram->windowSeconds(), this);
    if (dialog.exec() == QDialog::Accepted)
        m_controller.inject(dialog.line());
}

void MainWindow::learnMotion()
{
    if (!m_document.analysis())
        return;
    auto *dialog = new LearnMotionDialog(m_document.analysis(), m_controller, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void MainWindow::reproduce(const Reproducible &reproducible, bool quick)
{
    ReproduceOptions options;
    options.quick = quick;
    showWorkbench();
    m_panels->show(m_experimentList);
    m_experiments.start(reproducible, options);
}

void MainWindow::showExperiment(int id)
{
    const Experiments::Entry *entry = m_experiments.entry(id);
    if (!entry)
        return;
    if (entry->reproduction) {
        m_reproduction->show(entry->reproduction);
        return m_panels->show(m_reproduction);
    }
    if (entry->reproducible)
        return;
    if (entry->campaign && std::holds_alternative<SweepExperiment>(entry->campaign->experiment)) {
        m_sweep->show(id);
        return m_panels->show(m_sweep);
    }
    m_evaluate->show(id);
    m_panels->show(m_evaluate);
}

void MainWindow::showWhy()
{
    m_panels->show(m_why);
}

void MainWindow::showNoiseFit()
{
    m_panels->show(m_noiseFit);
}

void MainWindow::showStates()
{
    m_panels->show(m_states);
}

void MainWindow::showLatency()
{
    m_panels->show(m_latency);
}

void MainWindow::showHandLine()
{
    m_panels->show(m_handLine);
}

void MainWindow::showSweep()
{
    m_panels->show(m_sweep);
}

void MainWindow::showSpectrum()
{
    m_panels->show(m_spectrum);
}

void MainWindow::showCompare()
{
    m_panels->show(m_compare);
}

void MainWindow::setTheme(Theme::Kind kind)
{
    Theme::apply(kind);
    m_memory.setTheme(kind);
}

void MainWindow::showEquation()
{
    const QString name = currentView(*this, *this);
    const QString detector = QString::fromLatin1(detectorNames[m_document.settings().detector.index()].data());
    // Where the first view is a map, input and output are maps, too.
    const bool isMap = bench().firstViewName() == QLatin1String("map")
                       && (name == QLatin1String("input") || name == QLatin1String("output"));
    m_equation->toggle(equationOf(isMap ? QStringLiteral("map") : name, detector), m_lessons->widgetNamed(name));
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

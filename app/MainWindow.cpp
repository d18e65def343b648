#include "app/MainWindow.h"

#include "app/ActivityBar.h"
#include "app/EvaluatePanel.h"
#include "app/ExperimentForm.h"
#include "app/ExperimentsPanel.h"
#include "app/FileDrop.h"
#include "app/InfoPanel.h"
#include "app/InjectDialog.h"
#include "app/KeysOverlay.h"
#include "app/MessageBar.h"
#include "app/NoiseFitPanel.h"
#include "app/OpenOptionsDialog.h"
#include "app/PipelinePanel.h"
#include "app/ReproductionPanel.h"
#include "app/ScenarioCard.h"
#include "app/SessionSaver.h"
#include "app/TrialViewer.h"
#include "app/TrialWindow.h"
#include "app/WelcomePage.h"
#include "app/Workbench.h"
#include "app/hint.h"
#include "app/statisticUnit.h"
#include "spectrum/NoiseNormaliser.h"
#include "widgets/ChartPlot.h"
#include "widgets/EventTable.h"
#include "widgets/ExceedancePlot.h"
#include "widgets/OverviewStrip.h"
#include "widgets/ReadOut.h"

#include <QActionGroup>
#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>

#include <array>

namespace faintline {

namespace {

    DecideSettings::By decideBy(ExceedancePlot::Unit unit)
    {
        switch (unit) {
        case ExceedancePlot::Unit::Nats:
            return DecideSettings::By::Nats;
        case ExceedancePlot::Unit::PfaPerCell:
            return DecideSettings::By::PfaPerCell;
        case ExceedancePlot::Unit::FalseAlarmsPerHour:
            break;
        }
        return DecideSettings::By::FalseAlarmsPerHour;
    }

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

MainWindow::MainWindow(std::unique_ptr<QSettings> memory, QWidget *parent)
    : QMainWindow(parent), m_controller(m_document), m_memory(std::move(memory))
{
    setObjectName(QStringLiteral("MainWindow"));
    setAnimated(false);
    setDockNestingEnabled(true);
    buildCentre();
    buildDocks();
    buildBottom();
    buildStatusBar();
    buildMenus();
    buildToolBar();
    connectDocument();
    connectController();
    connectViews();
    connectEvaluation();
    m_keys = new KeysOverlay(this);
    resize(1440, 900);
    m_defaultLayout = saveState();
    restoreLayout();
    showWelcome();
    showHint();
    showTitle();
}

MainWindow::~MainWindow()
{
    m_controller.disconnect(this); // what is still running ends after the widgets are gone
    m_document.disconnect(this);
    m_experiments.disconnect();
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

    auto *centre = new QWidget;
    auto *layout = new QVBoxLayout(centre);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_messages);
    layout->addWidget(m_pages, 1);
    setCentralWidget(centre);
}

QDockWidget *MainWindow::addDock(const QString &name, const QString &title, QWidget *widget, Qt::DockWidgetArea area)
{
    auto *dock = new QDockWidget(title);
    dock->setObjectName(name);
    dock->setWidget(widget);
    addDockWidget(area, dock);
    m_docks.push_back(dock);
    return dock;
}

void MainWindow::buildDocks()
{
    setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);

    m_pipeline = new PipelinePanel(m_document, m_controller);
    m_threshold = new ExceedancePlot;
    m_events = new EventTable;
    m_info = new InfoPanel(m_document);
    m_threshold->setObjectName(QStringLiteral("threshold"));
    m_threshold->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    m_events->setEmptySentence(tr("No event at this threshold."));

    QDockWidget *pipeline = addDock(QStringLiteral("pipelineDock"), tr("Pipeline"), m_pipeline, Qt::LeftDockWidgetArea);
    QDockWidget *threshold =
        addDock(QStringLiteral("thresholdDock"), tr("Threshold"), m_threshold, Qt::RightDockWidgetArea);
    QDockWidget *events =
        addDock(QStringLiteral("eventsDock"), tr("Events · tracks"), m_events, Qt::RightDockWidgetArea);
    QDockWidget *noise =
        addDock(QStringLiteral("noiseDock"), tr("Noise · calibration"), m_info, Qt::RightDockWidgetArea);
    // The threshold above the events it decides about: one sees both while dragging.
    splitDockWidget(threshold, events, Qt::Vertical);
    tabifyDockWidget(events, noise);
    events->raise();
    resizeDocks({pipeline, threshold}, {270, 380}, Qt::Horizontal);
    resizeDocks({threshold, events}, {400, 400}, Qt::Vertical);
    m_noiseFit = new NoiseFitPanel(m_document);
    tabifyDockWidget(noise, addDock(QStringLiteral("noiseFitDock"), tr("Noise fit"), m_noiseFit, Qt::RightDockWidgetArea));
    events->raise();
    buildEvaluationDocks();
}

/// At the bottom, out of sight until they are asked for: the pictures need the room.
void MainWindow::buildEvaluationDocks()
{
    m_evaluate = new EvaluatePanel(m_document, m_experiments);
    m_experimentList = new ExperimentsPanel(m_experiments);
    m_reproduction = new ReproductionPanel;
    QDockWidget *evaluate = addDock(QStringLiteral("evaluateDock"), tr("Pd and ROC"), m_evaluate, Qt::BottomDockWidgetArea);
    QDockWidget *list = addDock(QStringLiteral("experimentsDock"), tr("Experiments"), m_experimentList, Qt::BottomDockWidgetArea);
    QDockWidget *reproduction = addDock(QStringLiteral("reproductionDock"), tr("Reproduction"), m_reproduction, Qt::BottomDockWidgetArea);
    tabifyDockWidget(evaluate, list);
    tabifyDockWidget(list, reproduction);
    for (QDockWidget *dock : {evaluate, list, reproduction})
        dock->hide();
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

// ---- menus ----------------------------------------------------------------------------------------------------------

void MainWindow::buildMenus()
{
    buildFileMenu();
    buildEditMenu();
    buildViewMenu();
    buildDetectMenu();
    buildEvaluateMenu();
    buildReproduceMenu();
    buildHelpMenu();
    // A hidden menu's shortcuts do nothing; the window's do, and a presentation has no menu.
    for (const QAction *menu : menuBar()->actions())
        for (QAction *action : menu->menu()->actions())
            if (action != m_playAction)
                addAction(action);
}

void MainWindow::buildFileMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("&File"));
    menu->addAction(tr("&Open…"), QKeySequence::Open, this, &MainWindow::chooseFile);
    menu->addAction(tr("Open as &raw samples…"), this, &MainWindow::chooseRawFile);
    m_recentMenu = menu->addMenu(tr("Open re&cent"));
    connect(m_recentMenu, &QMenu::aboutToShow, this, &MainWindow::fillRecentMenu);
    menu->addAction(tr("&Welcome page"), this, &MainWindow::showWelcome);
    menu->addSeparator();
    m_iqAction = addViewAction(*menu, tr("Take channels as &I and Q"), {}, [this] {
        OpenOptions options = m_document.source().options;
        options.iq = m_iqAction->isChecked();
        m_controller.reopen(options);
    });
    m_iqAction->setCheckable(true);
    menu->addSeparator();
    addViewAction(*menu, tr("&Save session"), QKeySequence::Save, [this] { m_saver->save(); });
    addViewAction(*menu, tr("Save session &as…"), QKeySequence::SaveAs, [this] { m_saver->saveAs(); });
    menu->addSeparator();
    menu->addAction(tr("&Quit"), QKeySequence(Qt::CTRL | Qt::Key_Q), this, &QWidget::close);
}

void MainWindow::buildEditMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("&Edit"));
    QAction *undo = m_document.undoStack().createUndoAction(this, tr("&Undo"));
    QAction *redo = m_document.undoStack().createRedoAction(this, tr("&Redo"));
    undo->setShortcut(QKeySequence::Undo);
    redo->setShortcuts({QKeySequence(Qt::CTRL | Qt::Key_Y), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_Z)});
    menu->addActions({undo, redo});
    menu->addSeparator();
    addViewAction(*menu, tr("Reset all &settings"), {},
                  [this] { m_controller.setSettings({}, tr("Reset all settings")); });
}

void MainWindow::buildViewMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("&View"));
    WaterfallView *input = m_workbench->input();
    WaterfallView *output = m_workbench->output();
    Viewport *viewport = &m_document.viewport();
    addViewAction(*menu, tr("Show &all"), Qt::Key_0, [viewport] { viewport->showAll(); });
    addViewAction(*menu, tr("Zoom &back"), Qt::Key_Backspace, [viewport] { viewport->zoomBack(); });
    menu->addSeparator();
    addViewAction(*menu, tr("Next &orientation"), Qt::Key_O, [output] { output->cycleOrientation(); });
    addViewAction(*menu, tr("Next &colour map"), Qt::Key_C, [output] { output->cycleColourMap(); });
    addViewAction(*menu, tr("A&utomatic range"), Qt::Key_A, [input, output] {
        input->setAutomaticRange();
        output->setAutomaticRange();
    });
    menu->addSeparator();
    addViewAction(*menu, tr("&Measure a box"), Qt::Key_M, [output] { output->setMeasuring(!output->isMeasuring()); });
    QAction *harmonics = addViewAction(*menu, tr("&Harmonics"), Qt::Key_H, {});
    harmonics->setCheckable(true);
    connect(harmonics, &QAction::toggled, input, &WaterfallView::setHarmonics);
    connect(harmonics, &QAction::toggled, output, &WaterfallView::setHarmonics);
    menu->addSeparator();
    QMenu *picture = menu->addMenu(tr("P&icture"));
    connect(picture, &QMenu::aboutToShow, this, [picture, output] {
        picture->clear();
        output->addActionsTo(picture);
    });
    m_panelsMenu = menu->addMenu(tr("&Panels"));
    for (QDockWidget *dock : m_docks)
        m_panelsMenu->addAction(dock->toggleViewAction());
    m_panelsMenu->addSeparator();
    m_panelsMenu->addAction(tr("&Default layout"), this, &MainWindow::takeDefaultLayout);
    m_presentAction = addViewAction(*menu, tr("&Presentation"), Qt::Key_F5, {});
    m_presentAction->setCheckable(true);
    connect(m_presentAction, &QAction::toggled, this, &MainWindow::setPresenting);
    m_darkAction = menu->addAction(tr("&Dark"));
    m_darkAction->setCheckable(true);
    m_darkAction->setChecked(Theme::kind(palette()) == Theme::Kind::Dark);
    connect(m_darkAction, &QAction::toggled, this,
            [this](bool isDark) { setTheme(isDark ? Theme::Kind::Dark : Theme::Kind::Light); });
}

void MainWindow::buildDetectMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("&Detect"));
    addViewAction(*menu, tr("&Run again"), QKeySequence(Qt::CTRL | Qt::Key_R), [this] { m_controller.run(); });
    m_stopAction = menu->addAction(tr("&Stop"), QKeySequence(Qt::Key_Escape), &m_controller, &AnalysisController::stop);
    m_stopAction->setEnabled(false);
    menu->addSeparator();
    addViewAction(*menu, tr("Threshold &down"), Qt::Key_Comma, [this] { m_controller.stepThreshold(-1); });
    addViewAction(*menu, tr("Threshold &up"), Qt::Key_Period, [this] { m_controller.stepThreshold(1); });
    menu->addSeparator();
    addViewAction(*menu, tr("&Next event"), Qt::Key_N, [this] { m_events->selectNext(); });
    addViewAction(*menu, tr("&Previous event"), QKeySequence(Qt::SHIFT | Qt::Key_N),
                  [this] { m_events->selectPrevious(); });
    menu->addSeparator();
    m_playAction = addViewAction(*menu, tr("P&lay"), Qt::Key_Space, {});
    m_playAction->setCheckable(true);
    connect(m_playAction, &QAction::toggled, m_workbench, &Workbench::setPlaying);
    connect(m_workbench, &Workbench::playingChanged, m_playAction, &QAction::setChecked);
    // Space also presses the button that has the focus: only over the pictures does it play.
    m_playAction->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    m_workbench->addAction(m_playAction);
    addViewAction(*menu, tr("Frame &back"), Qt::Key_J, [this] { m_workbench->stepFrames(-1); });
    addViewAction(*menu, tr("Frame &forward"), Qt::Key_L, [this] { m_workbench->stepFrames(1); });
}

void MainWindow::buildEvaluateMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("E&valuate"));
    addViewAction(*menu, tr("&Pd and ROC"), QKeySequence(Qt::CTRL | Qt::Key_P), [this] { showDock(m_evaluate); });
    addViewAction(*menu, tr("&Experiments"), {}, [this] { showDock(m_experimentList); });
    addViewAction(*menu, tr("&Noise fit"), {}, [this] { showNoiseFit(); });
    menu->addSeparator();
    addViewAction(*menu, tr("&Inject a line…"), QKeySequence(Qt::CTRL | Qt::Key_I), [this] { injectLine(); });
}

void MainWindow::buildReproduceMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("&Reproduce"));
    QAction *quick = menu->addAction(tr("&Quick: a tenth of the trials"));
    quick->setCheckable(true);
    quick->setChecked(true);
    menu->addSeparator();
    for (const Reproducible &entry : reproducibles()) {
        QAction *action = menu->addAction(QString::fromStdString(entry.title));
        action->setData(QString::fromStdString(entry.name));
        connect(action, &QAction::triggered, this, [this, &entry, quick] { reproduce(entry, quick->isChecked()); });
    }
}

void MainWindow::buildHelpMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("&Help"));
    QAction *keys = menu->addAction(tr("&Keys and mouse"), this, [this] { m_keys->toggle(); });
    keys->setShortcuts(
        {QKeySequence(Qt::Key_F1), QKeySequence(Qt::Key_Question), QKeySequence(Qt::SHIFT | Qt::Key_Question)});
    menu->addAction(tr("&About Faintline"), this, &MainWindow::about);
}

QAction *MainWindow::addViewAction(QMenu &menu, const QString &text, const QKeySequence &key,
                                   std::function<void()> action)
{
    QAction *result = menu.addAction(text);
    result->setShortcut(key);
    if (action)
        connect(result, &QAction::triggered, this, action);
    m_viewActions.push_back(result);
    return result;
}

void MainWindow::buildToolBar()
{
    QToolBar *bar = addToolBar(tr("Tools"));
    bar->setObjectName(QStringLiteral("toolBar"));
    bar->setMovable(false);
    bar->setToolButtonStyle(Qt::ToolButtonTextOnly);
    bar->addAction(tr("Open…"), this, &MainWindow::chooseFile)
        ->setToolTip(tr("Open a recording, a scenario or a session (Ctrl+O)"));

    auto *scenarioMenu = new QMenu(this);
    for (ScenarioCard *card : m_welcome->cards())
        scenarioMenu->addAction(card->scenario().title, this, [this, card] { openScenario(card); });
    auto *scenarioButton = new QToolButton;
    scenarioButton->setText(tr("Scenario"));
    scenarioButton->setToolTip(tr("Open a simulated recording"));
    scenarioButton->setMenu(scenarioMenu);
    scenarioButton->setPopupMode(QToolButton::InstantPopup);
    bar->addWidget(scenarioButton);
    bar->addSeparator();

    const auto add = [this, bar](const QString &text, const QString &toolTip, auto action) {
        QAction *result = bar->addAction(text, this, action);
        result->setToolTip(toolTip);
        m_viewActions.push_back(result);
    };
    add(tr("Run"), tr("Run the chain again (Ctrl+R)"), [this] { m_controller.run(); });
    bar->addAction(m_stopAction);
    bar->addSeparator();
    add(tr("Orientation"), tr("Newest on top, oldest on top, left to right (O)"),
        [this] { m_workbench->output()->cycleOrientation(); });
    add(tr("Colours"), tr("Next colour map (C)"), [this] { m_workbench->output()->cycleColourMap(); });
    add(tr("Show all"), tr("The whole recording (0)"), [this] { m_document.viewport().showAll(); });
    bar->addSeparator();
    add(tr("Frame back"), tr("One frame back (J)"), [this] { m_workbench->stepFrames(-1); });
    bar->addAction(m_playAction);
    add(tr("Frame forward"), tr("One frame forward (L)"), [this] { m_workbench->stepFrames(1); });
    add(tr("Next event"), tr("Go to the next event (N)"), [this] { m_events->selectNext(); });
}

// ---- connections ----------------------------------------------------------------------------------------------------

void MainWindow::connectDocument()
{
    connect(&m_document, &Document::opened, this, [this] {
        const RecordingInfo &info = m_document.recording()->info();
        m_messages->dismiss();
        m_readOut->setStartUnixSeconds(info.startUnixSeconds);
        m_iqAction->setChecked(m_document.source().options.iq);
        m_workbench->setPlaying(false);
        const QString path = m_document.sessionPath().isEmpty() ? m_document.source().path : m_document.sessionPath();
        if (!path.startsWith(QLatin1Char(':')))
            m_memory.addRecent(path);
        offerIq();
        showHint();
    });
    connect(&m_document, &Document::analysisChanged, this, &MainWindow::showAnalysis);
    connect(&m_document, &Document::shownThresholdChanged, m_threshold,
            [this] { m_threshold->setThreshold(m_document.shownThreshold()); });
    connect(&m_document, &Document::shownEventsChanged, this, &MainWindow::showEvents);
    connect(&m_document, &Document::sessionChanged, this, &MainWindow::showTitle);
    connect(&m_document, &Document::settingsChanged, m_messages, &MessageBar::dismiss);
}

void MainWindow::connectController()
{
    connect(&m_controller, &AnalysisController::busyChanged, m_activity, &ActivityBar::setBusy);
    connect(&m_controller, &AnalysisController::busyChanged, m_stopAction, &QAction::setEnabled);
    connect(&m_controller, &AnalysisController::progressed, m_activity, &ActivityBar::setProgress);
    connect(m_activity, &ActivityBar::cancelRequested, &m_controller, &AnalysisController::stop);
    connect(&m_controller, &AnalysisController::failed, this, &MainWindow::showFailure);
    connect(&m_controller, &AnalysisController::warned, this, [this](const QString &where, const QString &why) {
        m_messages->showMessage(MessageBar::Kind::Notice, where, why);
    });
    connect(&m_controller, &AnalysisController::viewRestored, m_workbench, &Workbench::restore);
    m_saver = new SessionSaver(
        m_document, [this] { return m_workbench->viewState(); }, this);
    connect(m_saver, &SessionSaver::failed, this, &MainWindow::showError);
    connect(m_saver, &SessionSaver::closable, this, &QWidget::close);
    connect(m_saver, &SessionSaver::saved, this, [this](const QString &path) {
        m_memory.addRecent(path);
        emit saved(path);
    });
}

void MainWindow::connectViews()
{
    connect(m_welcome, &WelcomePage::openRequested, this, &MainWindow::chooseFile);
    connect(m_welcome, &WelcomePage::pathChosen, this, [this](const QString &path) { open(path); });
    connect(m_welcome, &WelcomePage::scenarioChosen, this, &MainWindow::openScenario);
    connect(m_welcome, &WelcomePage::failed, this, &MainWindow::showError);

    const auto goTo = [this](int id) {
        m_workbench->selectEvent(id);
        m_events->setSelectedEvent(id);
    };
    connect(m_workbench, &Workbench::eventActivated, this, goTo);
    connect(m_events, &EventTable::eventActivated, this, goTo);
    connect(m_workbench, &Workbench::thresholdStepRequested, &m_controller, &AnalysisController::stepThreshold);
    connect(m_workbench, &Workbench::readingChanged, m_readOut, &ReadOut::setReading);
    connect(m_workbench->output(), &WaterfallView::colourMapChanged, m_overview,
            [this](const QString &name) { m_overview->setColourMap(ColourMap::named(name)); });

    connect(m_threshold, &ExceedancePlot::thresholdRequested, &m_controller, &AnalysisController::previewThreshold);
    connect(m_threshold, &ExceedancePlot::thresholdCommitted, &m_controller, &AnalysisController::commitThreshold);
    connect(m_threshold, &ExceedancePlot::unitChanged, this,
            [this](ExceedancePlot::Unit unit) { m_controller.setThresholdUnit(decideBy(unit)); });
    connect(new FileDrop(this), &FileDrop::dropped, this, [this](const QString &path) { open(path); });
}

void MainWindow::connectEvaluation()
{
    m_trials = std::make_unique<TrialViewer>(m_experiments, this);
    connect(m_evaluate, &EvaluatePanel::trialRequested, m_trials.get(), &TrialViewer::open);
    connect(m_evaluate, &EvaluatePanel::failed, this, &MainWindow::showError);
    connect(m_trials.get(), &TrialViewer::failed, this, &MainWindow::showError);
    connect(m_trials.get(), &TrialViewer::busyChanged, m_activity, &ActivityBar::setBusy);
    connect(m_trials.get(), &TrialViewer::progressed, m_activity, &ActivityBar::setProgress);
    connect(m_experimentList, &ExperimentsPanel::failed, this, &MainWindow::showError);
    connect(m_experimentList, &ExperimentsPanel::showRequested, this, &MainWindow::showExperiment);
    connect(&m_experiments, &Experiments::changed, this, [this](int id) {
        // A reproduction shows itself when it is done; curves grow where they are.
        if (const Experiments::Entry *entry = m_experiments.entry(id); entry->state == Experiments::State::Done && entry->reproduction)
            showExperiment(id);
    });
}

// ---- what is open ---------------------------------------------------------------------------------------------------

void MainWindow::open(const QString &path, const OpenOptions &options, const AnalysisController::Adjust &adjust)
{
    if (!m_saver->mayDiscard())
        return;
    OpenOptions chosen = options;
    if (m_isAsking && needsRawOptions(path, options)) {
        OpenOptionsDialog dialog(path, this);
        if (dialog.exec() != QDialog::Accepted)
            return;
        chosen = dialog.options();
    }
    m_welcome->stop();
    if (!isVisible()) {
        m_workbench->setEmptySentence(tr("Reading %1 …").arg(QFileInfo(path).fileName()));
        showWorkbench();
    }
    m_controller.open(path, chosen, adjust);
}

void MainWindow::openScenario(ScenarioCard *card)
{
    if (!card->analysis())
        return open(card->scenario().path);
    if (!m_saver->mayDiscard())
        return;
    m_welcome->stop();
    m_controller.adopt(card->opened(), card->analysis());
}

void MainWindow::chooseFile()
{
    const QString folder = m_memory.recent().isEmpty() ? QString() : QFileInfo(m_memory.recent().first()).path();
    const QString path = QFileDialog::getOpenFileName(this, tr("Open"), folder,
                                                      tr("Everything (*);;Sessions (*.faintline);;Scenarios (*.json)"));
    if (!path.isEmpty())
        open(path);
}

void MainWindow::chooseRawFile()
{
    const QString path = QFileDialog::getOpenFileName(this, tr("Open as raw samples"));
    if (path.isEmpty())
        return;
    OpenOptionsDialog dialog(path, this);
    if (dialog.exec() == QDialog::Accepted)
        open(path, dialog.options());
}

void MainWindow::offerIq()
{
    const RecordingInfo &info = m_document.recording()->info();
    const OpenOptions options = m_document.source().options;
    const bool isPossible = !m_document.source().scene && !info.isComplex && info.channelCount % 2 == 0;
    m_iqAction->setVisible(isPossible || options.iq);
    if (isPossible && info.channelCount == 2)
        m_messages->showMessage(MessageBar::Kind::Notice, m_document.source().name(),
                                tr("two channels, of which the first is shown. Are they I and Q of one receiver?"),
                                tr("Take as I and Q"), [this] { m_iqAction->trigger(); });
}

void MainWindow::showWelcome()
{
    saveLayout();
    m_presentAction->setChecked(false);
    m_pages->setCurrentWidget(m_welcome);
    for (QDockWidget *dock : m_docks)
        dock->hide();
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
    if (m_pages->currentWidget() == m_workbench)
        return;
    m_welcome->stop();
    m_pages->setCurrentWidget(m_workbench);
    if (const QByteArray panels = m_memory.layout().panels; panels.isEmpty() || !restoreState(panels))
        takeDefaultLayout();
    for (QToolBar *bar : m_bottomBars)
        bar->show();
    for (QAction *action : m_viewActions)
        action->setEnabled(true);
    m_panelsMenu->setEnabled(true);
    m_workbench->output()->setFocus();
}

void MainWindow::showAnalysis()
{
    const Analysis &analysis = *m_document.analysis();
    const Axis &frequency = analysis.grid().axes.back();
    m_readOut->setResolution(analysis.time().step, frequency.step);
    const QString unit = statisticUnit(analysis.settings);
    m_threshold->setStatisticUnit(unit);
    m_readOut->setStatisticUnit(unit);
    m_events->setStatisticUnit(unit);
    m_threshold->setCalibration(analysis.calibration, analysis.cellFramesPerHour);
    m_threshold->setHistogram(analysis.statisticCounts);
    m_threshold->setUnit(unitOf(analysis.settings.decide.by));
    m_overview->setPicture(analysis.input, frequency);
    showWorkbench();
}

void MainWindow::showEvents()
{
    const std::vector<Event> events = m_document.shownEvents();
    m_events->setEvents(events);
    m_overview->setEvents(events);
    showHint();
}

void MainWindow::showHint()
{
    m_hint->setText(hint(m_document));
}

void MainWindow::showTitle()
{
    const QString path = m_document.sessionPath();
    const QString name = path.isEmpty() ? m_document.source().name() : QFileInfo(path).fileName();
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
    m_workbench->setEmptySentence(tr("No analysis with these settings."));
    m_threshold->setCalibration({}, 0.0);
    m_events->setEvents({});
    showWorkbench();
}

void MainWindow::closeEvent(QCloseEvent *event)
{
    if (!m_saver->mayClose())
        return event->ignore();
    saveLayout();
    m_welcome->stop();
    m_controller.stop();
    event->accept();
}

void MainWindow::fillRecentMenu()
{
    m_recentMenu->clear();
    for (const QString &path : m_memory.recent())
        m_recentMenu->addAction(QFileInfo(path).fileName(), this, [this, path] { open(path); })->setToolTip(path);
    if (m_recentMenu->isEmpty())
        m_recentMenu->addAction(tr("Nothing yet"))->setEnabled(false);
}

void MainWindow::saveLayout()
{
    if (m_pages->currentWidget() != m_workbench || m_presentAction->isChecked())
        return;
    const ViewState view = m_workbench->viewState();
    m_memory.setLayout({saveGeometry(), saveState(), m_workbench->saveSplitters(), view.colourMap, view.orientation});
}

void MainWindow::restoreLayout()
{
    const WindowMemory::Layout layout = m_memory.layout();
    restoreGeometry(layout.geometry);
    if (!layout.splitters.isEmpty())
        m_workbench->restoreSplitters(layout.splitters);
    m_workbench->restore({{}, {}, layout.orientation, layout.colourMap});
}

void MainWindow::setAsking(bool isAsking)
{
    m_isAsking = isAsking;
    m_saver->setAsking(isAsking);
}

// ---- the rest -------------------------------------------------------------------------------------------------------

const QStringList &MainWindow::viewNames()
{
    static const QStringList names{QStringLiteral("window"),    QStringLiteral("input"),  QStringLiteral("output"),
                                   QStringLiteral("threshold"), QStringLiteral("events"), QStringLiteral("noise"),
                                   QStringLiteral("noisefit"),  QStringLiteral("pd")};
    return names;
}

QWidget *MainWindow::view(const QString &name)
{
    const std::array<QWidget *, 8> views{this,     m_workbench->inputPane(), m_workbench->outputPane(), m_threshold,       m_events,
                                         m_info,   m_noiseFit,               m_evaluate};
    const auto index = viewNames().indexOf(name);
    return index < 0 ? nullptr : views[static_cast<std::size_t>(index)];
}

void MainWindow::injectLine()
{
    const auto &analysis = m_document.analysis();
    const auto *frames = analysis ? dynamic_cast<const NormalisedSpectrogram *>(analysis->frames.get()) : nullptr;
    if (!frames)
        return;
    const RecordingInfo &info = m_document.recording()->info();
    const Viewport &viewport = m_document.viewport();
    const Viewport::Point at = viewport.cursor().value_or(Viewport::Point{viewport.full().time.middle(), viewport.full().frequency.middle()});
    const double window = static_cast<double>(frames->spectrogram().windowSamples()) / info.sampleRateHz;
    InjectDialog dialog(info, at.seconds, at.hz, window, this);
    if (dialog.exec() == QDialog::Accepted)
        m_controller.inject(dialog.line());
}

void MainWindow::reproduce(const Reproducible &reproducible, bool quick)
{
    ReproduceOptions options;
    options.quick = quick;
    showWorkbench();
    showDock(m_experimentList);
    m_experiments.start(reproducible, options);
}

void MainWindow::showExperiment(int id)
{
    const Experiments::Entry *entry = m_experiments.entry(id);
    if (!entry)
        return;
    if (entry->reproduction) {
        m_reproduction->show(entry->reproduction);
        return showDock(m_reproduction);
    }
    if (entry->reproducible)
        return;
    m_evaluate->show(id);
    showDock(m_evaluate);
}

void MainWindow::showNoiseFit()
{
    showDock(m_noiseFit);
}

void MainWindow::showDock(QWidget *panel)
{
    auto *dock = static_cast<QDockWidget *>(panel->parentWidget());
    const bool wasHidden = dock->isHidden();
    dock->show();
    dock->raise();
    if (wasHidden && dockWidgetArea(dock) == Qt::BottomDockWidgetArea)
        resizeDocks({dock}, {height() * 36 / 100}, Qt::Vertical);
}

void MainWindow::setTheme(Theme::Kind kind)
{
    Theme::apply(kind);
    m_memory.setTheme(kind);
}

void MainWindow::takeDefaultLayout()
{
    restoreState(m_defaultLayout);
    const int right = width() * 22 / 100;
    resizeDocks({m_docks[0], m_docks[1]}, {width() * 17 / 100, right}, Qt::Horizontal);
}

/// The pictures and nothing else, over the whole screen.
void MainWindow::setPresenting(bool isPresenting)
{
    if (isPresenting)
        m_layoutBeforePresenting = saveState();
    for (QToolBar *bar : findChildren<QToolBar *>())
        bar->setVisible(!isPresenting);
    for (QDockWidget *dock : m_docks)
        dock->setVisible(!isPresenting);
    menuBar()->setVisible(!isPresenting);
    statusBar()->setVisible(!isPresenting);
    setWindowState(windowState().setFlag(Qt::WindowFullScreen, isPresenting));
    if (!isPresenting)
        restoreState(m_layoutBeforePresenting);
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

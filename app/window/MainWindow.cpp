#include "app/window/MainWindow.h"

#include "app/base/GestureWatcher.h"
#include "app/base/MessageBar.h"
#include "app/base/VisibilityWatcher.h"
#include "app/base/distinctLabels.h"
#include "app/base/filePath.h"
#include "app/base/screenSizes.h"
#include "app/commands/Commands.h"
#include "app/document/OutputLayers.h"
#include "app/document/Recovery.h"
#include "app/document/SessionSaver.h"
#include "app/document/hint.h"
#include "app/document/thresholdWords.h"
#include "app/features/evaluate/EvaluatePanel.h"
#include "app/features/events/EventFiles.h"
#include "app/features/events/EventReviews.h"
#include "app/features/events/ShownEvents.h"
#include "app/features/events/chosenEvents.h"
#include "app/features/live/LiveBar.h"
#include "app/features/opening/WelcomePage.h"
#include "app/features/pictures/BoxAnalysis.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/PlainInput.h"
#include "app/features/pictures/Playback.h"
#include "app/features/pictures/Workbench.h"
#include "app/features/pictures/bottomBars.h"
#include "app/features/sequential/SequentialPanel.h"
#include "app/features/settings/AdviceMessages.h"
#include "app/features/settings/OwnPresets.h"
#include "app/features/settings/ThresholdCurves.h"
#include "app/features/settings/ThresholdPanel.h"
#include "app/features/survey/SurveyPanel.h"
#include "app/lessons/Lesson.h"
#include "app/lessons/LessonGuide.h"
#include "app/lessons/LessonList.h"
#include "app/views/ChartMenus.h"
#include "app/views/ReportWriter.h"
#include "app/views/WindowViews.h"
#include "app/views/panelList.h"
#include "app/window/ActivityBar.h"
#include "app/window/Listening.h"
#include "app/window/Opener.h"
#include "app/window/Panels.h"
#include "app/window/TrialViewer.h"
#include "widgets/base/ReadOut.h"
#include "widgets/base/labelText.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/plot/WalkPlot.h"
#include "widgets/waterfall/MarkLegend.h"
#include "widgets/waterfall/OverviewStrip.h"

#include <QCloseEvent>
#include <QDockWidget>
#include <QGridLayout>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>

#include <algorithm>

namespace faintline {

namespace {

    /// Qt moves the panels behind a tab off the window and leaves them visible.
    bool isBehindTab(const QWidget *widget)
    {
        for (; widget && !widget->isWindow(); widget = widget->parentWidget())
            if (const auto *dock = qobject_cast<const QDockWidget *>(widget))
                return !isInSight(*dock);
        return false;
    }

} // namespace

MainWindow::MainWindow(std::unique_ptr<QSettings> memory, const QString &recoveryFolder, QWidget *parent)
    : QMainWindow(parent), m_memory(std::move(memory))
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
    m_opener = new Opener(*this, *m_lessons, *m_lessonList, m_memory, *this);
    m_saver = new SessionSaver(
        m_document, [this] { return viewState(); }, this);
    m_recovery = new Recovery(
        m_document, [this] { return viewState(); }, recoveryFolder, this);
    m_report = new ReportWriter(m_document, *m_views, this);
    m_trials = std::make_unique<TrialViewer>(m_experiments, this);
    m_chartMenus = new ChartMenus(*this, this);
    m_commands = makeCommands(*this);
    connectDocument();
    connectController();
    connectLessons();
    connectParts();
    resize(1440, 900);
    m_panels->rememberDefault();
    m_commands->action("regulation")->setChecked(m_memory.isRegulationShown());
    m_memory.restoreLayout(*this, *this);
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

void MainWindow::buildCentre()
{
    m_messages = new MessageBar;
    m_lessonList = new LessonList;
    m_welcome = new WelcomePage(m_lessonList);
    m_workbench = new Workbench(m_document);
    m_pages = new QStackedWidget;
    m_pages->addWidget(m_welcome);
    m_pages->addWidget(m_workbench);
    m_pings = new PingBench(m_document, m_workbench->layers());
    m_pages->addWidget(m_pings);
    // Hidden parts must not enforce a minimum size.
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
    layout->setSizeConstraint(QLayout::SetMaximumSize); // while the pages are hidden, a panel uses their space
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    m_listening = new Listening(*this, *this);
    layout->addWidget(&m_listening->bar());
    auto *pages = new QGridLayout; // a message lies over them, which keeps the pictures where they are
    pages->addWidget(m_pages, 0, 0);
    pages->addWidget(m_messages, 0, 0, Qt::AlignBottom);
    layout->addLayout(pages, 1);
    m_messages->raise();
    setCentralWidget(centre);
}

void MainWindow::buildPanels()
{
    m_ownPresets = new OwnPresets(m_memory.presetFolder(), this);
    m_threshold = new ExceedancePlot;
    m_threshold->setObjectName(QStringLiteral("threshold"));
    m_threshold->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    new ThresholdCurves(m_document, m_controller, *m_threshold, this);
    m_events = new EventTable;
    m_reviews = new EventReviews(
        m_document, *m_events,
        {m_workbench->input(), m_workbench->output(), m_pings->alongHistory(), m_pings->acrossHistory()}, this);
    m_reviews->setClassNames(m_memory.classNames());
    m_reviews->addMaps({m_pings->input(), m_pings->output()});
    m_shownEvents = new ShownEvents(m_document, *m_events, this);
    m_shownEvents->setSnrBandwidth(m_memory.snrBandwidthHz());
    m_boxAnalysis = new BoxAnalysis(m_document, m_controller, {m_workbench->input(), m_workbench->output()}, this);
    m_playback = new Playback(
        m_document,
        [this]() -> std::optional<Event> {
            const std::vector<Event> events = chosenEvents(m_document, *m_events);
            return events.empty() ? std::nullopt : std::optional(events.front());
        },
        this);
    m_listening->setPlayback(*m_playback);
    for (const PanelRow &row : panelList())
        m_docked.emplace_back(row.dock, row.make(*this));
    for (std::size_t i = 0; i < m_docked.size(); ++i)
        m_panels->add(panelList()[i], *m_docked[i].second);
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
    auto *overview = new OverviewStrip;
    connectOverview(*overview, m_document);
    m_readOut = new ReadOut;
    connectReadOut(*m_readOut, m_document, *m_workbench);
    addBar(QStringLiteral("readOutBar"), tr("Read-out"), m_readOut); // the first one is the lowest
    addToolBarBreak(Qt::BottomToolBarArea);
    addBar(QStringLiteral("overviewBar"), tr("Overview"), overview);
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
    m_legend = new MarkLegend;
    m_legend->hide();
    statusBar()->addPermanentWidget(m_activity);
    statusBar()->addPermanentWidget(m_legend);
}

void MainWindow::connectDocument()
{
    auto *gestures = new GestureWatcher(this);
    connect(gestures, &GestureWatcher::began, &m_document, &Document::beginGesture);
    connect(gestures, &GestureWatcher::ended, &m_document, &Document::endGesture);
    connect(&m_document, &Document::opened, this, [this] {
        if (!m_listening->isRunning()) // messages of the live run remain valid
            m_messages->dismiss();
        for (Bench *one : std::initializer_list<Bench *>{m_workbench, m_pings}) {
            one->setEmptySentence(tr("Estimating the noise of %1 …").arg(m_document.sourceName()));
            one->setPlaying(false);
        }
        if (m_pages->currentWidget() != m_welcome)
            showWorkbench();
        const QString path = m_document.sessionPath().isEmpty() ? m_document.sourcePath() : m_document.sessionPath();
        if (!path.isEmpty() && !path.startsWith(QLatin1Char(':')))
            m_memory.addRecent(path);
        if (!m_listening->isRunning())
            m_opener->offerIq();
    });
    for (const auto changed :
         {&Document::opened, &Document::settingsChanged, &Document::analysisChanged, &Document::provisionalChanged,
          &Document::livePlanChanged, &Document::shownThresholdChanged, &Document::shownEventsChanged})
        connect(&m_document, changed, this, &MainWindow::showHint);
    connect(&m_document, &Document::picturesGrew, this, &MainWindow::showWorkbench);
    connect(&m_document, &Document::analysisChanged, this, &MainWindow::showWorkbench);
    connect(&m_document, &Document::sessionChanged, this, &MainWindow::showTitle);
    connect(&m_document, &Document::settingsChanged, m_messages, &MessageBar::dismiss);
}

void MainWindow::connectController()
{
    connect(&m_controller, &AnalysisController::busyChanged, this, [this](bool isBusy) {
        if (!isBusy && !m_document.isEmpty() && !m_document.analysis())
            m_workbench->output()->setEmptySentence(tr("Stopped before the detector finished."));
        showHint();
    });
    connect(&m_controller, &AnalysisController::failed, this, &MainWindow::showFailure);
    connect(&m_controller, &AnalysisController::warned, this, [this](const QString &where, const QString &why) {
        m_messages->showMessage(MessageBar::Kind::Notice, where, why);
    });
    connect(&m_controller, &AnalysisController::refined, this,
            [this](double firstEstimate) { m_hint->setText(refinedSentence(*m_document.analysis(), firstEstimate)); });
    new AdviceMessages(m_document, m_controller, m_check, *m_messages, this);
    connect(&m_controller, &AnalysisController::viewRestored, this, [this](const ViewState &view) { restore(view); });
    connect(m_playback, &Playback::failed, this, [this](const Error &error) {
        const QString why = QString::fromStdString(error.why());
        m_messages->showMessage(MessageBar::Kind::Notice, QString::fromStdString(error.where()),
                                m_document.takesAnalyses() ? tr("%1; the cursor moves without sound").arg(why) : why);
    });
    connect(m_playback, &Playback::soundless, this, [this] { bench().setPlaying(true); });
    connect(m_saver, &SessionSaver::saved, this, [this](const QString &path) {
        m_memory.addRecent(path);
        m_hint->setText(tr("Saved as %1").arg(labelText(pathBytes(absolutePath(path)), longestPath)));
        emit saved(path);
    });
}

void MainWindow::connectLessons()
{
    connect(m_lessons, &LessonGuide::runningChanged, this, [this](bool isRunning) {
        if (isRunning || !m_pages->isHidden() || m_document.isEmpty())
            return;
        showWorkbench(); // put aside by the lesson
        showTitle();
        showHint();
    });
    connect(m_lessons, &LessonGuide::runningChanged, this, [this](bool isRunning) {
        const auto isOfResets = [](const LessonStep &step) { return step.point == QLatin1String("regulation"); };
        m_workbench->setRegulationWanted((isRunning && std::ranges::any_of(m_lessons->lesson().steps, isOfResets))
                                         || m_commands->action("regulation")->isChecked());
        if (isRunning)
            m_commands->action("present")->setEnabled(true); // also of scans, which have no pictures of their own
    });
    connect(m_lessons, &LessonGuide::finished, this, [this](const QString &path) {
        m_memory.addDoneLesson(path);
        m_lessonList->setDone(m_memory.doneLessons());
        m_commands->refresh();
    });
    m_lessonList->setDone(m_memory.doneLessons());
}

void MainWindow::connectParts()
{
    for (Bench *one : std::initializer_list<Bench *>{m_workbench, m_pings}) {
        connect(one, &Bench::eventActivated, this, &MainWindow::goTo);
        connect(one, &Bench::thresholdStepRequested, &m_controller, &AnalysisController::stepThreshold);
    }
    connect(m_events, &EventTable::eventActivated, this, &MainWindow::goTo);
    connect(m_events, &EventTable::selectionChanged, this, [this] { bench().showSelected(m_events->selectedEvent()); });
    connect(m_reviews, &EventReviews::classNamesChanged, this,
            [this](const QStringList &names) { m_memory.setClassNames(names); });
    connect(&m_reviews->files(), &EventFiles::told, this, [this](const QString &where, const QString &what) {
        m_messages->showMessage(MessageBar::Kind::Notice, where, what);
    });
    connect(&panel<EvaluatePanel>(), &EvaluatePanel::trialRequested, m_trials.get(), &TrialViewer::open);
    connect(m_listening, &Listening::told, m_hint, &QLabel::setText);
    for (JobRunner *runner :
         {&m_controller.runner(), &m_report->runner(), &panel<SurveyPanel>().runner(), &m_trials->runner()})
        m_activity->follow(*runner);

    const auto showErrors = [this]<class... Part>(Part *...parts) {
        (connect(parts, &Part::failed, this, &MainWindow::showError), ...);
    };
    const auto showFiles = [this]<class... Part>(Part *...parts) {
        (connect(parts, &Part::written, this, &MainWindow::showWritten), ...);
    };
    showErrors(&m_reviews->files(), m_chartMenus, m_views, m_report, m_saver, m_lessons, m_trials.get(),
               &m_workbench->layers(), &m_workbench->plainInput());
    showFiles(&m_reviews->files(), m_chartMenus, m_views, m_report, m_lessons);
    for (const auto &[dock, docked] : m_docked)
        if (auto *own = qobject_cast<Panel *>(docked)) {
            showErrors(own);
            showFiles(own);
        }

    auto *sequential = static_cast<QDockWidget *>(panel<SequentialPanel>().parentWidget());
    connect(sequential->toggleViewAction(), &QAction::toggled, this, [this, sequential] {
        if (sequential->isHidden() && m_pages->isHidden() && !m_panels->isRearranging()) // it was the only panel
            showWelcome();
    });
    const auto seen =
        std::make_shared<std::array<bool, 2>>(); // forms that have the settings of the threshold's panel, too
    for (const std::size_t form : {std::size_t(0), std::size_t(1)})
        connect(findChild<QDockWidget *>(QLatin1String(form == 0 ? "pipelineDock" : "settingsDock")),
                &QDockWidget::visibilityChanged, this, [this, seen, form](bool isSeen) {
                    (*seen)[form] = isSeen;
                    panel<ThresholdPanel>().setMainSettingsWanted(*seen == std::array{false, false});
                });
}

/// The document stays open.
void MainWindow::putBenchAside()
{
    keepLayout();
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
    if (const QByteArray panels = m_memory.panels(); panels.isEmpty() || !restoreState(panels))
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
    keepLayout();
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

void MainWindow::keepLayout()
{
    QAction *presenting = m_commands->action("present");
    if (m_pages->currentWidget() == m_welcome || presenting->isChecked())
        return;
    m_panels->restoreMaximised();
    m_memory.keepLayout(*this, *this, m_commands->action("regulation")->isChecked());
}

void MainWindow::takeLayout(const QString &name)
{
    m_panels->takeLayout(name);
    m_commands->action("regulation")->setChecked(name != Panels::analyse());
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
    m_events->setSelectedEvent(event);
    bench().selectEvent(event);
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

} // namespace faintline

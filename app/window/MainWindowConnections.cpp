// Signal connections of the main window: document, controller and views.

#include "app/window/MainWindow.h"

#include "app/base/GestureWatcher.h"
#include "app/base/MessageBar.h"
#include "app/base/filePath.h"
#include "app/control/AdviceMessages.h"
#include "app/control/EventFiles.h"
#include "app/control/EventReviews.h"
#include "app/control/OutputLayers.h"
#include "app/control/Playback.h"
#include "app/control/thresholdWords.h"
#include "app/document/Recovery.h"
#include "app/document/SessionSaver.h"
#include "app/lessons/Lesson.h"
#include "app/lessons/LessonGuide.h"
#include "app/lessons/LessonList.h"
#include "app/panels/ChannelsPanel.h"
#include "app/panels/ComparePanel.h"
#include "app/panels/DopplerPanel.h"
#include "app/panels/EvaluatePanel.h"
#include "app/panels/ExperimentsPanel.h"
#include "app/panels/PipelinePanel.h"
#include "app/panels/SequentialPanel.h"
#include "app/panels/StateSlicePanel.h"
#include "app/panels/SurveyPanel.h"
#include "app/panels/SweepPanel.h"
#include "app/panels/TargetsPanel.h"
#include "app/panels/WhyPanel.h"
#include "app/views/ChartMenus.h"
#include "app/views/ReportWriter.h"
#include "app/views/WindowViews.h"
#include "app/welcome/WelcomePage.h"
#include "app/window/ActivityBar.h"
#include "app/window/Commands.h"
#include "app/window/FileDrop.h"
#include "app/window/Panels.h"
#include "app/window/TrialViewer.h"
#include "app/workspace/PingBench.h"
#include "app/workspace/Workbench.h"
#include "widgets/base/ReadOut.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/base/settingWords.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/waterfall/LinkedPictures.h"
#include "widgets/waterfall/OverviewStrip.h"

#include <QDockWidget>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QStackedWidget>

#include <algorithm>

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

} // namespace

void MainWindow::connectDocument()
{
    auto *gestures = new GestureWatcher(this);
    connect(gestures, &GestureWatcher::began, &m_document, &Document::beginGesture);
    connect(gestures, &GestureWatcher::ended, &m_document, &Document::endGesture);
    connect(&m_document, &Document::opened, this, [this] {
        if (!m_live->isRunning()) // messages of the live run remain valid
            m_messages->dismiss();
        if (m_document.recording()) {
            m_readOut->setStartUnixSeconds(m_document.recording()->info().startUnixSeconds);
            m_readOut->setCentreHz(m_document.recording()->info().centreHz);
        }
        m_overview->setPicture(nullptr, {});
        // Clear everything from the previous document.
        m_events->setEvents({});
        m_events->filter()->clear();
        m_threshold->setHistogram({});
        m_threshold->setCalibration({}, 0.0);
        for (Bench *one : std::initializer_list<Bench *>{m_workbench, m_pings})
            one->setEmptySentence(tr("Estimating the noise of %1 …").arg(m_document.sourceName()));
        if (m_pages->currentWidget() != m_welcome)
            showWorkbench();
        m_workbench->setPlaying(false);
        m_pings->setPlaying(false);
        const QString path = m_document.sessionPath().isEmpty() ? m_document.sourcePath() : m_document.sessionPath();
        if (!path.isEmpty() && !path.startsWith(QLatin1Char(':')))
            m_memory.addRecent(path);
        offerIq();
        showHint();
    });
    connect(&m_document, &Document::picturesGrew, this, [this](const PicturesSoFar &pictures) {
        m_overview->setPicture(pictures.quickLook ? pictures.quickLook : pictures.input, pictures.frequency);
        showWorkbench();
    });
    connect(&m_document, &Document::analysisChanged, this, &MainWindow::showAnalysis);
    connect(&m_document, &Document::provisionalChanged, this, &MainWindow::showHint);
    connect(&m_document, &Document::shownThresholdChanged, m_threshold,
            [this] { m_threshold->setThreshold(m_document.shownThreshold()); });
    connect(&m_document, &Document::shownEventsChanged, this, &MainWindow::showEvents);
    const auto showWhetherPreview = [this] {
        m_events->setPreview(m_document.isPreview());
        m_events->setEmptySentence(m_document.analysis() ? tr("No event at this threshold.")
                                                         : tr("Events follow when the detector has run."));
        showHint();
    };
    connect(&m_document, &Document::opened, this, showWhetherPreview);
    connect(&m_document, &Document::settingsChanged, this, showWhetherPreview);
    connect(&m_document, &Document::analysisChanged, this, showWhetherPreview);
    connect(&m_document, &Document::shownThresholdChanged, this, showWhetherPreview);
    connect(&m_document, &Document::sessionChanged, this, &MainWindow::showTitle);
    connect(&m_document, &Document::settingsChanged, m_messages, &MessageBar::dismiss);
}

void MainWindow::connectController()
{
    m_activity->follow(m_controller.runner());
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
    m_saver = new SessionSaver(
        m_document, [this] { return viewState(); }, this);
    m_recovery = new Recovery(
        m_document, [this] { return viewState(); }, m_recoveryFolder, this);
    m_report = new ReportWriter(m_document, *m_views, this);
    m_activity->follow(m_report->runner());
    connect(m_playback, &Playback::failed, this, [this](const Error &error) {
        const QString why = QString::fromStdString(error.why());
        m_messages->showMessage(MessageBar::Kind::Notice, QString::fromStdString(error.where()),
                                m_document.isLive() ? why : tr("%1; the cursor moves without sound").arg(why));
    });
    connect(m_playback, &Playback::soundless, this, [this] { bench().setPlaying(true); });
    connect(m_report, &ReportWriter::failed, this, &MainWindow::showError);
    connect(m_report, &ReportWriter::written, this, &MainWindow::showWritten);
    connect(m_saver, &SessionSaver::failed, this, &MainWindow::showError);
    connect(m_saver, &SessionSaver::saved, this, [this](const QString &path) {
        m_memory.addRecent(path);
        m_hint->setText(tr("Saved as %1").arg(labelText(pathBytes(absolutePath(path)), longestPath)));
        emit saved(path);
    });
}

void MainWindow::connectWelcome()
{
    connect(m_welcome, &WelcomePage::openRequested, this, &MainWindow::chooseFile);
    connect(m_welcome, &WelcomePage::pathChosen, this, [this](const QString &path) { open(path); });
    connect(m_lessonList, &LessonList::chosen, this,
            [this](int lesson) { startLesson(lessons()[std::size_t(lesson)]); });
    connect(m_lessons, &LessonGuide::runningChanged, this, [this](bool isRunning) {
        if (isRunning || !m_pages->isHidden() || m_document.isEmpty())
            return;
        showWorkbench(); // put aside by the lesson
        showTitle();
        showHint();
    });
    connect(m_lessons, &LessonGuide::runningChanged, this,
            [layers = &m_workbench->layers(), before = std::optional<OutputLayer>()](bool isRunning) mutable {
                if (isRunning && !before)
                    before = layers->chosen();
                layers->setLayer(isRunning ? OutputLayer::Statistic : before.value_or(layers->chosen()));
                if (!isRunning)
                    before.reset();
            }); // lessons speak of the statistic
    connect(m_lessons, &LessonGuide::runningChanged, this, [this](bool isRunning) {
        const auto isOfResets = [](const LessonStep &step) { return step.point == QLatin1String("regulation"); };
        m_workbench->setRegulationWanted((isRunning && std::ranges::any_of(m_lessons->lesson().steps, isOfResets))
                                         || m_commands->action("regulation")->isChecked());
        if (isRunning)
            m_commands->action("present")->setEnabled(true); // also of scans, which have no pictures of their own
    });
    connect(m_lessons, &LessonGuide::lessonRequested, this,
            [this](int lesson) { startLesson(lessons()[std::size_t(lesson)]); });
    connect(m_lessons, &LessonGuide::written, this, &MainWindow::showWritten);
    connect(m_lessons, &LessonGuide::failed, this, &MainWindow::showError);
}

/// Connects everything in which an event can be selected, and what is done with events.
void MainWindow::connectEvents()
{
    const auto goTo = [this](int id) {
        bench().selectEvent(id);
        m_events->setSelectedEvent(id);
    };
    for (Bench *one : std::initializer_list<Bench *>{m_workbench, m_pings}) {
        connect(one, &Bench::eventActivated, this, goTo);
        connect(one, &Bench::thresholdStepRequested, &m_controller, &AnalysisController::stepThreshold);
    }
    connect(m_events, &EventTable::eventActivated, this, goTo);
    connect(m_reviews, &EventReviews::classNamesChanged, this,
            [this](const QStringList &names) { m_memory.setClassNames(names); });
    connect(&m_reviews->files(), &EventFiles::failed, this, &MainWindow::showError);
    connect(&m_reviews->files(), &EventFiles::written, this, &MainWindow::showWritten);
    connect(&m_reviews->files(), &EventFiles::told, this, [this](const QString &where, const QString &what) {
        m_messages->showMessage(MessageBar::Kind::Notice, where, what);
    });
    connect(m_compare, &ComparePanel::eventActivated, this, goTo);
}

void MainWindow::connectViews()
{
    connect(m_workbench->output(), &WaterfallView::orientationChanged, m_compare->picture(),
            &WaterfallView::setOrientation);
    WaterfallView *output = m_workbench->output();
    LinkedPictures *channels = &m_channels->pictures();
    connect(output, &WaterfallView::orientationChanged, channels, &LinkedPictures::setOrientation);
    connect(channels, &LinkedPictures::orientationChanged, output, &WaterfallView::setOrientation);
    connect(output, &WaterfallView::colourMapChanged, channels, &LinkedPictures::setColourMap);
    connect(channels, &LinkedPictures::colourMapChanged, output, &WaterfallView::setColourMap);
    connect(m_workbench, &Workbench::readingChanged, m_readOut, &ReadOut::setReading);
    connect(m_workbench->output(), &WaterfallView::colourMapChanged, m_overview,
            [this](const QString &name) { m_overview->setColourMap(ColourMap::named(name)); });

    connect(static_cast<QDockWidget *>(m_states->parentWidget()), &QDockWidget::visibilityChanged,
            &m_workbench->layers(), &OutputLayers::setWatching);
    connect(&m_workbench->layers(), &OutputLayers::failed, this, &MainWindow::showError);
    connect(m_states, &StateSlicePanel::lawRequested, this,
            [this](const QString &field, const std::vector<double> &law) {
                m_controller.edit(field, law, tr("Change “%1”").arg(settingLabel(field)));
            });
    connect(m_threshold, &ExceedancePlot::thresholdRequested, &m_controller, &AnalysisController::previewThreshold);
    connect(m_threshold, &ExceedancePlot::thresholdCommitted, &m_controller, &AnalysisController::commitThreshold);
    connect(m_threshold, &ExceedancePlot::unitChanged, this,
            [this](ExceedancePlot::Unit unit) { m_controller.setThresholdUnit(decideBy(unit)); });
    connect(m_pipeline, &PipelinePanel::failed, this, &MainWindow::showError);
    connect(m_views, &WindowViews::failed, this, &MainWindow::showError);
    connect(m_why, &WhyPanel::remedyRequested, this, [this](const Advice &advice) {
        m_controller.setSettings(m_check.remedied(advice), capitalised(QString::fromStdString(advice.remedy)));
    });
    m_chartMenus = new ChartMenus(*this, this);
    connect(m_chartMenus, &ChartMenus::failed, this, &MainWindow::showError);
    connect(m_chartMenus, &ChartMenus::written, this, &MainWindow::showWritten);
    connect(m_views, &WindowViews::written, this, &MainWindow::showWritten);
    connect(m_sequential, &SequentialPanel::written, this, &MainWindow::showWritten);
    connect(m_doppler, &DopplerPanel::written, this, &MainWindow::showWritten);
    connect(m_doppler, &DopplerPanel::failed, this, &MainWindow::showError);
    connect(new FileDrop(this), &FileDrop::dropped, this, &MainWindow::openDropped);
}

void MainWindow::connectSurvey()
{
    connect(m_survey, &SurveyPanel::eventReached, this, [this](int id) {
        m_panels->show(m_survey); // the first recording replaces it with the panels of a recording
        emit m_events->eventActivated(id);
    });
    connect(m_survey, &SurveyPanel::opened, this, [this] {
        showAlone(m_survey, tr("Survey — Faintline"), tr("Double-click an event to open its recording there."));
    });
    m_activity->follow(m_survey->runner());
    connect(m_survey, &SurveyPanel::failed, this, &MainWindow::showError);
    connect(m_survey, &SurveyPanel::openRequested, this,
            [this](const QString &path, const OpenOptions &options, const AnalysisController::Adjust &adjust) {
                const auto next = [this, path, options, adjust] { openNow(path, options, adjust); };
                if (mayLeave(tr("opening something else"), next))
                    next();
            });
}

void MainWindow::connectTargets()
{
    connect(m_targets, &TargetsPanel::newSceneRequested, this, &MainWindow::newScene);
    connect(m_targets, &TargetsPanel::written, this, &MainWindow::showWritten);
    connect(m_targets, &TargetsPanel::failed, this, &MainWindow::showError);
    connect(m_targets, &TargetsPanel::activeChanged, m_pings, &PingBench::setMapsFirst);
    connect(static_cast<QDockWidget *>(m_targets->parentWidget()), &QDockWidget::visibilityChanged, m_targets,
            &TargetsPanel::setActive);
}

void MainWindow::connectEvaluation()
{
    m_trials = std::make_unique<TrialViewer>(m_experiments, this);
    connect(m_evaluate, &EvaluatePanel::trialRequested, m_trials.get(), &TrialViewer::open);
    connect(m_evaluate, &EvaluatePanel::failed, this, &MainWindow::showError);
    connect(m_sweep, &SweepPanel::failed, this, &MainWindow::showError);
    connect(m_sweep, &SweepPanel::valueChosen, &m_controller, &AnalysisController::editNumber);
    connect(m_sequential, &SequentialPanel::failed, this, &MainWindow::showError);
    auto *dock = static_cast<QDockWidget *>(m_sequential->parentWidget());
    connect(dock->toggleViewAction(), &QAction::toggled, this, [this, dock] {
        if (dock->isHidden() && m_pages->isHidden() && !m_panels->isRearranging()) // it was the only panel
            showWelcome();
    });
    connect(m_trials.get(), &TrialViewer::failed, this, &MainWindow::showError);
    m_activity->follow(m_trials->runner());
    connect(m_experimentList, &ExperimentsPanel::failed, this, &MainWindow::showError);
    connect(m_experimentList, &ExperimentsPanel::showRequested, this, &MainWindow::showExperiment);
    connect(&m_experiments, &Experiments::changed, this, [this](int id) {
        // Show a finished reproduction; curves update in place.
        if (const Experiments::Entry *entry = m_experiments.entry(id);
            entry->state == Experiments::State::Done && entry->reproduction)
            showExperiment(id);
    });
}

} // namespace faintline

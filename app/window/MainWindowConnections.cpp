// Signal connections of the main window: document, controller and views.

#include "app/window/MainWindow.h"

#include "app/base/GestureWatcher.h"
#include "app/base/MessageBar.h"
#include "app/base/filePath.h"
#include "app/control/AdviceMessages.h"
#include "app/control/EventFiles.h"
#include "app/control/EventReviews.h"
#include "app/control/OutputLayers.h"
#include "app/control/PlainInput.h"
#include "app/control/Playback.h"
#include "app/control/thresholdWords.h"
#include "app/document/SessionSaver.h"
#include "app/lessons/Lesson.h"
#include "app/lessons/LessonGuide.h"
#include "app/lessons/LessonList.h"
#include "app/panels/EvaluatePanel.h"
#include "app/panels/SequentialPanel.h"
#include "app/panels/SurveyPanel.h"
#include "app/panels/ThresholdPanel.h"
#include "app/views/ChartMenus.h"
#include "app/views/ReportWriter.h"
#include "app/views/WindowViews.h"
#include "app/welcome/WelcomePage.h"
#include "app/window/ActivityBar.h"
#include "app/window/Commands.h"
#include "app/window/FileDrop.h"
#include "app/window/Listening.h"
#include "app/window/Opener.h"
#include "app/window/Panels.h"
#include "app/window/TrialViewer.h"
#include "app/workspace/PingBench.h"
#include "app/workspace/Workbench.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ExceedancePlot.h"

#include <QDockWidget>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QStackedWidget>

#include <algorithm>

namespace faintline {

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
    connect(m_welcome, &WelcomePage::openRequested, m_opener, &Opener::chooseFile);
    connect(m_welcome, &WelcomePage::pathChosen, this, [this](const QString &path) { open(path); });
    connect(m_lessonList, &LessonList::chosen, this,
            [this](int lesson) { m_opener->startLesson(lessons()[std::size_t(lesson)]); });
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
            [this](int lesson) { m_opener->startLesson(lessons()[std::size_t(lesson)]); });
}

void MainWindow::connectParts()
{
    for (Bench *one : std::initializer_list<Bench *>{m_workbench, m_pings}) {
        connect(one, &Bench::eventActivated, this, &MainWindow::goTo);
        connect(one, &Bench::thresholdStepRequested, &m_controller, &AnalysisController::stepThreshold);
    }
    connect(m_events, &EventTable::eventActivated, this, &MainWindow::goTo);
    connect(m_reviews, &EventReviews::classNamesChanged, this,
            [this](const QStringList &names) { m_memory.setClassNames(names); });
    connect(&m_reviews->files(), &EventFiles::told, this, [this](const QString &where, const QString &what) {
        m_messages->showMessage(MessageBar::Kind::Notice, where, what);
    });
    connect(new FileDrop(this), &FileDrop::dropped, m_opener, &Opener::openDropped);
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

} // namespace faintline

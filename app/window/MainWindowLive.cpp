// Live runs: the document's recording is still being written.

#include "app/window/MainWindow.h"

#include "app/base/MessageBar.h"
#include "app/base/filePath.h"
#include "app/control/Playback.h"
#include "app/document/SessionSaver.h"
#include "app/panels/ListenDialog.h"
#include "app/welcome/WelcomePage.h"
#include "app/workspace/LiveBar.h"
#include "app/workspace/Workbench.h"
#include "widgets/waterfall/OverviewStrip.h"

#include <QDateTime>
#include <QDir>
#include <QLabel>

namespace faintline {

namespace {

    constexpr double updateSeconds = 1.0; ///< between two reports of an event in progress

    /// Resets settings that refer to a recording's own time or need its end.
    ListenSettings listenSettings(const AnalysisSettings &analysis)
    {
        ListenSettings settings;
        settings.analysis = analysis;
        settings.analysis.selection.fromSeconds = settings.analysis.selection.toSeconds = 0.0;
        settings.analysis.subtract.lines = false;
        settings.updateSeconds = updateSeconds;
        return settings;
    }

} // namespace

void MainWindow::connectLive()
{
    connect(m_live, &LiveRun::grew, this, &MainWindow::showLive);
    connect(m_live, &LiveRun::noticed, this, &MainWindow::tellNotice);
    connect(m_live, &LiveRun::failed, this, [this](const Error &error) {
        m_liveTrouble = error;
        showError(error);
    });
    connect(m_live, &LiveRun::ended, this, &MainWindow::endLive);
    connect(m_workbench, &Workbench::livePainted, m_liveBar, &LiveBar::setDelay);
    connect(m_liveBar, &LiveBar::hearingRequested, this, [this](bool isWanted) {
        if (!isWanted)
            m_playback->stop();
        else if (!m_playback->startLive())
            m_liveBar->setHearing(false);
    });
    connect(m_playback, &Playback::hearingChanged, m_liveBar, &LiveBar::setHearing);
    connect(m_playback, &Playback::delayChanged, m_liveBar, &LiveBar::setSoundDelay);
    connect(&m_document, &Document::livePlanChanged, this, [this] { showPlan(*m_document.plan()); });
    connect(&m_document, &Document::settingsChanged, this, [this] {
        if (m_document.isLive())
            m_live->change(m_document.settings());
    });
}

bool MainWindow::mayLeave(const QString &what, const std::function<void()> &next)
{
    if (!m_live->isRunning())
        return m_saver->mayLose(what, next);
    m_messages->showMessage(MessageBar::Kind::Notice, tr("Listening"), tr("Stop it before %1.").arg(what), tr("Stop"),
                            [this] { m_live->stop(); });
    return false;
}

void MainWindow::listen()
{
    const auto next = [this] {
        if (!m_listenDialog)
            m_listenDialog = new ListenDialog(this);
        if (m_listenDialog->exec() == QDialog::Accepted)
            listenTo(m_listenDialog->source(), m_listenDialog->folder(), {}, m_listenDialog->rotation());
    };
    if (mayLeave(tr("listening to something else"), next))
        next();
}

void MainWindow::listenTo(LiveRun::OpenSource source, const QString &folder,
                          const std::optional<AnalysisSettings> &analysis, const RotationSettings &rotation)
{
    const bool hasSettings = m_document.recording() != nullptr; // settings of ready-made frames do not apply to samples
    ListenSettings settings = listenSettings(analysis      ? *analysis
                                             : hasSettings ? m_document.settings()
                                                           : AnalysisSettings());
    const QString name = QStringLiteral("live-%1.sigmf-meta")
                             .arg(QDateTime::currentDateTimeUtc().toString(QStringLiteral("yyyyMMdd'T'hhmmss'Z'")));
    settings.recordPath = pathBytes(QDir(folder).filePath(name));
    settings.rotation = rotation;
    m_liveTrouble.reset();
    m_controller.stop();
    m_document.setOpened({}, settings.analysis);
    for (Bench *one : std::initializer_list<Bench *>{m_workbench, &bench()})
        one->setEmptySentence(tr("Waiting for the first samples, and for enough of them to estimate the noise …"));
    m_live->start(std::move(source), settings);
    showWorkbench();
    m_liveBar->show();
    m_hint->setText(
        tr("Recording began with the first sample; the pictures appear when the noise has been estimated."));
}

/// The recording exists from its first samples; the first picture appears after a block of noise.
void MainWindow::showLive(const LiveView &view)
{
    if (!m_document.isLive()) {
        try {
            m_document.setOpened(openSource(sourceAt(m_live->state().recording)), view.plan->settings);
        } catch (const Error &error) {
            showError(error);
            return m_live->stop();
        }
    }
    const bool isFirst = !m_document.isLive();
    m_document.setLive(view);
    if (isFirst) {
        showTitle();
        showHint();
    }
    if (isFirst || view.time.count >= m_overviewFrames + m_overviewFrames / 64 + 1) { // it shows all, which is costly
        m_overviewFrames = view.time.count;
        m_overview->setPicture(view.input, view.plan->grid().axes.back());
    }
}

void MainWindow::tellNotice(const ListenNotice &notice)
{
    using Kind = ListenNotice::Kind;
    if (notice.words.empty())
        return;
    const bool isError = notice.kind == Kind::RecordingFailed || notice.kind == Kind::DiskSpace
                         || notice.kind == Kind::Gone || notice.kind == Kind::Refused;
    const std::string where = m_live->state().format ? m_live->state().format->origin : tr("Listening").toStdString();
    if (notice.kind == Kind::RecordingFailed)
        m_liveTrouble = Error(where, notice.words);
    if (isError)
        return showError(Error(where, notice.words));
    m_messages->showMessage(MessageBar::Kind::Notice, QString::fromStdString(where),
                            QString::fromStdString(notice.words));
}

void MainWindow::endLive()
{
    m_liveBar->hide();
    const QString recording = m_live->state().recording;
    const AnalysisSettings settings = m_document.settings();
    const bool wasLive = m_document.isLive();
    m_document.endLive();
    if (std::exchange(m_isLeaving, false) && close())
        return;
    if (!fileExists(recording)) // nothing was received
        return showWelcome();
    if (m_liveTrouble) // opening dismisses messages
        connect(
            &m_document, &Document::opened, this, [this] { showError(*m_liveTrouble); }, Qt::SingleShotConnection);
    m_controller.open(recording, {}, [settings, wasLive](AnalysisSettings &opened) {
        if (wasLive)
            opened = settings;
    });
}

} // namespace faintline

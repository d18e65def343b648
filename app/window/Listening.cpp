#include "app/window/Listening.h"

#include "app/base/MessageBar.h"
#include "app/base/filePath.h"
#include "app/document/sourceAt.h"
#include "app/features/live/ListenDialog.h"
#include "app/features/live/LiveBar.h"
#include "app/features/pictures/LivePictures.h"
#include "app/features/pictures/Playback.h"
#include "app/features/pictures/Workbench.h"
#include "app/views/WindowParts.h"

#include <QDateTime>
#include <QDir>

#include <utility>

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

Listening::Listening(WindowParts &parts, QWidget &window)
    : QObject(&window), m_parts(parts), m_window(window), m_bar(new LiveBar(parts.document(), m_run))
{
    m_bar->hide();
    connect(&m_run, &LiveRun::grew, this, &Listening::show);
    connect(&m_run, &LiveRun::noticed, this, &Listening::tell);
    connect(&m_run, &LiveRun::failed, this, [this](const Error &error) {
        m_trouble = error;
        m_parts.showError(error);
    });
    connect(&m_run, &LiveRun::ended, this, &Listening::end);
    connect(&parts.document(), &Document::settingsChanged, this, [this] {
        if (!m_parts.document().live().isEmpty())
            m_run.change(m_parts.document().settings());
    });
}

Listening::~Listening() = default;

void Listening::setPlayback(Playback &playback)
{
    connect(&m_parts.workbench().live(), &LivePictures::painted, m_bar, &LiveBar::setDelay);
    connect(m_bar, &LiveBar::hearingRequested, this, [this, &playback](bool isWanted) {
        if (!isWanted)
            playback.stop();
        else if (!playback.startLive())
            m_bar->setHearing(false);
    });
    connect(&playback, &Playback::hearingChanged, m_bar, &LiveBar::setHearing);
    connect(&playback, &Playback::delayChanged, m_bar, &LiveBar::setSoundDelay);
}

bool Listening::mayLeave(const QString &what)
{
    if (m_run.isRunning())
        m_parts.messages().showMessage(MessageBar::Kind::Notice, tr("Listening"), tr("Stop it before %1.").arg(what),
                                       tr("Stop"), [this] { m_run.stop(); });
    return !m_run.isRunning();
}

void Listening::leave()
{
    m_isLeaving = m_run.isRunning(); // it may have ended while the user was asked
    m_run.stop();
}

void Listening::ask()
{
    const auto next = [this] {
        if (!m_dialog)
            m_dialog = std::make_unique<ListenDialog>(&m_window);
        if (m_dialog->exec() == QDialog::Accepted)
            start(m_dialog->source(), m_dialog->folder(), {}, m_dialog->rotation());
    };
    if (m_parts.mayLeave(tr("listening to something else"), next))
        next();
}

void Listening::start(LiveRun::OpenSource source, const QString &folder,
                      const std::optional<AnalysisSettings> &analysis, const RotationSettings &rotation)
{
    Document &document = m_parts.document();
    const bool hasSettings = document.recording() != nullptr; // settings of ready-made frames do not apply to samples
    ListenSettings settings = listenSettings(analysis      ? *analysis
                                             : hasSettings ? document.settings()
                                                           : AnalysisSettings());
    const QString name = QStringLiteral("live-%1.sigmf-meta")
                             .arg(QDateTime::currentDateTimeUtc().toString(QStringLiteral("yyyyMMdd'T'hhmmss'Z'")));
    settings.recordPath = pathBytes(QDir(folder).filePath(name));
    settings.rotation = rotation;
    m_trouble.reset();
    m_parts.controller().stop();
    document.setOpened({}, settings.analysis);
    for (Bench *one : std::initializer_list<Bench *>{&m_parts.workbench(), &m_parts.bench()})
        one->setEmptySentence(tr("Waiting for the first samples, and for enough of them to estimate the noise …"));
    m_run.start(std::move(source), settings);
    m_parts.showWorkbench();
    m_bar->show();
    emit told(tr("Recording began with the first sample; the pictures appear when the noise has been estimated."));
}

/// The recording exists from its first samples; the first picture appears after a block of noise.
void Listening::show(const LiveView &view)
{
    Document &document = m_parts.document();
    if (document.live().isEmpty()) {
        try {
            document.setOpened(openSource(sourceAt(m_run.state().recording)), view.plan->settings);
        } catch (const Error &error) {
            m_parts.showError(error);
            return m_run.stop();
        }
    }
    document.setLive(view);
}

void Listening::tell(const ListenNotice &notice)
{
    using Kind = ListenNotice::Kind;
    if (notice.words.empty())
        return;
    const bool isError = notice.kind == Kind::RecordingFailed || notice.kind == Kind::DiskSpace
                         || notice.kind == Kind::Gone || notice.kind == Kind::Refused;
    const std::string where = m_run.state().format ? m_run.state().format->origin : tr("Listening").toStdString();
    if (notice.kind == Kind::RecordingFailed)
        m_trouble = Error(where, notice.words);
    if (isError)
        return m_parts.showError(Error(where, notice.words));
    m_parts.messages().showMessage(MessageBar::Kind::Notice, QString::fromStdString(where),
                                   QString::fromStdString(notice.words));
}

void Listening::end()
{
    m_bar->hide();
    Document &document = m_parts.document();
    const QString recording = m_run.state().recording;
    const AnalysisSettings settings = document.settings();
    const bool wasLive = !document.live().isEmpty();
    document.endLive();
    if (std::exchange(m_isLeaving, false) && m_window.close())
        return;
    if (!fileExists(recording)) // nothing was received
        return m_parts.showWelcome();
    if (m_trouble) // opening dismisses messages
        connect(
            &document, &Document::opened, this, [this] { m_parts.showError(*m_trouble); }, Qt::SingleShotConnection);
    m_parts.controller().open(recording, {}, [settings, wasLive](AnalysisSettings &opened) {
        if (wasLive)
            opened = settings;
    });
}

} // namespace faintline

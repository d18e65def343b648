#include "app/features/live/LiveBar.h"

#include "base/utc.h"
#include "widgets/base/Theme.h"
#include "widgets/base/diskRoom.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"

#include <QDateTime>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr int refreshMs = 250;
    constexpr int delayTicks = 8; ///< over which the maximum delay is taken

} // namespace

LiveBar::LiveBar(Document &document, LiveRun &run, QWidget *parent)
    : QWidget(parent), m_document(document), m_run(run), m_label(new QLabel), m_hear(new QToolButton),
      m_hold(new QToolButton), m_stop(new QToolButton)
{
    m_label->setTextFormat(Qt::RichText);
    m_label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_label->setAccessibleName(tr("Live"));
    m_hear->setObjectName(QStringLiteral("hear"));
    m_hear->setCheckable(true);
    m_hear->setToolTip(tr("Play what comes in: all of it, the band of the box, or a line (Play > Play what)"));
    m_hear->setFocusPolicy(Qt::TabFocus);
    connect(m_hear, &QToolButton::toggled, this, &LiveBar::hearingRequested);
    m_hold->setToolTip(tr("Hold the picture while listening continues, or go back to the newest frames (Space, End)"));
    m_hold->setFocusPolicy(Qt::TabFocus);
    m_stop->setText(tr("Stop"));
    m_stop->setToolTip(tr("Stop listening and open the recording"));
    m_stop->setFocusPolicy(Qt::TabFocus);
    connect(m_hold, &QToolButton::clicked, this,
            [this] { m_document.viewport().setFollowing(!m_document.viewport().isFollowing()); });
    connect(m_stop, &QToolButton::clicked, this, [this] {
        m_run.stop();
        refresh();
    });
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(8, 3, 8, 3);
    layout->addWidget(m_label, 1);
    layout->addWidget(m_hear);
    layout->addWidget(m_hold);
    layout->addWidget(m_stop);
    m_refresh.setInterval(refreshMs);
    connect(&m_refresh, &QTimer::timeout, this, [this] {
        if (isVisible())
            refresh();
    });
    connect(&run, &LiveRun::begun, this, &LiveBar::refresh);
    connect(&run, &LiveRun::noticed, this, &LiveBar::refresh);
    connect(&document.viewport(), &Viewport::followingChanged, this, &LiveBar::refresh);
    m_refresh.start();
    refresh();
}

void LiveBar::setDelay(double seconds)
{
    m_longestDelay = std::max(m_longestDelay, seconds);
}

void LiveBar::setHearing(bool isHearing)
{
    m_hear->setChecked(isHearing);
    refresh();
}

QString LiveBar::pictureWords() const
{
    if (!m_document.viewport().isFollowing())
        return tr("held; listening continues");
    return tr("picture %1 behind the sound").arg(secondsText(std::max(m_longestDelay, m_delayBefore), 0.01));
}

QString LiveBar::lostWords() const
{
    const LiveRun::State &state = m_run.state();
    if (state.lostCount == 0)
        return tr("no sample lost");
    const double seconds = state.format ? double(state.lostCount) / state.format->sampleRateHz : 0.0;
    const QString gaps = state.gapCount == 1 ? tr("1 gap") : tr("%1 gaps").arg(state.gapCount);
    return tr("%1 of samples lost in %2").arg(secondsText(seconds, 1e-3), gaps);
}

QString LiveBar::diskWords() const
{
    const std::optional<double> room = freeBytes(QFileInfo(m_run.state().recording).path());
    if (!room || !m_run.state().format)
        return tr("disk: unknown");
    const StreamFormat &format = *m_run.state().format;
    return tr("disk full in %1").arg(roughTimeText(*room / double(format.frameBytes()) / format.sampleRateHz));
}

void LiveBar::refresh()
{
    const LiveRun::State &state = m_run.state();
    const LiveView &live = m_document.live();
    const double now = double(QDateTime::currentMSecsSinceEpoch()) * 1e-3;
    const bool isFollowing = m_document.viewport().isFollowing();
    m_hold->setText(isFollowing ? tr("Hold") : tr("To the newest"));
    m_hear->setText(m_hear->isChecked() ? tr("Mute") : tr("Hear"));
    m_hold->setVisible(!live.isEmpty());
    m_hear->setVisible(!live.isEmpty());
    m_stop->setEnabled(m_run.isRunning() && !state.isStopping);
    QStringList words{QString::fromStdString(formatUtc(std::floor(now)))};
    if (!state.format)
        words << tr("waiting for the source");
    else
        words << labelText(state.format->origin, 40);
    if (state.isStopping)
        words << tr("stopping");
    if (state.format && live.isEmpty())
        words << tr("estimating the noise of the first %1").arg(secondsText(state.blockSeconds, 1.0));
    if (!live.isEmpty())
        words << pictureWords()
              << tr("window %1").arg(secondsText(live.plan->settings.spectrogram.windowSeconds, 0.01));
    if (m_hear->isChecked())
        words << tr("heard %1 later").arg(secondsText(m_soundDelay, 0.01));
    if (state.format)
        words << lostWords() << diskWords();
    for (QString &word : words)
        word = word.toHtmlEscaped().replace(QLatin1Char(' '), QStringLiteral("&nbsp;"));
    m_label->setText(QStringLiteral("<span style='color:#e5484d'>●</span>&nbsp;<b>%1</b>&nbsp; %2")
                         .arg(state.isStopping || !m_run.isRunning() ? tr("Ending") : tr("Live"),
                              words.join(QStringLiteral(" &nbsp;·&nbsp; "))));
    if (++m_ticks % delayTicks == 0)
        m_delayBefore = std::exchange(m_longestDelay, 0.0);
}

} // namespace faintline

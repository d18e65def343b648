#include "app/features/pictures/Playback.h"

#include "app/document/Document.h"
#include "inspect/straighten.h"
#include "signal/BandRecording.h"

#include <QActionGroup>

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    constexpr int interval = 33; // ms
    constexpr double toneHz = 700.0;
    constexpr double behindSeconds = 0.2;  // behind a live run, to absorb late deliveries
    constexpr double longestSeconds = 1e9; // long enough to play to the end
    constexpr double speeds[]{0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};

} // namespace

Playback::Playback(Document &document, ChooseEvent chooseEvent, QObject *parent)
    : QObject(parent), m_document(document), m_chooseEvent(std::move(chooseEvent))
{
    m_timer.setInterval(interval);
    connect(&m_timer, &QTimer::timeout, this, &Playback::follow);
    connect(&document, &Document::opened, this, &Playback::stop);
    connect(&m_line, &JobRunner::failed, this, [this](const Error &error) {
        emit failed(error);
        goOnSoundless();
    });
    addActions();
}

QAction *Playback::addChoice(QActionGroup *group, const QString &text, bool isChecked, std::function<void(bool)> choose)
{
    auto *action = new QAction(text, this);
    action->setCheckable(true);
    action->setChecked(isChecked);
    action->setActionGroup(group);
    connect(action, &QAction::triggered, this, std::move(choose));
    m_actions << action;
    return action;
}

void Playback::addActions()
{
    auto *whats = new QActionGroup(this), *rates = new QActionGroup(this);
    const auto addWhat = [&](const QString &text, What what) {
        return addChoice(whats, text, what == m_what, [this, what](bool) { setWhat(what); });
    };
    addWhat(tr("&Recording"), What::Recording);
    addWhat(tr("&Band of the box, or what is visible"), What::Band);
    m_lineAction = addWhat(tr("&Line of the event, or at the cursor, at 700 Hz"), What::Line);
    m_actions << nullptr;
    for (const double speed : speeds)
        addChoice(rates, tr("%1 × speed").arg(speed), speed == m_speed, [this, speed](bool) { setSpeed(speed); });
    m_actions << nullptr;
    addChoice(nullptr, tr("L&oop"), false, [this](bool isLooping) { setLooping(isLooping); });
}

void Playback::setWhat(What what)
{
    m_what = what;
    playOn();
}

void Playback::chooseLine()
{
    m_lineAction->trigger();
}

void Playback::setSpeed(double speed)
{
    m_speed = speed;
    playOn();
}

void Playback::setLooping(bool isLooping)
{
    m_isLooping = isLooping;
    playOn();
}

void Playback::playOn()
{
    if (m_liveChoice)
        startLive();
    else if (m_isPlaying && !start())
        stop();
}

/// The box, or else from the cursor, unless it is at the end, to the end of the visible part.
PlaySettings Playback::stretch() const
{
    const Viewport &viewport = m_document.viewport();
    const std::optional<Viewport::Box> box = m_document.box();
    const Span time = box ? box->time : viewport.time();
    PlaySettings settings;
    settings.fromSeconds = std::max(0.0, time.low);
    settings.toSeconds = std::min(m_document.recording()->info().durationSeconds(), time.high);
    settings.speed = m_speed;
    settings.loops = m_isLooping;
    settings.toneHz = m_what == What::Line ? toneHz : 0.0;
    const double nearEnd = settings.toSeconds - 0.01 * (settings.toSeconds - settings.fromSeconds);
    if (!m_isLooping && viewport.cursor() && viewport.cursor()->seconds > settings.fromSeconds
        && viewport.cursor()->seconds < nearEnd)
        settings.fromSeconds = viewport.cursor()->seconds;
    return settings;
}

FrequencyCurve Playback::lineAtCursor() const
{
    if (!m_document.viewport().cursor())
        throw Error(tr("Play").toStdString(), "requires an event to follow, or a cursor on the line");
    return FrequencyCurve({"time", "s", 0.0, 1.0, 1}, {m_document.viewport().cursor()->hz});
}

std::unique_ptr<Player> Playback::player(RecordingPointer what, int ofChannel) const
{
    return std::make_unique<Player>(std::move(what), ofChannel, stretch(), "default", tr("Play").toStdString());
}

std::unique_ptr<Player> Playback::playerOfLine(const FrequencyCurve &curve) const
{
    return player(lineToPlay(m_document.recording(), m_document.settings().selection.channel, curve), 0);
}

std::unique_ptr<Player> Playback::makePlayer() const
{
    if (m_what == What::Line)
        return playerOfLine(lineAtCursor());
    const RecordingPointer &recording = m_document.recording();
    const int channel = m_document.settings().selection.channel;
    if (m_what == What::Recording)
        return player(recording, channel);
    return player(std::make_shared<BandRecording>(recording, channel, band().low, band().high), 0);
}

Span Playback::band() const
{
    return m_document.box() ? m_document.box()->frequency : m_document.viewport().frequency();
}

/// A line is followed at the selected event's last frequency, or at the cursor; it may wander slightly.
Playback::LiveChoice Playback::liveChoice() const
{
    constexpr double stepHz = 20.0;
    if (m_what == What::Recording)
        return {};
    if (m_what == What::Band)
        return {m_what, band()};
    const std::optional<Event> event = m_chooseEvent();
    const auto &cursor = m_document.viewport().cursor();
    if (!event && !cursor && m_liveChoice && m_liveChoice->what == m_what)
        return *m_liveChoice;
    if (!event && !cursor)
        throw Error(tr("Play").toStdString(), "requires an event to follow, or a cursor on the line");
    const double hz = event ? event->position.back() : cursor->hz;
    const bool isNear = m_liveChoice && m_liveChoice->what == m_what && std::abs(m_liveChoice->band.low - hz) < stepHz;
    return isNear ? *m_liveChoice : LiveChoice{m_what, {hz, hz}};
}

std::unique_ptr<Player> Playback::makeLivePlayer() const
{
    const auto written = m_document.live().written;
    if (!written)
        throw Error(tr("Play").toStdString(), "requires that what is listened to is recorded");
    RecordingPointer recording = std::make_shared<HeardRecording>(written);
    int channel = m_document.settings().selection.channel;
    const double rate = recording->info().sampleRateHz;
    double reach = 0.0;
    if (m_liveChoice->what != What::Recording) {
        const Span band = m_liveChoice->band;
        recording = m_liveChoice->what == What::Band
                        ? std::make_shared<BandRecording>(recording, channel, band.low, band.high)
                        : lineToPlay(recording, channel, FrequencyCurve({"time", "s", 0.0, 1.0, 1}, {band.low}));
        channel = 0;
        reach = double(BandRecording::reachSamples) / rate;
    }
    PlaySettings settings;
    settings.endSeconds = [written, rate, reach] { return double(written->end()) / rate - reach; };
    settings.fromSeconds = std::max(0.0, settings.endSeconds() - behindSeconds);
    settings.toSeconds = settings.fromSeconds + longestSeconds;
    settings.toneHz = m_liveChoice->what == What::Line ? toneHz : 0.0;
    return std::make_unique<Player>(recording, channel, settings, "default", tr("Play").toStdString());
}

void Playback::setPlaying(bool isPlaying)
{
    if (m_isPlaying == isPlaying)
        return;
    m_isPlaying = isPlaying;
    emit playingChanged(isPlaying);
}

void Playback::silence()
{
    m_timer.stop();
    m_player.reset();
    m_line.cancel();
}

bool Playback::begin(const MakePlayer &make)
{
    try {
        m_player = make();
    } catch (const Error &error) {
        emit failed(error);
        return false;
    }
    m_timer.start();
    return true;
}

bool Playback::start()
{
    if (!m_document.recording() || m_document.viewport().isEmpty() || !(stretch().fromSeconds < stretch().toSeconds))
        return false;
    if (m_liveChoice)
        stop();
    silence();
    const std::optional<Event> event = m_what == What::Line ? m_chooseEvent() : std::nullopt;
    if (event && m_document.lineAnalysis()) {
        startAlong(m_document.lineAnalysis(), *event);
        return true;
    }
    if (beginRecording([this] { return makePlayer(); }))
        return true;
    stop();
    return false;
}

void Playback::startAlong(std::shared_ptr<const Analysis> analysis, const Event &event)
{
    m_line.start([this, analysis = std::move(analysis), event](const RunContext &) -> JobRunner::Delivery {
        return [this, curve = straightened(*analysis, event).curve] {
            if (!beginRecording([&] { return playerOfLine(curve); }))
                goOnSoundless();
        };
    });
    setPlaying(true);
}

bool Playback::beginRecording(const MakePlayer &make)
{
    if (!begin(make))
        return false;
    showPosition();
    setPlaying(true);
    return true;
}

bool Playback::startLive()
{
    if (!m_document.isLive())
        return false;
    silence();
    setPlaying(false);
    const bool wasHearing = m_liveChoice.has_value();
    const bool isHearing = begin([this] {
        m_liveChoice = liveChoice();
        return makeLivePlayer();
    });
    if (!isHearing)
        m_liveChoice.reset();
    if (isHearing != wasHearing)
        emit hearingChanged(isHearing);
    return isHearing;
}

/// Does not report an end, so that the window keeps showing that it plays.
void Playback::goOnSoundless()
{
    m_isPlaying = false;
    emit soundless();
}

void Playback::stop()
{
    silence();
    if (std::exchange(m_liveChoice, std::nullopt))
        emit hearingChanged(false);
    setPlaying(false);
}

void Playback::follow()
{
    if (const auto failure = m_player->failure()) {
        emit failed(Error(tr("Play").toStdString(), *failure, Error::Kind::Failure));
        return stop();
    }
    if (m_liveChoice)
        return followLive();
    if (m_player->isOver())
        return stop();
    const Viewport &viewport = m_document.viewport();
    viewport.cursor() && viewport.cursor()->seconds != m_shownSeconds ? playOn() : showPosition();
}

void Playback::followLive()
{
    if (!m_document.isLive())
        return stop();
    const LiveChoice wanted = liveChoice();
    if (std::exchange(m_wanted, wanted) == wanted
        && wanted != *m_liveChoice) // only once the choice is stable, not at every step of a zoom
        return playOn();
    const auto &written = *m_document.live().written;
    emit delayChanged(double(written.end()) / written.format().sampleRateHz - m_player->positionSeconds());
}

void Playback::showPosition()
{
    Viewport &viewport = m_document.viewport();
    const double hz = viewport.cursor() ? viewport.cursor()->hz : viewport.frequency().middle();
    const double seconds = m_player->positionSeconds();
    viewport.setCursor({seconds, hz});
    viewport.reveal({{seconds, seconds}, {hz, hz}});
    m_shownSeconds = viewport.cursor()->seconds;
}

} // namespace faintline

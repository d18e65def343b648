#pragma once

#include "analysis/Analysis.h"
#include "analysis/events.h"
#include "app/base/JobRunner.h"
#include "base/Error.h"
#include "live/Player.h"
#include "widgets/base/Span.h"

#include <QObject>
#include <QTimer>

#include <functional>
#include <memory>
#include <optional>

class QMenu;

namespace faintline {

class Document;

/// Plays what is looked at as sound, and has the cursor follow it: the measured box, or from the cursor to the end of what
/// is visible. Where the cursor is put meanwhile, it plays on from there.
///
/// Or plays what is listened to, as it comes: all of it, a band or a line, from the recording that is being written. The
/// cursor stays then, and how far the sound is behind is told.
class Playback : public QObject
{
    Q_OBJECT

public:
    enum class What {
        Recording, ///< all of it
        Band,      ///< of the box, or what is visible
        Line       ///< of the chosen event, or at the cursor, which is heard at 700 Hz
    };
    using ChooseEvent = std::function<std::optional<Event>()>;

    Playback(Document &document, ChooseEvent chooseEvent, QObject *parent = nullptr);

    /// What is played, how fast, and whether again and again.
    void addActionsTo(QMenu &menu);
    void setWhat(What what);
    void setSpeed(double speed);
    void setLooping(bool isLooping);

    /// From `start` on, also while the curve of an event's line is being computed, which sound waits for.
    bool isPlaying() const { return m_isPlaying; }
    /// Whether it plays; false, with `failed`, where no sound is to be had.
    bool start();
    /// The same of what is listened to.
    bool startLive();
    void stop();

signals:
    void playingChanged(bool isPlaying);
    void hearingChanged(bool isHearing); ///< what is listened to
    void delayChanged(double seconds);   ///< of it
    void failed(const faintline::Error &error);
    /// After `failed`, of what `start` had said yes to: the cursor may go on alone.
    void soundless();

private:
    /// What is played of a live run: a change of it begins anew.
    struct LiveChoice {
        What what = What::Recording;
        Span band; ///< of the box, or what is visible; of a line its frequency
        bool operator==(const LiveChoice &) const = default;
    };

    using MakePlayer = std::function<std::unique_ptr<Player>()>;

    LiveChoice liveChoice() const;
    std::unique_ptr<Player> makeLivePlayer() const;
    void followLive();
    Span band() const;
    PlaySettings stretch() const;
    std::unique_ptr<Player> player(RecordingPointer what, int ofChannel) const;
    std::unique_ptr<Player> playerOfLine(const FrequencyCurve &curve) const;
    std::unique_ptr<Player> makePlayer() const;
    FrequencyCurve lineAtCursor() const;
    void startAlong(std::shared_ptr<const Analysis> analysis, const Event &event);
    bool beginRecording(const MakePlayer &make);
    bool begin(const MakePlayer &make);
    void silence();
    void setPlaying(bool isPlaying);
    void goOnSoundless();
    void follow();
    void showPosition();
    void playOn();

    Document &m_document;
    ChooseEvent m_chooseEvent;
    What m_what = What::Recording;
    double m_speed = 1.0;
    bool m_isLooping = false;
    std::unique_ptr<Player> m_player;
    std::optional<LiveChoice> m_liveChoice; ///< none: what is played is no live run
    LiveChoice m_wanted;
    double m_shownSeconds = 0.0; ///< where the cursor was put last
    bool m_isPlaying = false;
    QTimer m_timer;
    JobRunner m_line; ///< computes the curve of an event's line; last, so that it ends first
};

} // namespace faintline

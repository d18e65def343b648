#pragma once

#include "analyse/events.h"
#include "app/base/JobRunner.h"
#include "base/Error.h"
#include "live/Player.h"
#include "plan/Analysis.h"
#include "widgets/base/Span.h"

#include <QList>
#include <QObject>
#include <QTimer>

#include <functional>
#include <memory>
#include <optional>

class QAction;
class QActionGroup;

namespace faintline {

class Document;

/// Plays the displayed recording as sound, with the cursor following: the measured box, or from the cursor to the end
/// of the visible part. If the cursor is moved, playback continues from there.
///
/// Also plays a live run: all of it, a band or a line, from the recording in progress. The cursor then stays where it
/// is, and the delay of the sound is reported.
class Playback : public QObject
{
    Q_OBJECT

public:
    enum class What {
        Recording, ///< the whole band
        Band,      ///< of the box, or else the visible band
        Line       ///< of the selected event, or at the cursor; heard at 700 Hz
    };
    using ChooseEvent = std::function<std::optional<Event>()>;

    Playback(Document &document, ChooseEvent chooseEvent, QObject *parent = nullptr);

    /// Select what is played, how fast, and whether in a loop; null: a separator.
    const QList<QAction *> &actions() const { return m_actions; }
    void setWhat(What what);
    void chooseLine(); ///< as its action does
    void setSpeed(double speed);
    void setLooping(bool isLooping);

    /// True from `start` on, including while sound waits for the curve of an event's line to be computed.
    bool isPlaying() const { return m_isPlaying || m_liveChoice; }
    /// Returns false and emits `failed` if no sound is available.
    bool start();
    /// The same for the live run.
    bool startLive();
    void stop();

signals:
    void playingChanged(bool isPlaying);
    void hearingChanged(bool isHearing); ///< the live run
    void delayChanged(double seconds);   ///< of the live run
    void failed(const faintline::Error &error);
    /// Emitted after `failed` if `start` had returned true: the cursor may continue without sound.
    void soundless();

private:
    QAction *addChoice(QActionGroup *group, const QString &text, bool isChecked, std::function<void(bool)> choose);
    void addActions();

    /// What is played of a live run; a change restarts playback.
    struct LiveChoice {
        What what = What::Recording;
        Span band; ///< of the box, or else the visible one; for a line, its frequency
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
    QList<QAction *> m_actions;
    QAction *m_lineAction = nullptr;
    What m_what = What::Recording;
    double m_speed = 1.0;
    bool m_isLooping = false;
    std::unique_ptr<Player> m_player;
    std::optional<LiveChoice> m_liveChoice; ///< empty: not playing a live run
    LiveChoice m_wanted;
    double m_shownSeconds = 0.0; ///< last cursor position set
    bool m_isPlaying = false;
    QTimer m_timer;
    JobRunner m_line; ///< computes the curve of an event's line; last, so that it ends first
};

} // namespace faintline

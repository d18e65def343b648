#pragma once

#include "analysis/Analysis.h"
#include "analysis/events.h"
#include "app/base/JobRunner.h"
#include "base/Error.h"
#include "live/Player.h"

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
    void stop();

signals:
    void playingChanged(bool isPlaying);
    void failed(const faintline::Error &error);
    /// After `failed`, of what `start` had said yes to: the cursor may go on alone.
    void soundless();

private:
    PlaySettings stretch() const;
    using MakePlayer = std::function<std::unique_ptr<Player>()>;

    std::unique_ptr<Player> player(RecordingPointer what, int ofChannel) const;
    std::unique_ptr<Player> playerOfLine(const FrequencyCurve &curve) const;
    std::unique_ptr<Player> makePlayer() const;
    FrequencyCurve lineAtCursor() const;
    void startAlong(std::shared_ptr<const Analysis> analysis, const Event &event);
    bool begin(const MakePlayer &make);
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
    double m_shownSeconds = 0.0; ///< where the cursor was put last
    bool m_isPlaying = false;
    QTimer m_timer;
    JobRunner m_line; ///< computes the curve of an event's line; last, so that it ends first
};

} // namespace faintline

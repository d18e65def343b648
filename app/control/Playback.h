#pragma once

#include "analysis/events.h"
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

    bool isPlaying() const { return m_player != nullptr; }
    /// Whether sound was begun; false, with `failed`, where there is none to be had.
    bool start();
    void stop();

signals:
    void playingChanged(bool isPlaying);
    void failed(const faintline::Error &error);

private:
    PlaySettings stretch() const;
    std::unique_ptr<Player> makePlayer() const;
    FrequencyCurve line() const;
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
    QTimer m_timer;
};

} // namespace faintline

#pragma once

#include <QObject>
#include <QTimer>

#include <chrono>

namespace faintline {

/// Plays frames forwards or backwards: asks for a step at regular intervals while it is on.
class FramePlayer : public QObject
{
    Q_OBJECT

public:
    explicit FramePlayer(std::chrono::milliseconds interval, QObject *parent = nullptr);

    bool isPlaying() const { return m_timer.isActive(); }
    void setPlaying(bool isPlaying);
    /// Also stops forward playing.
    void setPlayingBackward(bool isPlaying);

signals:
    void stepRequested(int direction); ///< 1 or -1
    void playingChanged(bool isPlaying);

private:
    void start(int step);

    int m_step = 1;
    QTimer m_timer;
};

} // namespace faintline

#include "app/workspace/PingPlayer.h"

namespace faintline {

PingPlayer::PingPlayer(QObject *parent) : QObject(parent)
{
    constexpr int interval = 200; // ms per ping
    m_timer.setInterval(interval);
    connect(&m_timer, &QTimer::timeout, this, [this] { emit stepRequested(m_step); });
}

void PingPlayer::start(int step)
{
    m_step = step;
    m_timer.start();
    emit playingChanged(true);
}

void PingPlayer::setPlaying(bool isPlaying)
{
    if (isPlaying == m_timer.isActive())
        return;
    if (isPlaying)
        return start(1);
    m_timer.stop();
    emit playingChanged(false);
}

void PingPlayer::setPlayingBackward(bool isPlaying)
{
    setPlaying(false);
    if (isPlaying)
        start(-1);
}

} // namespace faintline

#include "app/features/pictures/FramePlayer.h"

namespace faintline {

FramePlayer::FramePlayer(std::chrono::milliseconds interval, QObject *parent) : QObject(parent)
{
    m_timer.setInterval(interval);
    connect(&m_timer, &QTimer::timeout, this, [this] { emit stepRequested(m_step); });
}

void FramePlayer::start(int step)
{
    m_step = step;
    m_timer.start();
    emit playingChanged(true);
}

void FramePlayer::setPlaying(bool isPlaying)
{
    if (isPlaying == m_timer.isActive())
        return;
    if (isPlaying)
        return start(1);
    m_timer.stop();
    emit playingChanged(false);
}

void FramePlayer::setPlayingBackward(bool isPlaying)
{
    setPlaying(false);
    if (isPlaying)
        start(-1);
}

} // namespace faintline

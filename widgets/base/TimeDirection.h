#pragma once

#include <QObject>

namespace faintline {

/// How time runs on pictures that turn together. On a map of a ping, the first of its axes takes the place of time.
class TimeDirection : public QObject
{
    Q_OBJECT

public:
    enum class Orientation { NewestOnTop, OldestOnTop, LeftToRight };
    Q_ENUM(Orientation)

    explicit TimeDirection(Orientation orientation = Orientation::NewestOnTop, QObject *parent = nullptr)
        : QObject(parent), m_orientation(orientation)
    {
    }

    Orientation orientation() const { return m_orientation; }
    bool isVertical() const { return m_orientation != Orientation::LeftToRight; }

    void set(Orientation orientation)
    {
        if (orientation == m_orientation)
            return;
        m_orientation = orientation;
        emit changed();
    }
    void cycle() { set(static_cast<Orientation>((int(m_orientation) + 1) % 3)); }

signals:
    void changed();

private:
    Orientation m_orientation;
};

} // namespace faintline

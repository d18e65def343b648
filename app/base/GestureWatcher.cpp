#include "app/base/GestureWatcher.h"

#include <QCoreApplication>
#include <QKeyEvent>

#include <utility>

namespace faintline {

namespace {

    /// Pressed while something else is done, to change what that does.
    bool isModifier(const QKeyEvent &event)
    {
        switch (event.key()) {
        case Qt::Key_Shift:
        case Qt::Key_Control:
        case Qt::Key_Alt:
        case Qt::Key_Meta:
        case Qt::Key_AltGr:
            return true;
        default:
            return false;
        }
    }

    /// A key by its place on the keyboard: with Shift let go first, the release of "!" is that of "1".
    int keyOf(const QKeyEvent &event)
    {
        return event.nativeScanCode() != 0 ? int(event.nativeScanCode()) : event.key();
    }

    int buttonOf(const QEvent &event)
    {
        return -int(static_cast<const QMouseEvent &>(event).button());
    }

} // namespace

GestureWatcher::GestureWatcher(QObject *parent) : QObject(parent)
{
    QCoreApplication::instance()->installEventFilter(this);
}

/// What one widget leaves to its parent, or a shortcut to its widget, comes again and is still the same press.
void GestureWatcher::press(int what)
{
    if (std::exchange(m_isWheel, false) || m_down != what)
        begin();
    m_down = what;
}

void GestureWatcher::release(int what)
{
    if (what == m_down)
        endLater();
}

void GestureWatcher::begin()
{
    ++m_number;
    emit began();
}

/// Handlers of the release still belong to the gesture. A press before they have run begins the next gesture.
void GestureWatcher::endLater()
{
    m_down = 0;
    m_isWheel = false;
    const auto end = [this, number = m_number] {
        if (number == m_number)
            emit ended();
    };
    QMetaObject::invokeMethod(this, end, Qt::QueuedConnection);
}

bool GestureWatcher::eventFilter(QObject *watched, QEvent *event)
{
    switch (event->type()) {
    case QEvent::ShortcutOverride: // a key that is a shortcut comes as nothing else
    case QEvent::KeyPress:
        if (const auto &key = static_cast<QKeyEvent &>(*event); !key.isAutoRepeat() && !isModifier(key))
            press(keyOf(key));
        break;
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
        press(buttonOf(*event));
        break;
    case QEvent::KeyRelease:
        if (const auto &key = static_cast<QKeyEvent &>(*event); !key.isAutoRepeat())
            release(keyOf(key));
        break;
    case QEvent::MouseButtonRelease:
        release(buttonOf(*event));
        break;
    case QEvent::ApplicationDeactivate: // the release goes to another application
        endLater();
        break;
    case QEvent::Wheel:
        if (!std::exchange(m_isWheel, true))
            begin();
        break;
    default:
        break;
    }
    return QObject::eventFilter(watched, event);
}

} // namespace faintline

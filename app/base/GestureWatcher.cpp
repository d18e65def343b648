#include "app/base/GestureWatcher.h"

#include <QCoreApplication>
#include <QKeyEvent>

#include <utility>

namespace faintline {

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

void GestureWatcher::begin()
{
    ++m_number;
    emit began();
}

/// Who handles the release still belongs to the gesture. A press that comes before is the beginning of the next one.
void GestureWatcher::endLater()
{
    m_down = 0;
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
        if (const auto *key = static_cast<QKeyEvent *>(event); !key->isAutoRepeat())
            press(key->key());
        break;
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
        press(-int(static_cast<QMouseEvent *>(event)->button()));
        break;
    case QEvent::KeyRelease:
        if (!static_cast<QKeyEvent *>(event)->isAutoRepeat())
            endLater();
        break;
    case QEvent::MouseButtonRelease:
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

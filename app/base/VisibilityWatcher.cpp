#include "app/base/VisibilityWatcher.h"

#include <QEvent>
#include <QWidget>

namespace faintline {

bool isInSight(const QWidget &widget)
{
    QRect seen = widget.rect();
    for (const QWidget *one = &widget; !one->isWindow() && one->parentWidget(); one = one->parentWidget())
        seen = seen.translated(one->pos()) & one->parentWidget()->rect();
    return widget.isVisible() && !seen.isEmpty();
}

VisibilityWatcher::VisibilityWatcher(QWidget &panel) : QObject(&panel), m_panel(panel)
{
    watch();
}

bool VisibilityWatcher::isOn() const
{
    return isInSight(m_panel);
}

void VisibilityWatcher::watch()
{
    for (QWidget *one : m_watched)
        one->removeEventFilter(this);
    m_watched.clear();
    for (QWidget *one = &m_panel; one; one = one->parentWidget()) {
        one->installEventFilter(this);
        m_watched << one;
    }
}

void VisibilityWatcher::look()
{
    const bool isNow = isOn();
    if (isNow == m_wasOn)
        return;
    m_wasOn = isNow;
    if (isNow)
        emit came();
}

bool VisibilityWatcher::eventFilter(QObject *watched, QEvent *event)
{
    switch (event->type()) {
    case QEvent::ParentChange:
        watch();
        [[fallthrough]];
    case QEvent::Show:
    case QEvent::Hide:
    case QEvent::Move:
    case QEvent::Resize:
        look();
        QMetaObject::invokeMethod(this, &VisibilityWatcher::look,
                                  Qt::QueuedConnection); // again, once everything is where it goes
        break;
    default:
        break;
    }
    return QObject::eventFilter(watched, event);
}

} // namespace faintline

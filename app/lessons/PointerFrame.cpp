#include "app/lessons/PointerFrame.h"

#include "app/base/VisibilityWatcher.h"
#include "widgets/base/Theme.h"

#include <QAbstractScrollArea>
#include <QEvent>
#include <QPainter>

namespace faintline {

namespace {

    constexpr int lineWidth = 3;
    constexpr int room = 4; ///< between the framed widget and the frame's outer edge

} // namespace

PointerFrame::PointerFrame(QWidget *window) : QWidget(window)
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    window->installEventFilter(this); // its layout brings its own to the front
    hide();
}

void PointerFrame::pointAt(QWidget *target)
{
    for (QWidget *each = m_target; each && each != parentWidget(); each = each->parentWidget())
        each->removeEventFilter(this);
    m_target = target;
    for (QWidget *each = m_target; each && each != parentWidget(); each = each->parentWidget())
        each->installEventFilter(this);
    follow();
}

void PointerFrame::follow()
{
    const bool isThere = m_target && m_target->window() == window() && isInSight(*m_target);
    setVisible(isThere);
    if (!isThere)
        return;
    QRect round = QRect(m_target->mapTo(parentWidget(), QPoint()), m_target->size()).adjusted(-room, -room, room, room);
    for (QWidget *around = m_target->parentWidget(); around && around != parentWidget();
         around = around->parentWidget())
        if (const auto *area =
                qobject_cast<QAbstractScrollArea *>(around)) // limited to the visible part of a scrolling form
            round &= QRect(area->viewport()->mapTo(parentWidget(), QPoint()), area->viewport()->size());
    setGeometry(round.intersected(parentWidget()->rect()));
    raise();
}

void PointerFrame::paintEvent(QPaintEvent *)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const double half = 0.5 * lineWidth;
    painter.setPen(QPen(Theme::colours(*this).accent, lineWidth));
    painter.drawRoundedRect(QRectF(rect()).adjusted(half, half, -half, -half), 4.0, 4.0);
}

bool PointerFrame::eventFilter(QObject *watched, QEvent *event)
{
    switch (event->type()) {
    case QEvent::Resize:
    case QEvent::Move:
    case QEvent::Show:
    case QEvent::Hide:
    case QEvent::ParentChange:
    case QEvent::LayoutRequest:
        QMetaObject::invokeMethod(this, &PointerFrame::follow, Qt::QueuedConnection); // after the layout has been
                                                                                      // applied
        break;
    default:
        break;
    }
    return QWidget::eventFilter(watched, event);
}

} // namespace faintline

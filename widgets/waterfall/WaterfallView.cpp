#include "widgets/waterfall/WaterfallView.h"

#include "widgets/waterfall/WaterfallMouse.h"
#include "widgets/waterfall/waterfallCommands.h"

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QWheelEvent>

namespace faintline {

WaterfallView::WaterfallView(const QString &heading, PictureDisplay *display, TimeDirection *direction)
    : MarkedWaterfall(heading, display, direction), m_mouse(std::make_unique<WaterfallMouse>(*this))
{
}

WaterfallView::~WaterfallView() = default;

void WaterfallView::wheelEvent(QWheelEvent *event)
{
    event->setAccepted(picture() && viewport());
    if (event->isAccepted())
        m_mouse->turnWheel(*event);
}

void WaterfallView::keyPressEvent(QKeyEvent *event)
{
    if (!pressKey(*this, *event))
        MarkedWaterfall::keyPressEvent(event);
}

void WaterfallView::contextMenuEvent(QContextMenuEvent *event)
{
    if (!picture() || !viewport())
        return;
    const Viewport::Point point = pointAt(canvas()->mapFrom(this, event->pos()));
    QMenu menu(this);
    addCommands(menu, *this);
    emit contextMenuRequested(&menu, point.seconds, point.hz);
    menu.exec(event->globalPos());
}

} // namespace faintline

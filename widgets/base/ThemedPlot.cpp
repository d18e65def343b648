#include "widgets/base/ThemedPlot.h"

#include "widgets/base/Theme.h"

#include <qwt_text.h>

#include <QEvent>

namespace faintline {

ThemedPlot::ThemedPlot(QWidget *parent) : QwtPlot(parent)
{
    QwtText::setTextEngine(QwtText::RichText, nullptr); // names and units come from files; their tags must be shown as
                                                        // text
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    canvas()->setFocusPolicy(Qt::NoFocus);
    canvas()->installEventFilter(this);
}

ThemedPlot::~ThemedPlot()
{
    canvas()->removeEventFilter(this); // the canvas outlives objects that the filter uses
}

void ThemedPlot::setSideRooms(int left, int right)
{
    const QMargins rooms(left, 0, right, 0);
    if (rooms == m_sideRooms)
        return;
    m_sideRooms = rooms;
    restyle();
    updateLayout();
}

void ThemedPlot::setTimeLabels(bool isOn)
{
    if (isOn == m_hasTimeLabels)
        return;
    m_hasTimeLabels = isOn;
    updateGeometry();
    restyle();
    updateLayout();
}

void ThemedPlot::changeEvent(QEvent *event)
{
    QwtPlot::changeEvent(event);
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::StyleChange)
        restyle();
}

void ThemedPlot::focusInEvent(QFocusEvent *event)
{
    QwtPlot::focusInEvent(event);
    Theme::frame(*this);
}

void ThemedPlot::focusOutEvent(QFocusEvent *event)
{
    QwtPlot::focusOutEvent(event);
    Theme::frame(*this);
}

bool ThemedPlot::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == canvas() && event->type() == QEvent::Resize)
        followCanvas();
    return QwtPlot::eventFilter(watched, event);
}

} // namespace faintline

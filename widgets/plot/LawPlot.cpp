#include "widgets/plot/LawPlot.h"

#include "model/transitionLaw.h"
#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"

#include <qwt_plot_item.h>
#include <qwt_scale_map.h>

#include <QFontMetricsF>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double barWidth = 0.8; // relative to the place
    constexpr double highest = 1.12; // of the ordinate, to leave room for a number above a bar of 1

    double heightOf(const std::vector<double> &law, int change)
    {
        const auto i = std::size_t(std::abs(change));
        return i < law.size() ? law[i] : 0.0;
    }

} // namespace

/// Paints the bars, a drag handle on each, and their heights in numbers if there is room.
class LawPlot::BarItem : public QwtPlotItem
{
public:
    explicit BarItem(const LawPlot &owner) : m_owner(owner) { setZ(20.0); }

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap, const QRectF &) const override
    {
        const Theme::Colours &colours = Theme::colours(m_owner);
        painter->save();
        painter->setFont(Theme::plotFont());
        const QFontMetricsF metrics(painter->font());
        const double place = xMap.transform(1.0) - xMap.transform(0.0);
        for (int change = -m_owner.reach(); change <= m_owner.reach(); ++change) {
            const double h = heightOf(m_owner.law(), change);
            const QRectF bar = QRectF(QPointF(xMap.transform(change - 0.5 * barWidth), yMap.transform(h)),
                                      QPointF(xMap.transform(change + 0.5 * barWidth), yMap.transform(0.0)))
                                   .normalized();
            const bool isChosen = m_owner.m_isEditable && std::abs(change) == m_owner.m_selected;
            QColor colour = isChosen ? colours.accent : colours.curves[0];
            if (!m_owner.m_isEditable)
                colour.setAlpha(130);
            painter->fillRect(bar, colour);
            if (m_owner.m_isEditable)
                painter->fillRect(QRectF(bar.left(), bar.top() - 1.0, bar.width(), 3.0),
                                  isChosen ? colours.text : colour);
            constexpr double gap = 5.0;
            const auto fits = [&](const QString &words) { return metrics.horizontalAdvance(words) + gap <= place; };
            const QString words = fits(numberText(h, 3)) ? numberText(h, 3) : numberText(h, 2);
            if (!fits(words))
                continue;
            painter->setPen(colours.text);
            painter->drawText(
                QRectF(bar.center().x() - 0.5 * place, bar.top() - metrics.height() - 2.0, place, metrics.height()),
                Qt::AlignCenter, words);
        }
        painter->restore();
    }

private:
    const LawPlot &m_owner;
};

LawPlot::LawPlot(QWidget *parent) : MarkedPlot(parent), m_item(new BarItem(*this))
{
    m_item->attach(this);
    setEmpty(false);
    layOut();
}

int LawPlot::reach() const
{
    const int known = int(std::max(m_law.size(), m_shown.size())) - 1;
    return std::min(m_isEditable ? known + 1 : known, std::max(m_mostChange, known));
}

void LawPlot::setLaw(const std::vector<double> &law, int mostChange)
{
    m_isDragging = false;
    m_law = m_shown = law;
    m_mostChange = mostChange;
    m_selected = std::min(m_selected, reach());
    layOut();
}

void LawPlot::setEditable(bool isEditable)
{
    m_isEditable = isEditable;
    canvas()->setCursor(isEditable ? Qt::SizeVerCursor : Qt::ArrowCursor);
    layOut();
}

void LawPlot::layOut()
{
    setSpans({-reach() - 0.6, reach() + 0.6}, {0.0, highest});
    setAccessibleDescription(tr("h(%1) = %2").arg(m_selected).arg(numberText(heightOf(m_shown, m_selected), 3)));
}

void LawPlot::restyle()
{
    MarkedPlot::restyle();
    replot();
}

void LawPlot::select(int change)
{
    m_selected = std::clamp(std::abs(change), 0, reach());
    layOut();
}

void LawPlot::drag(double y)
{
    m_shown = withProbability(m_law, std::size_t(m_selected), y + m_grip);
    layOut();
    emit lawDragged(m_shown);
}

void LawPlot::drop(bool isWanted)
{
    m_isDragging = false;
    if (isWanted && m_shown != m_law) {
        emit lawRequested(m_shown);
        return;
    }
    m_shown = m_law;
    layOut();
    emit lawDragged(m_shown);
}

void LawPlot::keyPressEvent(QKeyEvent *event)
{
    if (m_isDragging && event->key() == Qt::Key_Escape)
        return drop(false);
    if (!m_isEditable)
        return MarkedPlot::keyPressEvent(event);
    const auto step = [&](double sign) {
        const double size = event->modifiers() & Qt::ShiftModifier     ? 0.1
                            : event->modifiers() & Qt::ControlModifier ? 0.001
                                                                       : 0.01;
        const double before = heightOf(m_law, m_selected);
        // Rounded to whole steps, so that up and down are inverse.
        const double after =
            std::clamp(std::round((before + sign * size) / size) * size, 0.0, m_selected == 0 ? 1.0 : 0.5);
        m_shown = withProbability(m_law, std::size_t(m_selected), after);
        drop(true);
    };
    switch (event->key()) {
    case Qt::Key_Left:
        return select(m_selected - 1 < 0 ? 0 : m_selected - 1);
    case Qt::Key_Right:
        return select(m_selected + 1);
    case Qt::Key_Up:
        return step(1.0);
    case Qt::Key_Down:
        return step(-1.0);
    default:
        MarkedPlot::keyPressEvent(event);
    }
}

void LawPlot::focusInEvent(QFocusEvent *event)
{
    MarkedPlot::focusInEvent(event);
    replot();
}

void LawPlot::focusOutEvent(QFocusEvent *event)
{
    if (m_isDragging)
        drop(false);
    MarkedPlot::focusOutEvent(event);
    replot();
}

bool LawPlot::eventFilter(QObject *watched, QEvent *event)
{
    const bool isHandled = MarkedPlot::eventFilter(watched, event);
    if (watched != canvas() || !m_isEditable)
        return isHandled;
    const auto yAt = [&] { return invTransform(QwtAxis::YLeft, static_cast<QMouseEvent *>(event)->position().y()); };
    if (event->type() == QEvent::MouseButtonPress && static_cast<QMouseEvent *>(event)->button() == Qt::LeftButton) {
        const double x = invTransform(QwtAxis::XBottom, static_cast<QMouseEvent *>(event)->position().x());
        select(int(std::lround(x)));
        m_isDragging = true;
        m_grip = heightOf(m_law, m_selected) - yAt(); // avoids a jump of the bar to the pointer
    } else if (event->type() == QEvent::MouseMove && m_isDragging) {
        drag(yAt());
    } else if (event->type() == QEvent::MouseButtonRelease && m_isDragging) {
        drop(true);
    }
    return isHandled;
}

} // namespace faintline

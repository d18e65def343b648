#include "widgets/plot/MarkedPlot.h"

#include "widgets/base/CanvasSentence.h"
#include "widgets/base/Theme.h"
#include "widgets/base/scaleTicks.h"
#include "widgets/base/textPlate.h"
#include "widgets/plot/NumberScaleDraw.h"

#include <qwt_plot_grid.h>
#include <qwt_plot_item.h>
#include <qwt_scale_map.h>

#include <QFontMetricsF>
#include <QMouseEvent>
#include <QPainter>
#include <QScopedValueRollback>

#include <algorithm>
#include <cmath>

namespace faintline {

/// Paints marks and cursor.
class MarkedPlot::MarkItem : public QwtPlotItem
{
public:
    explicit MarkItem(const MarkedPlot &owner) : m_owner(owner) { setZ(40.0); }

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap, const QRectF &canvas) const override
    {
        const Theme::Colours &colours = Theme::colours(m_owner);
        painter->save();
        painter->setFont(Theme::plotTitleFont());
        double row =
            canvas.top() + m_owner.m_marksTop; // texts of upright lines, each a row lower, so that they do not overlap
        for (const Mark &mark : m_owner.marks()) {
            painter->setPen(QPen(mark.isUpright ? colours.text : colours.threshold, 1.2,
                                 mark.isUpright ? Qt::DashLine : Qt::SolidLine));
            const QFontMetricsF metrics(painter->font());
            const QString words = metrics.elidedText(mark.words, Qt::ElideRight, canvas.width() - 12.0);
            const QSizeF size = metrics.size(0, words) + QSizeF(8.0, 2.0);
            QRectF box(QPointF(), size);
            if (mark.isUpright) {
                const double x = xMap.transform(mark.at);
                painter->drawLine(QPointF(x, canvas.top()), QPointF(x, canvas.bottom()));
                const bool isLeft = x + size.width() + 4.0 > canvas.right();
                box.moveTopLeft({isLeft ? std::max(canvas.left(), x - size.width() - 2.0) : x + 2.0, row});
                row += size.height() + 1.0;
            } else {
                const double y = yMap.transform(mark.at);
                painter->drawLine(QPointF(canvas.left(), y), QPointF(canvas.right(), y));
                box.moveTopLeft(
                    {canvas.right() - size.width() - 3.0, mark.isAbove ? y - size.height() - 1.0 : y + 1.0});
            }
            if (words.isEmpty())
                continue;
            QColor plate = colours.canvas;
            plate.setAlpha(215);
            drawOnPlate(*painter, box, words, mark.isUpright ? colours.text : colours.threshold, plate);
        }
        if (m_owner.cursor()) {
            const double x = xMap.transform(*m_owner.cursor());
            painter->setPen(QPen(colours.accent, 1.4));
            painter->drawLine(QPointF(x, canvas.top()), QPointF(x, canvas.bottom()));
        }
        painter->restore();
    }

private:
    const MarkedPlot &m_owner;
};

MarkedPlot::MarkedPlot(QWidget *parent)
    : ThemedPlot(parent), m_grid(new QwtPlotGrid), m_markItem(new MarkItem(*this)), m_sentence(new CanvasSentence)
{
    m_grid->attach(this);
    m_markItem->attach(this);
    m_sentence->attach(this);
    setAxisScaleDraw(QwtAxis::XBottom, new NumberScaleDraw);
    setAxisScaleDraw(QwtAxis::YLeft, new NumberScaleDraw);
    MarkedPlot::restyle();
    setEmpty(true);
}

void MarkedPlot::setTitles(const QString &x, const QString &y)
{
    setAxisTitle(QwtAxis::XBottom, x);
    setAxisTitle(QwtAxis::YLeft, y);
    Theme::style(*this);
}

void MarkedPlot::setSpans(const Span &x, const Span &y)
{
    m_x = x;
    m_y = y;
    layAxes();
}

void MarkedPlot::layAxes()
{
    const QSize size = canvas()->contentsRect().size();
    QwtScaleDiv x = linearScaleDiv(m_x, std::clamp(std::min(size.width() / 50, int(m_x.width())), 1, 12));
    QList<double> numbers = x.ticks(QwtScaleDiv::MajorTick);
    if (numbers.isEmpty()) // a single place, for which the step is too wide
        numbers << std::ceil(m_x.low);
    if (numbers.size() == 1 || majorStep(x) <= 1.0) // integers have no minor ticks
        x = QwtScaleDiv(m_x.low, m_x.high, {}, {}, numbers);
    setAxisScaleDiv(QwtAxis::XBottom, x);
    setAxisScaleDiv(QwtAxis::YLeft, linearScaleDiv(m_y, std::clamp(size.height() / 30, 2, 10)));
    replot();
}

void MarkedPlot::setMarks(std::vector<Mark> marks)
{
    if (marks == m_marks)
        return;
    m_marks = std::move(marks);
    replot();
}

void MarkedPlot::setCursor(std::optional<double> x)
{
    if (x == m_cursorAt)
        return;
    m_cursorAt = x;
    replot();
}

void MarkedPlot::setEmptySentence(const QString &sentence)
{
    m_sentence->text = sentence;
    replot();
}

void MarkedPlot::setEmpty(bool isEmpty)
{
    m_sentence->setVisible(isEmpty);
    m_grid->setVisible(!isEmpty);
    m_markItem->setVisible(!isEmpty);
    setAxisVisible(QwtAxis::XBottom, !isEmpty);
    setAxisVisible(QwtAxis::YLeft, !isEmpty);
    replot();
}

QPointF MarkedPlot::canvasPosition(double x, double y) const
{
    return {transform(QwtAxis::XBottom, x), transform(QwtAxis::YLeft, y)};
}

void MarkedPlot::restyle()
{
    const Theme::Colours &colours = Theme::colours(*this);
    Theme::style(*this);
    m_grid->setPen(colours.grid, 1.0);
    m_sentence->colour = colours.faintText;
    replot();
}

void MarkedPlot::clicked(const QPointF &canvas)
{
    emit activated(invTransform(QwtAxis::XBottom, canvas.x()), invTransform(QwtAxis::YLeft, canvas.y()));
}

bool MarkedPlot::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == canvas()) {
        constexpr int mostTries = 3; // ticks need width, and width decides on ticks
        if (event->type() == QEvent::Resize && m_resizing < mostTries) {
            const QScopedValueRollback nested(m_resizing, m_resizing + 1);
            layAxes();
        }
        if (event->type() == QEvent::MouseButtonPress) {
            const auto *mouse = static_cast<QMouseEvent *>(event);
            if (mouse->button() == Qt::LeftButton) {
                setFocus(Qt::MouseFocusReason);
                clicked(mouse->position());
            }
        }
    }
    return QwtPlot::eventFilter(watched, event);
}

} // namespace faintline

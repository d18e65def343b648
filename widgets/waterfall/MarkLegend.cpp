#include "widgets/waterfall/MarkLegend.h"

#include "widgets/base/Theme.h"

#include <QEvent>
#include <QPainter>

#include <cmath>
#include <vector>

namespace faintline {

namespace {

    constexpr double swatchWidth = 26.0, swatchHeight = 12.0, betweenMarks = 14.0, besideSwatch = 5.0;

    struct NamedMark {
        QString name;
        QColor colour;
        Qt::PenStyle style;
        double width;
    };

    std::vector<NamedMark> namedMarks(const Theme::Colours &colours)
    {
        return {{MarkLegend::tr("track"), colours.track, Qt::SolidLine, 1.0},
                {MarkLegend::tr("selected"), colours.selectedEvent, Qt::SolidLine, 2.0},
                {MarkLegend::tr("raised level"), colours.track, Qt::DotLine, 1.0},
                {MarkLegend::tr("truth"), colours.truth, Qt::DashLine, 1.0}};
    }

} // namespace

MarkLegend::MarkLegend(QWidget *parent) : QLabel(parent)
{
    setToolTip(tr("Track: a line that was found. Selected: the event of the list. Raised level: an area without a "
                  "line. Truth: what was simulated, or is known."));
    setAccessibleName(tr("Marks in the pictures"));
    drawMarks();
}

void MarkLegend::changeEvent(QEvent *event)
{
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::StyleChange)
        drawMarks();
    QLabel::changeEvent(event);
}

void MarkLegend::drawMarks()
{
    setFont(Theme::plotFont());
    const std::vector<NamedMark> marks = namedMarks(Theme::colours(*this));
    double whole = 0.0;
    for (const NamedMark &mark : marks)
        whole += betweenMarks + swatchWidth + besideSwatch + fontMetrics().horizontalAdvance(mark.name);
    const double ratio = devicePixelRatioF();
    QPixmap picture(QSizeF(std::ceil(whole + betweenMarks), fontMetrics().height() + 2).toSize() * ratio);
    picture.setDevicePixelRatio(ratio);
    picture.fill(Qt::transparent);
    QPainter painter(&picture);
    painter.setFont(font());
    const double height = picture.deviceIndependentSize().height();
    double x = 0.0;
    for (const NamedMark &mark : marks) {
        x += betweenMarks;
        const QRectF swatch(x, std::floor(0.5 * (height - swatchHeight)), swatchWidth, swatchHeight);
        painter.fillRect(swatch, Theme::colours(*this).picture);
        painter.setPen(QPen(mark.colour, mark.width, mark.style));
        painter.drawLine(QPointF(swatch.left(), swatch.center().y()), QPointF(swatch.right(), swatch.center().y()));
        x = swatch.right() + besideSwatch;
        painter.setPen(palette().color(QPalette::WindowText));
        const double width = fontMetrics().horizontalAdvance(mark.name);
        painter.drawText(QRectF(x, 0.0, width + 1.0, height), Qt::AlignVCenter | Qt::AlignLeft, mark.name);
        x += width;
    }
    setPixmap(picture);
}

} // namespace faintline

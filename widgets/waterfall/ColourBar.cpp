#include "widgets/waterfall/ColourBar.h"

#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"
#include "widgets/base/scaleTicks.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QFontMetricsF>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double histogramWidth = 10.0;
    constexpr double leftMargin = 2.0;
    constexpr double barWidth = 13.0;
    constexpr double topMargin = 26.0; ///< unit and half a label
    constexpr double bottomMargin = 12.0;
    constexpr double gripReach = 7.0;
    constexpr double smallestRange = 0.5;
    constexpr double tickSpacing = 36.0; ///< pixels

    /// Every tenth of a decade that a person would name: 20, 50, 100 …
    double nextRoundNumber(double above)
    {
        const double decade = std::pow(10.0, std::floor(std::log10(above)));
        for (const double digit : {2.0, 5.0})
            if (digit * decade > above * (1.0 + 1e-9))
                return digit * decade;
        return 10.0 * decade;
    }

    /// In thousands where the bar has no room for more digits.
    QString tickText(double value, int decimals)
    {
        return value < 1e4 ? numberText(value, decimals) : QStringLiteral("%1k").arg(1e-3 * value);
    }

} // namespace

ColourBar::ColourBar(QWidget *parent) : QWidget(parent), m_map(&ColourMap::named(ColourMap::defaultName()))
{
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
    setAccessibleName(tr("Colour range"));
    setToolTip(tr("Drag an end to set the black or white level, or the middle to move both. Double-click for the "
                  "automatic range."));
    chooseScale();
}

void ColourBar::attach(WaterfallView *view)
{
    m_view = view;
    view->canvas()->installEventFilter(this);
    const auto follow = [this, view] {
        setUnit(view->valueUnit());
        if (view->picture())
            setHistogram(view->picture()->scale(), view->histogram());
        else
            setHistogram(ByteScale(), {});
    };
    connect(view, &WaterfallView::histogramChanged, this, follow);
    connect(view, &WaterfallView::rangeChanged, this, &ColourBar::setRange);
    connect(&view->display(), &PictureDisplay::coloursChanged, this,
            [this, view] { setColourMap(view->display().colourMap()); });
    connect(view, &WaterfallView::thresholdChanged, this,
            [this](double nats) { setMarker(std::isnan(nats) ? std::nullopt : std::optional(nats)); });
    connect(this, &ColourBar::rangeRequested, view, &WaterfallView::setRange);
    connect(this, &ColourBar::automaticRequested, view, &WaterfallView::setAutomaticRange);
    setAccessibleName(tr("Colour range of %1").arg(view->accessibleName()));
    setColourMap(view->display().colourMap());
    setMarker(view->threshold());
    setRange(view->range().low, view->range().high);
    follow();
}

QWidget *ColourBar::pane(WaterfallView *view)
{
    auto *bar = new ColourBar;
    bar->attach(view);
    auto *result = new QWidget;
    auto *layout = new QHBoxLayout(result);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(view, 1);
    layout->addWidget(bar);
    return result;
}

void ColourBar::setColourMap(const ColourMap &map)
{
    m_map = &map;
    update();
}

void ColourBar::setRange(double low, double high)
{
    m_range = {low, std::max(high, low + smallestRange)};
    if (m_grip == Grip::None)
        chooseScale();
    setAccessibleDescription(
        tr("From %1 to %2 %3").arg(numberText(m_range.low, 1), numberText(m_range.high, 1), m_unit));
    update();
}

void ColourBar::setUnit(const QString &unit)
{
    m_unit = unit;
    update();
}

void ColourBar::setHistogram(const ByteScale &scale, const std::vector<double> &counts)
{
    m_byteScale = scale;
    m_counts = counts;
    chooseScale();
    update();
}

ColourScale ColourBar::colours() const
{
    return ColourScale::of(m_byteScale, m_marker);
}

void ColourBar::setMarker(std::optional<double> value)
{
    m_marker = value;
    if (m_grip == Grip::None)
        chooseScale();
    update();
}

void ColourBar::chooseScale()
{
    // Fits as much of the data as possible into the range extended by half of it on either side.
    const Span range = places();
    Span all = m_range;
    for (int byte = 1; byte < int(m_counts.size()); ++byte)
        if (m_counts[std::size_t(byte)] > 0.0)
            all = {std::min(all.low, m_byteScale.value(byte)), std::max(all.high, m_byteScale.value(byte))};
    all = colours().places(all);
    const double room = 0.5 * range.width(), edge = 0.06 * range.width();
    m_scale = {std::max(all.low, range.low - room) - edge, std::min(all.high, range.high + room) + edge};
}

/// Width of the bar, its histogram, and the numbers beside it.
int ColourBar::usualWidth()
{
    return 33 + int(std::lround(33.0 * Theme::plotScale()));
}

QRectF ColourBar::barRect() const
{
    double top = topMargin, bottom = height() - bottomMargin;
    if (m_view && m_view->window() == window() && !m_view->isHidden()) {
        const QPoint canvas = m_view->canvas()->mapTo(window(), QPoint()) - mapTo(window(), QPoint());
        top = std::max<double>(top, canvas.y());
        bottom = std::min<double>(bottom, canvas.y() + m_view->canvas()->height());
    }
    return {leftMargin + histogramWidth, top, barWidth, std::max(bottom - top, 10.0)};
}

double ColourBar::yOf(double value) const
{
    const QRectF bar = barRect();
    return bar.bottom() - (colours().place(value) - m_scale.low) / m_scale.width() * bar.height();
}

double ColourBar::placeAt(double y) const
{
    const QRectF bar = barRect();
    return m_scale.low + (bar.bottom() - y) / bar.height() * m_scale.width();
}

void ColourBar::paintEvent(QPaintEvent *)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    paintHistogram(painter);
    paintBar(painter);
    paintTicks(painter);
    paintMarker(painter);
    paintGrips(painter);
}

void ColourBar::paintBar(QPainter &painter) const
{
    const QRectF bar = barRect();
    const Span range = places();
    const double ratio = devicePixelRatioF();
    const int height = std::max(int(ratio * bar.height()), 1);
    QImage image(1, height, QImage::Format_RGB32);
    for (int y = 0; y < height; ++y)
        image.setPixel(0, y, m_map->at((placeAt(bar.top() + (y + 0.5) / ratio) - range.low) / range.width()));
    painter.drawImage(bar, image);
    painter.setPen(QPen(Theme::colours(*this).frame, 1.0));
    painter.drawRect(bar.adjusted(-0.5, -0.5, 0.5, 0.5));
}

void ColourBar::paintHistogram(QPainter &painter) const
{
    if (m_counts.empty())
        return;
    // Density rather than count, because the bytes of high nats are wider than those of low ones. Fourth root, to show
    // tails.
    const QRectF bar = barRect();
    const std::vector<int> bytes = m_byteScale.ascending();
    const auto widthOf = [&](std::size_t i) { return m_byteScale.value(bytes[i]) - m_byteScale.value(bytes[i - 1]); };
    const auto density = [&](std::size_t i) {
        const double width = widthOf(i);
        return width > 0.0 ? std::pow(m_counts[std::size_t(bytes[i])] / width, 0.25) : 0.0;
    };
    double highest = 0.0;
    for (std::size_t i = 1; i < bytes.size(); ++i)
        highest = std::max(highest, density(i));
    if (highest == 0.0)
        return;
    QPainterPath path(QPointF(bar.left() - 2.0, yOf(m_byteScale.value(bytes.front()))));
    for (std::size_t i = 1; i < bytes.size(); ++i) {
        const double x = bar.left() - 2.0 - density(i) / highest * histogramWidth;
        const double middle = 0.5 * widthOf(i);
        path.lineTo(x, yOf(m_byteScale.value(bytes[i]) - middle));
        path.lineTo(x, yOf(m_byteScale.value(bytes[i]) + middle));
    }
    path.lineTo(bar.left() - 2.0, yOf(m_byteScale.value(bytes.back())));
    painter.save();
    painter.setClipRect(QRectF(0.0, bar.top(), bar.left(), bar.height()));
    QColor fill = Theme::colours(*this).faintText;
    fill.setAlpha(110);
    painter.fillPath(path, fill);
    painter.restore();
}

void ColourBar::paintTicks(QPainter &painter) const
{
    const QRectF bar = barRect();
    const Theme::Colours &colours = Theme::colours(*this);
    painter.setFont(Theme::plotFont());
    const QFontMetricsF metrics(painter.font());
    const auto [values, decimals] = ticks();
    for (const double value : values) {
        const double y = std::round(yOf(value)) + 0.5;
        painter.setPen(QPen(colours.faintText, 1.0));
        painter.drawLine(QPointF(bar.right() + 1.0, y), QPointF(bar.right() + 5.0, y));
        painter.setPen(colours.text);
        painter.drawText(
            QRectF(bar.right() + 8.0, y - metrics.height() / 2.0, width() - bar.right() - 8.0, metrics.height()),
            Qt::AlignLeft | Qt::AlignVCenter, tickText(value, decimals));
    }
    painter.setPen(colours.faintText);
    painter.drawText(QRectF(bar.left(), bar.top() - metrics.height() - 6.0, width() - bar.left(), metrics.height()),
                     Qt::AlignLeft | Qt::AlignVCenter, m_unit);
}

/// Numbers beside the bar, and their decimals.
std::pair<QList<double>, int> ColourBar::ticks() const
{
    const double height = barRect().height();
    const std::optional<double> threshold = colours().threshold;
    Span linear = m_scale;
    if (threshold)
        linear.high = std::min(linear.high, colours().linearUntil());
    const QwtScaleDiv div =
        linearScaleDiv(linear, std::max(int(linear.width() / m_scale.width() * height / tickSpacing), 2));
    QList<double> values = div.ticks(QwtScaleDiv::MajorTick);
    if (linear.high < m_scale.high) {
        const double top = colours().value(m_scale.high);
        for (double value = nextRoundNumber(linear.high); value <= top; value = nextRoundNumber(value))
            if (values.isEmpty() || yOf(values.back()) - yOf(value) >= 0.5 * tickSpacing)
                values.append(value);
    }
    return {values, decimalsFor(majorStep(div))};
}

void ColourBar::paintGrips(QPainter &painter) const
{
    const QRectF bar = barRect();
    const Theme::Colours &colours = Theme::colours(*this);
    for (const double value : {m_range.low, m_range.high}) {
        const QRectF grip(bar.left() - 3.0, yOf(value) - 2.5, bar.width() + 6.0, 5.0);
        painter.setPen(QPen(hasFocus() ? colours.accent : colours.text, 1.0));
        painter.setBrush(palette().base());
        painter.drawRoundedRect(grip, 2.0, 2.0);
    }
}

void ColourBar::paintMarker(QPainter &painter) const
{
    const QRectF bar = barRect();
    if (!m_marker || !m_scale.contains(colours().place(*m_marker)))
        return;
    const double y = yOf(*m_marker);
    painter.setPen(Qt::NoPen);
    painter.setBrush(Theme::colours(*this).threshold);
    painter.drawPolygon(QPolygonF{{bar.left() - 1.0, y}, {bar.left() - 9.0, y - 4.5}, {bar.left() - 9.0, y + 4.5}});
    painter.setPen(QPen(Theme::colours(*this).threshold, 1.5));
    painter.drawLine(QPointF(bar.left(), y), QPointF(bar.right() + 1.0, y));
}

ColourBar::Grip ColourBar::gripAt(double y) const
{
    const double toLow = std::abs(y - yOf(m_range.low)), toHigh = std::abs(y - yOf(m_range.high));
    if (std::min(toLow, toHigh) <= gripReach)
        return toLow < toHigh ? Grip::Low : Grip::High;
    return places().contains(placeAt(y)) ? Grip::Both : Grip::None;
}

void ColourBar::request(const Span &range)
{
    emit rangeRequested(range.low, range.high);
}

void ColourBar::mousePressEvent(QMouseEvent *event)
{
    if (event->button() != Qt::LeftButton)
        return;
    m_grip = gripAt(event->position().y());
    m_gripPlace = placeAt(event->position().y());
    m_gripRange = places();
}

void ColourBar::mouseMoveEvent(QMouseEvent *event)
{
    if (m_grip == Grip::None) {
        const Grip grip = gripAt(event->position().y());
        setCursor(grip == Grip::None ? Qt::ArrowCursor : grip == Grip::Both ? Qt::OpenHandCursor : Qt::SizeVerCursor);
        return;
    }
    const double shift = placeAt(event->position().y()) - m_gripPlace;
    Span range = m_gripRange;
    if (m_grip != Grip::High)
        range.low += shift;
    if (m_grip != Grip::Low)
        range.high += shift;
    if (m_grip == Grip::Low)
        range.low = std::min(range.low, range.high - smallestRange);
    if (m_grip == Grip::High)
        range.high = std::max(range.high, range.low + smallestRange);
    request(colours().values(range));
}

void ColourBar::mouseReleaseEvent(QMouseEvent *)
{
    m_grip = Grip::None;
    chooseScale();
    update();
}

void ColourBar::mouseDoubleClickEvent(QMouseEvent *)
{
    m_grip = Grip::None;
    emit automaticRequested();
}

void ColourBar::wheelEvent(QWheelEvent *event)
{
    const double notches = event->angleDelta().y() / 120.0;
    const Span range = places();
    const double shift = notches * 0.05 * range.width();
    request(colours().values({range.low + shift, range.high + shift}));
    event->accept();
}

void ColourBar::keyPressEvent(QKeyEvent *event)
{
    const Span range = places();
    const double step = std::max(0.02 * range.width(), 0.1);
    const double shift = event->key() == Qt::Key_Up ? step : event->key() == Qt::Key_Down ? -step : 0.0;
    if (shift == 0.0) {
        QWidget::keyPressEvent(event);
        return;
    }
    if (event->modifiers().testFlag(Qt::ShiftModifier))
        request({colours().value(std::min(range.low + shift, range.high - smallestRange)), m_range.high});
    else
        request({m_range.low, colours().value(std::max(range.high + shift, range.low + smallestRange))});
}

bool ColourBar::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::Resize || event->type() == QEvent::Move)
        update();
    return QWidget::eventFilter(watched, event);
}

void ColourBar::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange)
        updateGeometry();
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::StyleChange)
        update();
}

} // namespace faintline

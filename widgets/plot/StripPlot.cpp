#include "widgets/plot/StripPlot.h"

#include "widgets/base/CanvasSentence.h"
#include "widgets/base/Theme.h"
#include "widgets/base/scaleTicks.h"
#include "widgets/base/steadyAxes.h"
#include "widgets/plot/CurveKey.h"
#include "widgets/plot/NumberScaleDraw.h"
#include "widgets/plot/StripSeries.h"
#include "widgets/plot/TimeScaleDraw.h"

#include <qwt_plot_curve.h>
#include <qwt_plot_grid.h>
#include <qwt_plot_layout.h>
#include <qwt_plot_marker.h>
#include <qwt_plot_zoneitem.h>
#include <qwt_scale_map.h>
#include <qwt_scale_widget.h>
#include <qwt_text.h>

#include <QMouseEvent>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    QwtAxisId axisOf(StripPlot::Side side)
    {
        return side == StripPlot::Side::Left ? QwtAxis::YLeft : QwtAxis::YRight;
    }

    QwtText plainText(const QString &text, const QFont &font, const QColor &colour)
    {
        QwtText result(text, QwtText::PlainText);
        result.setFont(font);
        result.setColor(colour);
        return result;
    }

    /// Writes the title of an ordinate as small as the plot is low; Qwt would cut it.
    void fitTitle(QwtPlot &plot, const QwtAxisId &axis)
    {
        constexpr int smallest = 8; // pixels
        constexpr int margin = 4;   // that Qwt leaves at the ends of a title
        QwtText title = plot.axisTitle(axis);
        QFont font = Theme::plotTitleFont();
        while (font.pixelSize() > smallest
               && QFontMetrics(font).horizontalAdvance(title.text()) > plot.canvas()->height() - margin)
            font.setPixelSize(font.pixelSize() - 1);
        if (title.font() == font)
            return;
        title.setFont(font);
        plot.setAxisTitle(axis, title);
    }

} // namespace

StripPlot::StripPlot(const QString &ordinate, QWidget *parent)
    : ThemedPlot(parent), m_levelValue(std::numeric_limits<double>::quiet_NaN()), m_grid(new QwtPlotGrid),
      m_cursorLine(new QwtPlotMarker), m_level(new QwtPlotMarker), m_bandItem(new QwtPlotZoneItem),
      m_sentence(new CanvasSentence), m_key(new CurveKey(Qt::AlignRight | Qt::AlignTop))
{
    m_sentence->text = tr("No data yet.");
    setAxisTitle(QwtAxis::YLeft, ordinate);
    setAxisTitle(QwtAxis::YRight, QString(QChar::Nbsp)); // reserves the room of a title
    setAxisTitle(QwtAxis::XBottom, tr("Time (s)"));
    m_grid->attach(this);
    m_level->setLineStyle(QwtPlotMarker::HLine);
    m_level->setZ(25.0);
    m_level->setLabelAlignment(Qt::AlignLeft | Qt::AlignTop);
    m_level->attach(this);
    m_bandItem->setOrientation(Qt::Horizontal);
    m_bandItem->setZ(1.0);
    m_bandItem->setPen(QPen(Qt::NoPen));
    m_bandItem->attach(this);
    m_cursorLine->setLineStyle(QwtPlotMarker::VLine);
    m_cursorLine->setZ(26.0);
    m_cursorLine->attach(this);
    m_sentence->attach(this);
    m_key->attach(this);
    for (const QwtAxisId axis : {QwtAxis::YLeft, QwtAxis::YRight})
        setAxisScaleDraw(axis, new NumberScaleDraw);
    setAxisScaleDraw(QwtAxis::XBottom, new TimeScaleDraw);
    canvas()->setMouseTracking(true);
    canvas()->setCursor(Qt::CrossCursor);
    setAccessibleName(tr("%1 over time").arg(ordinate));
    restyle();
}

StripPlot::~StripPlot() = default;

void StripPlot::setViewport(Viewport *viewport)
{
    if (m_viewport)
        m_viewport->disconnect(this);
    m_viewport = viewport;
    if (viewport) {
        connect(viewport, &Viewport::extentsChanged, this, &StripPlot::layAxes);
        connect(viewport, &Viewport::spanChanged, this, &StripPlot::followSpan);
        connect(viewport, &Viewport::cursorChanged, this, &StripPlot::followCursor);
    }
    layAxes();
    followCursor();
}

StripSeries &StripPlot::series(const QString &name)
{
    for (const auto &one : m_series)
        if (one->name == name)
            return *one;
    auto added = std::make_unique<StripSeries>();
    added->name = name;
    added->curve = new QwtPlotCurve(name);
    added->curve->setZ(20.0);
    added->curve->setRenderHint(QwtPlotItem::RenderAntialiased);
    added->curve->attach(this);
    m_series.push_back(std::move(added));
    return *m_series.back();
}

void StripPlot::setSeries(const QString &name, const Axis &time, std::vector<float> values, Side side)
{
    StripSeries &one = series(name);
    one.time = time;
    one.values = std::move(values);
    one.side = axisOf(side);
    one.curve->setYAxis(one.side);
    restyle();
}

void StripPlot::removeSeries(const QString &name)
{
    const auto found =
        std::find_if(m_series.begin(), m_series.end(), [&](const auto &one) { return one->name == name; });
    if (found == m_series.end())
        return;
    (*found)->curve->detach();
    delete (*found)->curve;
    m_series.erase(found);
    restyle();
}

void StripPlot::setStartUnixSeconds(std::optional<double> start)
{
    if (start == m_startUnixSeconds)
        return;
    m_startUnixSeconds = start;
    restyle();
}

void StripPlot::setLeftTitle(const QString &title)
{
    setAxisTitle(QwtAxis::YLeft, title);
    updateGeometry();
    setAccessibleName(tr("%1 over time").arg(title));
    restyle();
}

void StripPlot::setRightTitle(const QString &title)
{
    setAxisTitle(QwtAxis::YRight, title);
    restyle();
}

void StripPlot::setProfile(const QString &name, std::shared_ptr<const PeakPyramid> picture, const Axis &frequency)
{
    if (!m_profileName.isEmpty() && m_profileName != name)
        removeSeries(m_profileName);
    m_profileName = name;
    m_profile = std::move(picture);
    m_profileFrequency = frequency;
    followCursor();
}

void StripPlot::readProfile()
{
    if (m_profileName.isEmpty())
        return;
    if (!m_profile || !m_viewport || !m_viewport->cursor()) {
        removeSeries(m_profileName);
        return;
    }
    const auto cell = std::size_t(m_profileFrequency.nearest(m_viewport->cursor()->hz));
    std::vector<float> values(std::size_t(m_profile->rowCount(0)));
    for (std::size_t row = 0; row < values.size(); ++row)
        values[row] = float(m_profile->scale().value(m_profile->row(0, Index(row))[cell]));
    Axis time = m_profile->time();
    const auto frames = double(m_profile->framesPerRow(0));
    time.first = time.value(0.5 * (frames - 1.0)); // a row represents the middle of its frames
    time.step *= frames;
    time.count = m_profile->rowCount(0);
    setSeries(m_profileName, time, std::move(values), Side::Left);
}

void StripPlot::setFixedScale(Side side, const Span &span)
{
    m_fixed[int(side)] = span;
    followSpan();
}

void StripPlot::setLevel(double value, const QString &label)
{
    m_levelValue = value;
    m_level->setVisible(!std::isnan(value));
    m_level->setYValue(std::isnan(value) ? 0.0 : value);
    m_level->setTitle(label);
    restyle();
}

void StripPlot::setBand(const std::optional<Span> &band)
{
    m_band = band;
    if (band)
        m_bandItem->setInterval(band->low, band->high);
    restyle();
}

void StripPlot::setEmptySentence(const QString &sentence)
{
    m_sentence->text = sentence;
    replot();
}

void StripPlot::restyle()
{
    Theme::style(*this);
    const Theme::Colours &colours = Theme::colours(*this);
    m_grid->setPen(colours.grid, 1.0);
    m_grid->enableX(false);
    m_cursorLine->setLinePen(colours.faintText, 1.0);
    m_level->setLinePen(colours.threshold, 1.2, Qt::DashLine);
    QColor bandColour = colours.curves[0];
    bandColour.setAlpha(50);
    m_bandItem->setBrush(bandColour);
    m_level->setLabel(plainText(m_level->title().text(), Theme::plotFont(), colours.threshold));
    m_sentence->colour = colours.faintText;
    m_key->follow(colours, 200);
    for (std::size_t i = 0; i < m_series.size(); ++i)
        m_series[i]->curve->setPen(colours.curves[i % std::size(colours.curves)], 1.2);
    nameCurves();
    layAxes();
}

/// Width of a right axis, so that strips above each other end at the same time.
int StripPlot::widthOfRightAxis() const
{
    // Half a label of the time axis extends into that room anyway.
    const int width = axisWidget(QwtAxis::YRight)->sizeHint().width() + int(plotLayout()->spacing());
    return std::max(width - axisWidget(QwtAxis::XBottom)->endBorderDist(), 0);
}

/// A curve with an ordinate of its own gives it its colour; since a key covers a part of the curves, it is only shown
/// if needed.
void StripPlot::nameCurves()
{
    m_key->entries.clear();
    for (const Side side : {Side::Left, Side::Right}) {
        std::vector<CurveKey::Entry> entries;
        for (const auto &one : m_series)
            if (one->side == axisOf(side))
                entries.push_back({one->name, one->curve->pen()});
        if (entries.size() > 1)
            m_key->entries.insert(m_key->entries.end(), entries.begin(), entries.end());
        QwtText title = axisTitle(axisOf(side));
        title.setColor(entries.size() == 1 ? entries.front().pen.color() : Theme::colours(*this).faintText);
        setAxisTitle(axisOf(side), title);
    }
}

void StripPlot::layAxes()
{
    const bool isEmpty = m_series.empty();
    const bool hasRight =
        std::any_of(m_series.begin(), m_series.end(), [](const auto &one) { return one->side == axisOf(Side::Right); });
    auto *time = static_cast<TimeScaleDraw *>(axisScaleDraw(QwtAxis::XBottom));
    time->setTimes(m_viewport ? m_viewport->full().time : Span(), m_startUnixSeconds);
    setAxisTitle(QwtAxis::XBottom, time->title());
    setAxisVisible(QwtAxis::XBottom, !isEmpty && hasTimeLabels());
    setAxisVisible(QwtAxis::YLeft, !isEmpty);
    setAxisVisible(QwtAxis::YRight, hasRight);
    m_sentence->setVisible(isEmpty);
    m_grid->setVisible(!isEmpty);
    m_level->setVisible(!isEmpty && !std::isnan(m_levelValue));
    m_bandItem->setVisible(!isEmpty && m_band);
    followSpan();
}

void StripPlot::followSpan()
{
    Span span = m_viewport && !m_viewport->isEmpty() ? m_viewport->time() : Span{0.0, 1.0};
    const int pixels = canvas()->contentsRect().width();
    for (const auto &one : m_series)
        one->curve->setSamples(one->points(span, pixels));
    const auto &timeDraw = *static_cast<TimeScaleDraw *>(axisScaleDraw(QwtAxis::XBottom));
    const bool isClock = timeDraw.isClock();
    setAxisScaleDiv(QwtAxis::XBottom, timeScaleDiv(span, std::clamp(pixels / (isClock ? 90 : 60), 1, 16),
                                                   m_startUnixSeconds.value_or(0.0)));
    updateOrdinate(Side::Left);
    updateOrdinate(Side::Right);
    for (const QwtAxisId axis : {QwtAxis::YLeft, QwtAxis::YRight})
        fitTitle(*this, axis);
    // Wide enough for most figures, so that the canvases of strips above each other are aligned.
    steadyAxes(*this, QStringLiteral("−0.000"), timeDraw.widestLabel(m_viewport ? m_viewport->full().time : span));
    const bool hasRight = isAxisVisible(QwtAxis::YRight) || m_series.empty();
    setContentsMargins(QMargins(2, 4, 6 + (hasRight ? 0 : widthOfRightAxis()), 2) + sideRooms());
    replot();
}

void StripPlot::updateOrdinate(Side side)
{
    Span span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const auto &one : m_series)
        if (one->side == axisOf(side))
            span = {std::min(span.low, one->seen.low), std::max(span.high, one->seen.high)};
    if (side == Side::Left && !std::isnan(m_levelValue))
        span = {std::min(span.low, m_levelValue), std::max(span.high, m_levelValue)};
    if (side == Side::Left && m_band)
        span = {std::min(span.low, m_band->low), std::max(span.high, m_band->high)};
    const auto &fixed = m_fixed[int(side)];
    if (fixed)
        span = *fixed;
    else if (!std::isfinite(span.low))
        span = {0.0, 1.0};
    else {
        const double room = std::max(0.1 * span.width(), 0.05 * std::max(std::abs(span.middle()), 0.1));
        span = {span.low - room, span.high + room};
    }
    if (side == Side::Left) // its name fits on one side of it
        m_level->setLabelAlignment(Qt::AlignLeft
                                   | (m_levelValue > span.low + 0.7 * span.width() ? Qt::AlignBottom : Qt::AlignTop));
    setAxisScaleDiv(axisOf(side), linearScaleDiv(span, std::clamp(canvas()->contentsRect().height() / 26, 2, 8)));
}

void StripPlot::followCursor()
{
    readProfile();
    m_cursorLine->setVisible(m_viewport && m_viewport->cursor() && !m_series.empty());
    if (m_viewport && m_viewport->cursor())
        m_cursorLine->setXValue(m_viewport->cursor()->seconds);
    replot();
}

bool StripPlot::eventFilter(QObject *watched, QEvent *event)
{
    if (watched != canvas() || !m_viewport || m_viewport->isEmpty())
        return ThemedPlot::eventFilter(watched, event);
    const auto mouse = [event] { return static_cast<QMouseEvent *>(event); };
    if (event->type() == QEvent::MouseButtonPress && mouse()->button() == Qt::LeftButton) {
        setFocus(Qt::MouseFocusReason);
        m_dragStart = mouse()->position();
        m_dragLow = m_viewport->time().low;
        m_isPanning = false;
        return true;
    }
    if (event->type() == QEvent::MouseMove) {
        const double seconds = invTransform(QwtAxis::XBottom, mouse()->position().x());
        if (m_dragLow) {
            m_isPanning = m_isPanning || std::abs(mouse()->position().x() - m_dragStart.x()) >= 4.0;
            if (m_isPanning)
                m_viewport->pan(*m_dragLow - (seconds - invTransform(QwtAxis::XBottom, m_dragStart.x()))
                                    - m_viewport->time().low,
                                0.0);
            return true;
        }
        if (!m_series.empty() && !m_series.front()->values.empty()) {
            const StripSeries &first = *m_series.front();
            const double last = double(first.values.size() - 1);
            const auto index = std::size_t(std::clamp(std::round(first.time.position(seconds)), 0.0, last));
            emit hovered(seconds, double(first.values[index]));
        }
    }
    if (event->type() == QEvent::MouseButtonRelease && m_dragLow) {
        m_dragLow.reset();
        if (!m_isPanning) {
            const double hz = m_viewport->cursor() ? m_viewport->cursor()->hz : m_viewport->frequency().middle();
            m_viewport->setCursor({invTransform(QwtAxis::XBottom, mouse()->position().x()), hz});
        }
        return true;
    }
    return ThemedPlot::eventFilter(watched, event);
}

void StripPlot::wheelEvent(QWheelEvent *event)
{
    if (!m_viewport || m_viewport->isEmpty()) {
        event->ignore();
        return;
    }
    const double notches = event->angleDelta().y() / 120.0;
    const double seconds = invTransform(QwtAxis::XBottom, canvas()->mapFrom(this, event->position()).x());
    const bool isOverAxis = isAxisVisible(QwtAxis::XBottom)
                            && axisWidget(QwtAxis::XBottom)->geometry().contains(event->position().toPoint());
    if (isOverAxis || event->modifiers().testFlag(Qt::ControlModifier))
        m_viewport->zoomAt(std::pow(1.25, notches), {seconds, m_viewport->frequency().middle()}, Viewport::Axes::Time);
    else
        m_viewport->pan(-0.1 * notches * m_viewport->time().width(), 0.0);
    event->accept();
}

/// High enough for the axis title.
QSize StripPlot::minimumSizeHint() const
{
    constexpr int least = 84;
    const int titleLength = QFontMetrics(Theme::plotTitleFont()).horizontalAdvance(axisTitle(QwtAxis::YLeft).text());
    const int timeAxis = hasTimeLabels() ? int(std::lround(48.0 * Theme::plotScale())) : 0;
    return {110, std::max(least, titleLength + timeAxis)};
}

} // namespace faintline

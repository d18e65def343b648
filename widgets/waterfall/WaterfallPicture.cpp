#include "widgets/waterfall/WaterfallPicture.h"

#include "widgets/base/CanvasSentence.h"
#include "widgets/base/Theme.h"
#include "widgets/base/fittingTitle.h"
#include "widgets/base/rasterise.h"
#include "widgets/waterfall/RasterItem.h"
#include "widgets/waterfall/peakNear.h"

#include <qwt_scale_map.h>
#include <qwt_text.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    constexpr double peakReach = 12.0; ///< pixels

} // namespace

WaterfallPicture::WaterfallPicture(const QString &heading, PictureDisplay *display, TimeDirection *direction)
    : m_heading(heading), m_raster(new RasterItem), m_sentence(new CanvasSentence),
      m_display(display ? display : new PictureDisplay(this)),
      m_direction(direction ? direction : new TimeDirection(Orientation::NewestOnTop, this)),
      m_axes(*this, *m_direction)
{
    m_sentence->text = tr("Open a recording or choose a scenario to start.");
    m_sentence->pixelSize = 14;
    m_sentence->attach(this);
    m_raster->attach(this);
    setAccessibleName(tr("%1 waterfall").arg(heading));
    connect(m_display, &PictureDisplay::coloursChanged, this, &WaterfallPicture::updateContent);
    connect(m_direction, &TimeDirection::changed, this, &WaterfallPicture::restyle);
    restyle();
}

// ---- what is shown -------------------------------------------------------------------------------------------------

void WaterfallPicture::setViewport(Viewport *viewport)
{
    if (m_viewport)
        m_viewport->disconnect(this);
    m_viewport = viewport;
    if (viewport) {
        connect(viewport, &Viewport::spanChanged, this, &WaterfallPicture::followSpan);
        connect(viewport, &Viewport::extentsChanged, this, &WaterfallPicture::restyle);
        connect(viewport, &Viewport::scaleChanged, this, &WaterfallPicture::restyle);
    }
    restyle();
}

void WaterfallPicture::setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency)
{
    const bool isOtherKind = picture && m_picture && picture->scale().kind() != m_picture->scale().kind();
    const bool hasSameAxes = picture && m_picture && frequency == m_frequency
                             && picture->time().name == m_picture->time().name
                             && picture->time().unit == m_picture->time().unit;
    if (picture != m_picture)
        m_closeup.reset();
    m_picture = std::move(picture);
    m_frequency = frequency;
    choosePicture();
    m_raster->setPicture(m_shown, frequency, m_picture ? m_picture->time() : Axis());
    m_levels.countAgain();
    if (!m_picture) {
        m_levels.clearHistogram();
        emit histogramChanged();
    }
    if (isOtherKind)
        m_levels.setAutomatic(true);
    hasSameAxes ? countHistogram() : restyle();
}

void WaterfallPicture::setNextPicture(std::shared_ptr<const PeakPyramid> picture)
{
    const bool isFirst = !m_picture || !picture || !(picture->time() == m_picture->time());
    if (isFirst)
        return setPicture(std::move(picture), m_frequency);
    m_closeup.reset();
    m_picture = std::move(picture);
    choosePicture();
    const bool wasAutomatic = m_levels.isAutomatic();
    m_levels.setAutomatic(false);
    countHistogram();
    m_levels.setAutomatic(wasAutomatic);
    updateContent();
}

void WaterfallPicture::setGrownPicture(std::shared_ptr<const PeakPyramid> picture,
                                       std::shared_ptr<const PeakPyramid> closeup)
{
    m_picture = std::move(picture);
    m_closeup = std::move(closeup);
    constexpr bool isOther = false;
    choosePicture(isOther);
    updateContent();
}

void WaterfallPicture::setStartUnixSeconds(std::optional<double> start)
{
    if (start == m_startUnixSeconds)
        return;
    m_startUnixSeconds = start;
    restyle();
}

void WaterfallPicture::setCloseup(std::shared_ptr<const PeakPyramid> closeup)
{
    m_closeup = std::move(closeup);
    followSpan();
}

double WaterfallPicture::framesPerPixel() const
{
    const QSize size = canvas()->contentsRect().size();
    return m_picture ? visible().time.width() / m_picture->time().step
                           / std::max(isTimeVertical() ? size.height() : size.width(), 1)
                     : 1.0;
}

void WaterfallPicture::choosePicture(bool isOther)
{
    const auto shows = [this](const PeakPyramid &closeup) {
        const Span time = extents(closeup.time(), m_frequency).time;
        const double slack = 1e-6 * closeup.time().step;
        return framesPerPixel() < double(m_picture->framesPerRow(0)) && visible().time.low > time.low - slack
               && visible().time.high < time.high + slack;
    };
    const auto &shown = m_picture && m_closeup && shows(*m_closeup) ? m_closeup : m_picture;
    if (shown == m_shown)
        return;
    m_shown = shown;
    m_raster->setPicture(m_shown, m_frequency, m_picture ? m_picture->time() : Axis());
    if (isOther)
        m_levels.countAgain();
    emit shownPictureChanged();
}

const PeakPyramid &WaterfallPicture::finestPicture(const Span &time) const
{
    const auto holds = [&](const PeakPyramid &picture) {
        const Span all = extents(picture.time(), m_frequency).time;
        return all.contains(time.low) && all.contains(time.high);
    };
    return m_closeup && holds(*m_closeup) ? *m_closeup : *m_picture;
}

Viewport::Box WaterfallPicture::extents(const Axis &time, const Axis &frequency)
{
    return {{time.value(-0.5), time.value(double(time.count) - 0.5)},
            {frequency.value(-0.5), frequency.value(double(frequency.count) - 0.5)}};
}

void WaterfallPicture::setEmptySentence(const QString &sentence)
{
    m_sentence->text = sentence;
    replot();
}

QString WaterfallPicture::valueUnit() const
{
    return m_picture && m_picture->scale().kind() != ByteScale::Kind::PowerDb ? m_statisticUnit : tr("dB");
}

void WaterfallPicture::setStatisticUnit(const QString &unit, const QString &heading)
{
    m_statisticUnit = unit;
    setHeading(heading);
}

void WaterfallPicture::setHeading(const QString &heading)
{
    if (heading == m_heading)
        return;
    m_heading = heading;
    setAccessibleName(tr("%1 waterfall").arg(heading));
    restyle();
}

std::optional<double> WaterfallPicture::valueAt(double seconds, double hz) const
{
    if (!m_picture || m_picture->rowCount(0) == 0)
        return {};
    const Viewport::Box box = extents(m_picture->time(), m_frequency);
    if (!box.time.contains(seconds) || !box.frequency.contains(hz))
        return {};
    const PeakPyramid &picture = finestPicture({seconds, seconds});
    const double frame = std::floor(picture.time().position(seconds) + 0.5);
    if (frame > double(picture.frameCount()))
        return {}; // not recorded yet
    const Index row = std::clamp<Index>(Index(frame) / picture.framesPerRow(0), 0, picture.rowCount(0) - 1);
    return picture.scale().value(picture.row(0, row)[std::size_t(m_frequency.nearest(hz))]);
}

std::optional<Viewport::Point> WaterfallPicture::peakAround(const Viewport::Point &point) const
{
    const QPointF position = positionOf(point), reach(peakReach, peakReach);
    const Viewport::Point a = pointAt(position - reach), b = pointAt(position + reach);
    const auto around = [](double p, double q, double middle, double step) {
        return Span{std::min({p, q, middle - step}), std::max({p, q, middle + step})};
    };
    const double row = m_picture->time().step * double(m_picture->framesPerRow(0));
    return faintline::peakNear(
        *m_picture, m_frequency,
        {around(a.seconds, b.seconds, point.seconds, row), around(a.hz, b.hz, point.hz, m_frequency.step)});
}

double WaterfallPicture::originHz() const
{
    return m_viewport && m_frequency.unit == "Hz" && !isLogarithmic() ? m_viewport->originHz() : 0.0;
}

Viewport::Box WaterfallPicture::full() const
{
    if (m_viewport && !m_viewport->isEmpty())
        return m_viewport->full();
    return m_picture ? extents(m_picture->time(), m_frequency) : Viewport::Box{{0.0, 1.0}, {0.0, 1.0}};
}

Viewport::Box WaterfallPicture::visible() const
{
    return m_viewport && !m_viewport->isEmpty() ? m_viewport->visible() : full();
}

Viewport::Point WaterfallPicture::pointAt(const QPointF &position) const
{
    const double x = invTransform(QwtAxis::XBottom, position.x()), y = invTransform(QwtAxis::YLeft, position.y());
    return isTimeVertical() ? Viewport::Point{y, x} : Viewport::Point{x, y};
}

QPointF WaterfallPicture::positionOf(const Viewport::Point &point) const
{
    const double time = canvasMap(timeAxis()).transform(point.seconds), hz = canvasMap(hzAxis()).transform(point.hz);
    return isTimeVertical() ? QPointF(hz, time) : QPointF(time, hz);
}

void WaterfallPicture::setThreshold(double nats)
{
    const std::optional<double> threshold = std::isnan(nats) ? std::nullopt : std::optional(nats);
    if (threshold == m_threshold)
        return;
    m_threshold = threshold;
    updateContent();
    emit thresholdChanged(nats);
}

void WaterfallPicture::updateContent()
{
    m_sentence->setVisible(!m_picture);
    m_raster->setColours(colours());
    replot();
}

// ---- colours --------------------------------------------------------------------------------------------------------

void WaterfallPicture::countHistogram()
{
    const QSize size = canvas()->contentsRect().size();
    if (!m_picture || size.isEmpty() || m_frequency.count == 0)
        return;
    const double cells =
        visible().frequency.width() / m_frequency.step / (isTimeVertical() ? size.width() : size.height());
    if (!m_levels.count(*m_shown, framesPerPixel(), cells))
        return;
    emit histogramChanged();
    if (m_levels.isAutomatic())
        applyRange(automaticRange());
}

Span WaterfallPicture::automaticRange() const
{
    if (m_picture && m_isPlain && !histogram().empty())
        return rangeOfLevels(m_picture->scale(), histogram());
    return m_picture ? m_levels.suggested(m_picture->scale(), m_threshold) : range();
}

void WaterfallPicture::setPlain(bool isPlain)
{
    if (std::exchange(m_isPlain, isPlain) != isPlain)
        m_levels.setAutomatic(true);
}

void WaterfallPicture::applyRange(const Span &range)
{
    const bool isOther = range != m_levels.range();
    m_levels.setRange(range);
    m_raster->setColours(colours());
    if (isOther)
        emit rangeChanged(range.low, range.high);
}

void WaterfallPicture::setRange(double low, double high)
{
    m_levels.setAutomatic(false);
    applyRange(m_levels.byHand(low, high, m_picture ? &m_picture->scale() : nullptr));
    replot();
}

void WaterfallPicture::setAutomaticRange()
{
    m_levels.setAutomatic(true);
    applyRange(automaticRange());
    replot();
}

double WaterfallPicture::levelStep() const
{
    return valueUnit() == tr("dB") ? 1.0 : std::max(0.5, 0.01 * range().width());
}

void WaterfallPicture::stepBlack(int steps)
{
    const double step = levelStep();
    setRange(std::min(range().low + steps * step, range().high - step), range().high);
}

void WaterfallPicture::stepWhite(int steps)
{
    const double step = levelStep();
    setRange(range().low, std::max(range().high + steps * step, range().low + step));
}

PictureColours WaterfallPicture::colours() const
{
    return {&m_display->colourMap(), range(), m_threshold};
}

// ---- axes ----------------------------------------------------------------------------------------------------------

void WaterfallPicture::restyle()
{
    const bool isEmpty = !m_picture;
    m_axes.setContent(
        {isEmpty ? Axis() : m_picture->time(), m_frequency, full(), originHz(), isLogarithmic(), m_startUnixSeconds});
    setAxisVisible(hzAxis(), !isEmpty);
    setAxisVisible(timeAxis(), !isEmpty && (isTimeVertical() || hasTimeLabels()));

    QwtText title(m_heading);
    title.setFont(Theme::plotHeadingFont());
    title.setRenderFlags(Qt::AlignLeft | Qt::AlignVCenter);
    title.setColor(Theme::colours(*this).text);
    setTitle(title);
    Theme::style(*this);
    setContentsMargins(contentsMargins() + sideRooms());
    m_raster->setTimeVertical(isTimeVertical());
    m_raster->setLogarithmic(isLogarithmic());
    m_sentence->colour = Theme::colours(*this).faintText;
    updateLayout(); // titles and scales of another size
    fitTitles();
    followSpan();
    updateLayout(); // and labels
    updateContent();
}

void WaterfallPicture::followCanvas()
{
    fitTitles();
    followSpan();
}

/// Heading and axis titles have the room of the canvas.
void WaterfallPicture::fitTitles()
{
    QwtText heading = title();
    heading.setText(fittingHeading(m_heading, heading.font(), canvas()->width()));
    if (heading != title())
        setTitle(heading);
    m_axes.fitTitles();
}

void WaterfallPicture::followSpan()
{
    choosePicture();
    m_axes.show(visible(), full());
    countHistogram();
    replot();
}

} // namespace faintline

#include "widgets/WaterfallView.h"

#include "widgets/CanvasSentence.h"
#include "widgets/NumberScaleDraw.h"
#include "widgets/OverlayItem.h"
#include "widgets/RasterItem.h"
#include "widgets/peakNear.h"
#include "widgets/Theme.h"
#include "widgets/TimeScaleDraw.h"
#include "widgets/quantities.h"
#include "widgets/rasterise.h"
#include "widgets/scaleTicks.h"
#include "widgets/steadyAxes.h"

#include <qwt_plot_grid.h>
#include <qwt_plot_layout.h>
#include <qwt_scale_map.h>
#include <qwt_scale_widget.h>
#include <qwt_text.h>

#include <QActionGroup>
#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <functional>

namespace faintline {

namespace {

    constexpr double longSeconds = 600.0; ///< recordings from here on are labelled h:min:s
    constexpr double scrollShare = 0.1;   ///< of what is visible, per notch of the wheel
    constexpr double zoomPerNotch = 1.25;
    constexpr double clickSlop = 4.0; ///< pixels a click may wander
    constexpr int harmonicCount = 12;
    constexpr double peakReach = 12.0;    ///< pixels
    constexpr double sidebandReach = 5.0; ///< pixels

    double notchesOf(const QWheelEvent &event)
    {
        // Some platforms turn the wheel's direction while Shift or Alt is held.
        const QPoint delta = event.angleDelta();
        return (delta.y() != 0 ? delta.y() : delta.x()) / 120.0;
    }

    /// "Frequency", and what a value of that axis is divided by to be shown.
    FrequencyUnit shownUnit(const Axis &axis)
    {
        if (axis.unit == "Hz")
            return frequencyUnit(std::max(std::abs(axis.first), std::abs(axis.last())));
        return {QString::fromStdString(axis.unit), 1.0};
    }

    bool measuresTime(const Axis &axis)
    {
        return axis.unit == "s" || axis.unit.empty();
    }

    /// "12.4 m"
    QString valueText(const Axis &axis, double value, double resolution)
    {
        return numberText(value, decimalsFor(resolution)) + QLatin1Char(' ') + QString::fromStdString(axis.unit);
    }

    QString titleOf(const Axis &axis)
    {
        QString name = QString::fromStdString(axis.name);
        if (!name.isEmpty())
            name[0] = name[0].toUpper();
        const QString unit = shownUnit(axis).name;
        return unit.isEmpty() ? name : QStringLiteral("%1 (%2)").arg(name, unit);
    }

} // namespace

WaterfallView::WaterfallView(const QString &heading, QWidget *parent)
    : QwtPlot(parent), m_heading(heading), m_raster(new RasterItem), m_overlay(new OverlayItem),
      m_sentence(new CanvasSentence), m_grid(new QwtPlotGrid), m_colourMap(&ColourMap::named(ColourMap::defaultName()))
{
    m_sentence->text = tr("Open a recording or choose a scenario to see something here.");
    m_sentence->pixelSize = 14;
    m_sentence->attach(this);
    m_raster->attach(this);
    m_grid->setZ(5.0);
    m_grid->attach(this);
    m_overlay->attach(this);
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    canvas()->setFocusPolicy(Qt::NoFocus);
    canvas()->setMouseTracking(true);
    canvas()->setCursor(Qt::CrossCursor);
    canvas()->installEventFilter(this);
    setAccessibleName(tr("%1 waterfall").arg(heading));
    layAxes();
}

WaterfallView::~WaterfallView() = default;

// ---- what is shown -------------------------------------------------------------------------------------------------

void WaterfallView::setViewport(Viewport *viewport)
{
    if (m_viewport)
        m_viewport->disconnect(this);
    m_viewport = viewport;
    if (viewport) {
        connect(viewport, &Viewport::spanChanged, this, &WaterfallView::followSpan);
        connect(viewport, &Viewport::extentsChanged, this, &WaterfallView::layAxes);
        connect(viewport, &Viewport::cursorChanged, this, &WaterfallView::followCursor);
        connect(viewport, &Viewport::selectionChanged, this, [this] {
            m_selectionNote.clear();
            updateContent();
        });
    }
    layAxes();
    followCursor();
}

void WaterfallView::setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency)
{
    const bool isOtherKind = picture && m_picture && picture->scale().kind() != m_picture->scale().kind();
    const bool hasSameAxes = picture && m_picture && frequency == m_frequency && picture->time().name == m_picture->time().name
                             && picture->time().unit == m_picture->time().unit;
    if (picture != m_picture)
        m_closeup.reset();
    m_picture = std::move(picture);
    m_frequency = frequency;
    choosePicture();
    m_raster->setPicture(m_shown, frequency, m_picture ? m_picture->time() : Axis());
    m_histogramKey = {-1, 0};
    if (!m_picture) {
        m_histogram.clear();
        emit histogramChanged();
    }
    if (isOtherKind)
        m_isRangeAutomatic = true;
    hasSameAxes ? countHistogram() : layAxes();
    updateMarks();
}

void WaterfallView::setNextPicture(std::shared_ptr<const PeakPyramid> picture)
{
    const bool isFirst = !m_picture || !picture || !(picture->time() == m_picture->time());
    if (isFirst)
        return setPicture(std::move(picture), m_frequency);
    m_closeup.reset();
    m_picture = std::move(picture);
    choosePicture();
    const bool wasAutomatic = std::exchange(m_isRangeAutomatic, false);
    countHistogram();
    m_isRangeAutomatic = wasAutomatic;
    followCursor();
}

void WaterfallView::setCloseup(std::shared_ptr<const PeakPyramid> closeup)
{
    m_closeup = std::move(closeup);
    followSpan();
}

double WaterfallView::framesPerPixel() const
{
    const QSize size = canvas()->contentsRect().size();
    return m_picture ? visible().time.width() / m_picture->time().step / std::max(isTimeVertical() ? size.height() : size.width(), 1) : 1.0;
}

void WaterfallView::choosePicture()
{
    const auto shows = [this](const PeakPyramid &closeup) {
        const Span time = extents(closeup.time(), m_frequency).time;
        const double slack = 1e-6 * closeup.time().step;
        return framesPerPixel() < static_cast<double>(m_picture->framesPerRow(0)) && visible().time.low > time.low - slack
               && visible().time.high < time.high + slack;
    };
    const auto &shown = m_picture && m_closeup && shows(*m_closeup) ? m_closeup : m_picture;
    if (shown == m_shown)
        return;
    m_shown = shown;
    m_raster->setPicture(m_shown, m_frequency, m_picture ? m_picture->time() : Axis());
    m_histogramKey = {-1, 0};
    emit shownPictureChanged();
}

/// Which tells most of that time.
const PeakPyramid &WaterfallView::pictureOf(const Span &time) const
{
    const auto holds = [&](const PeakPyramid &picture) {
        const Span all = extents(picture.time(), m_frequency).time;
        return all.contains(time.low) && all.contains(time.high);
    };
    return m_closeup && holds(*m_closeup) ? *m_closeup : *m_picture;
}

bool WaterfallView::hasTime() const
{
    return !m_picture || measuresTime(m_picture->time());
}

Viewport::Box WaterfallView::extents(const Axis &time, const Axis &frequency)
{
    return {{time.value(-0.5), time.value(static_cast<double>(time.count) - 0.5)},
            {frequency.value(-0.5), frequency.value(static_cast<double>(frequency.count) - 0.5)}};
}

void WaterfallView::setEmptySentence(const QString &sentence)
{
    m_sentence->text = sentence;
    replot();
}

QString WaterfallView::valueUnit() const
{
    return m_picture && m_picture->scale().kind() != ByteScale::Kind::PowerDb ? m_statisticUnit : tr("dB");
}

void WaterfallView::setStatisticUnit(const QString &unit, const QString &heading)
{
    if (unit == m_statisticUnit && heading == m_heading)
        return;
    m_statisticUnit = unit;
    m_heading = heading;
    setAccessibleName(tr("%1 waterfall").arg(heading));
    layAxes();
}

std::optional<double> WaterfallView::valueAt(double seconds, double hz) const
{
    if (!m_picture || m_picture->rowCount(0) == 0)
        return {};
    const Viewport::Box box = extents(m_picture->time(), m_frequency);
    if (!box.time.contains(seconds) || !box.frequency.contains(hz))
        return {};
    const PeakPyramid &picture = pictureOf({seconds, seconds});
    const double frame = std::floor(picture.time().position(seconds) + 0.5);
    if (frame > static_cast<double>(picture.frameCount()))
        return {}; // still to come
    const Index row = std::clamp<Index>(static_cast<Index>(frame) / picture.framesPerRow(0), 0, picture.rowCount(0) - 1);
    return picture.scale().value(picture.row(0, row)[static_cast<std::size_t>(m_frequency.nearest(hz))]);
}

Viewport::Box WaterfallView::full() const
{
    if (m_viewport && !m_viewport->isEmpty())
        return m_viewport->full();
    return m_picture ? extents(m_picture->time(), m_frequency) : Viewport::Box{{0.0, 1.0}, {0.0, 1.0}};
}

Viewport::Box WaterfallView::visible() const
{
    return m_viewport && !m_viewport->isEmpty() ? m_viewport->visible() : full();
}

Viewport::Point WaterfallView::pointAt(const QPointF &position) const
{
    const double x = invTransform(QwtAxis::XBottom, position.x()), y = invTransform(QwtAxis::YLeft, position.y());
    return isTimeVertical() ? Viewport::Point{y, x} : Viewport::Point{x, y};
}

QPointF WaterfallView::positionOf(const Viewport::Point &point) const
{
    const double time = canvasMap(timeAxis()).transform(point.seconds), hz = canvasMap(hzAxis()).transform(point.hz);
    return isTimeVertical() ? QPointF(hz, time) : QPointF(time, hz);
}

// ---- axes ----------------------------------------------------------------------------------------------------------

void WaterfallView::layAxes()
{
    const bool isEmpty = !m_picture;
    const bool isLong = full().time.high > longSeconds;
    if (hasTime()) {
        auto *draw = new TimeScaleDraw;
        draw->setClock(isLong);
        setAxisScaleDraw(timeAxis(), draw);
        setAxisTitle(timeAxis(), isLong ? tr("Time (h:min:s)") : tr("Time (s)"));
    } else {
        setAxisScaleDraw(timeAxis(), new NumberScaleDraw);
        setAxisTitle(timeAxis(), titleOf(m_picture->time()));
    }
    auto *hzDraw = new NumberScaleDraw;
    hzDraw->setUnit(shownUnit(m_frequency).hz);
    setAxisScaleDraw(hzAxis(), hzDraw);
    setAxisTitle(hzAxis(), titleOf(m_frequency));
    for (const QwtAxisId axis : {timeAxis(), hzAxis()})
        setAxisVisible(axis, !isEmpty);

    QwtText title(m_heading);
    title.setFont(Theme::plotHeadingFont());
    title.setRenderFlags(Qt::AlignLeft | Qt::AlignVCenter);
    title.setColor(Theme::colours(*this).text);
    setTitle(title);
    Theme::style(*this);
    m_grid->setPen(Theme::colours(Theme::Kind::Dark).grid, 1.0);
    m_raster->setTimeVertical(isTimeVertical());
    m_overlay->isTimeVertical = isTimeVertical();
    m_overlay->colours = Theme::colours(*this);
    m_sentence->colour = m_overlay->colours.faintText;
    updateLayout(); // titles and scales of another size
    followSpan();
    updateLayout(); // and labels
    updateContent();
}

void WaterfallView::followSpan()
{
    choosePicture();
    const auto [time, hz] = visible();
    const QSize size = canvas()->contentsRect().size();
    const int along = isTimeVertical() ? size.height() : size.width();
    const int across = isTimeVertical() ? size.width() : size.height();
    auto *timeDraw = dynamic_cast<TimeScaleDraw *>(axisScaleDraw(timeAxis()));
    auto *numberDraw = dynamic_cast<NumberScaleDraw *>(axisScaleDraw(timeAxis()));
    auto *hzDraw = static_cast<NumberScaleDraw *>(axisScaleDraw(hzAxis()));

    const int timeSpacing = isTimeVertical() ? 42 : timeDraw && timeDraw->isClock() ? 90 : 60;
    const int timeTicks = std::clamp(along / timeSpacing, 1, 12);
    const QwtScaleDiv timeDiv = timeDraw ? timeScaleDiv(time, timeTicks) : linearScaleDiv(time, timeTicks);
    setAxisScaleDiv(timeAxis(), m_orientation == Orientation::OldestOnTop ? timeDiv.inverted() : timeDiv);
    setAxisScaleDiv(hzAxis(), linearScaleDiv(hz, std::clamp(across / (isTimeVertical() ? 60 : 42), 1, 12)));

    const QString timeLabel = timeDraw ? timeDraw->widestLabel(full().time) : numberDraw->widestLabel(full().time);
    const QString hzLabel = hzDraw->widestLabel(full().frequency);
    steadyAxes(*this, isTimeVertical() ? timeLabel : hzLabel, isTimeVertical() ? hzLabel : timeLabel);

    countHistogram();
    replot();
}

// ---- colours -------------------------------------------------------------------------------------------------------

void WaterfallView::countHistogram()
{
    const QSize size = canvas()->contentsRect().size();
    if (!m_picture || size.isEmpty() || m_frequency.count == 0)
        return;
    const Span hz = visible().frequency;
    const double frames = framesPerPixel();
    const double cells = hz.width() / m_frequency.step / (isTimeVertical() ? size.width() : size.height());
    // By powers of two in frequency and of four in time: while one zooms, colours change now and then, not all along.
    const auto group = static_cast<Index>(std::exp2(std::round(std::log2(std::max(cells, 1.0)))));
    const std::pair key{m_shown->levelFor(std::max(frames, 1.0)), group};
    if (key == m_histogramKey)
        return;
    m_histogramKey = key;
    m_histogram = countPixels(*m_shown, frames, static_cast<double>(group));
    emit histogramChanged();
    if (m_isRangeAutomatic)
        applyRange(automaticRange());
}

Span WaterfallView::automaticRange() const
{
    if (!m_picture || m_histogram.empty())
        return m_range;
    return faintline::automaticRange(m_picture->scale(), m_histogram, m_threshold);
}

void WaterfallView::applyRange(const Span &range)
{
    m_raster->setColours(*m_colourMap, range);
    if (range == m_range)
        return;
    m_range = range;
    emit rangeChanged(range.low, range.high);
}

void WaterfallView::setRange(double low, double high)
{
    constexpr double smallest = 0.5;
    m_isRangeAutomatic = false;
    if (m_picture && m_picture->scale().kind() == ByteScale::Kind::DifferenceNats) {
        // Zero stays in the middle of the colours: the end that was moved takes the other one along.
        const double half = std::max(low != m_range.low ? -low : high, smallest);
        applyRange({-half, half});
        return replot();
    }
    applyRange({low, std::max(high, low + smallest)});
    replot();
}

void WaterfallView::setAutomaticRange()
{
    m_isRangeAutomatic = true;
    applyRange(automaticRange());
    replot();
}

void WaterfallView::stepBlack(int steps)
{
    const double step = valueUnit() == tr("dB") ? 1.0 : 0.5;
    setRange(std::min(m_range.low + steps * step, m_range.high - step), m_range.high);
}

void WaterfallView::stepWhite(int steps)
{
    const double step = valueUnit() == tr("dB") ? 1.0 : 0.5;
    setRange(m_range.low, std::max(m_range.high + steps * step, m_range.low + step));
}

void WaterfallView::setColourMap(const QString &name)
{
    const ColourMap &map = ColourMap::named(name);
    if (&map == m_colourMap)
        return;
    m_colourMap = &map;
    m_raster->setColours(map, m_range);
    replot();
    emit colourMapChanged(map.name());
}

void WaterfallView::cycleColourMap()
{
    setColourMap(ColourMap::next(m_colourMap->name()));
}

// ---- orientation, layers, overlays ---------------------------------------------------------------------------------

void WaterfallView::setOrientation(Orientation orientation)
{
    if (orientation == m_orientation)
        return;
    m_orientation = orientation;
    layAxes();
    emit orientationChanged(orientation);
}

void WaterfallView::cycleOrientation()
{
    setOrientation(static_cast<Orientation>((static_cast<int>(m_orientation) + 1) % 3));
}

void WaterfallView::setThreshold(double nats)
{
    const std::optional<double> threshold = std::isnan(nats) ? std::nullopt : std::optional(nats);
    if (threshold == m_threshold)
        return;
    m_threshold = threshold;
    updateContent();
    emit thresholdChanged(nats);
}

void WaterfallView::setEvents(const std::vector<Event> &events)
{
    m_events = events;
    updateMarks();
}

void WaterfallView::setTracks(const std::vector<Track> &tracks, const Axis &time)
{
    m_overlay->tracks = OverlayItem::linesOf(tracks, time, m_frequency);
    updateMarks();
}

void WaterfallView::setTruth(const std::vector<TruthLine> &lines)
{
    m_overlay->truth = OverlayItem::linesOf(lines);
    replot();
}

void WaterfallView::setSelectedEvent(int id)
{
    m_selectedEvent = id;
    updateContent();
}

void WaterfallView::setFaintEvents(const std::vector<int> &ids)
{
    m_overlay->faintEvents = ids;
    replot();
}

void WaterfallView::setAnnotations(const std::vector<Annotation> &boxes)
{
    m_overlay->boxes.clear();
    constexpr double anyHz = 1e12;
    for (const Annotation &box : boxes)
        m_overlay->boxes.push_back({{{box.startSeconds, box.endSeconds}, {box.lowHz.value_or(-anyHz), box.highHz.value_or(anyHz)}},
                                    QString::fromStdString(box.label), box.verdict == Verdict::Rejected});
    replot();
}

void WaterfallView::setLayer(Layer layer, bool isOn)
{
    if (m_layers.testFlag(layer) == isOn)
        return;
    m_layers.setFlag(layer, isOn);
    updateContent();
    emit layersChanged();
}

void WaterfallView::setMeasuring(bool isOn)
{
    if (m_isMeasuring == isOn)
        return;
    m_isMeasuring = isOn;
    if (!isOn && m_viewport)
        m_viewport->clearSelection();
    emit measuringChanged(isOn);
}

void WaterfallView::setHarmonics(bool isOn)
{
    if (m_hasHarmonics == isOn)
        return;
    m_hasHarmonics = isOn;
    updateContent();
    emit harmonicsChanged(isOn);
}

void WaterfallView::setSidebandSpacing(double hz)
{
    if (hz == m_sidebandHz)
        return;
    m_sidebandHz = hz;
    updateContent();
    emit sidebandsChanged(hz);
}

void WaterfallView::setSidebands(bool isOn)
{
    if (!isOn || !m_picture || !m_viewport || m_frequency.unit != "Hz")
        return setSidebandSpacing(0.0);
    if (m_sidebandHz > 0.0)
        return;
    constexpr double share = 1.0 / 14.0; // so that five fit on either side of a carrier in the middle
    if (!m_viewport->cursor())
        m_viewport->setCursor({m_viewport->time().middle(), m_viewport->frequency().middle()});
    const double bins = std::max(std::round(share * m_viewport->frequency().width() / m_frequency.step), 1.0);
    setSidebandSpacing(bins * m_frequency.step);
}

void WaterfallView::setSelectionNote(const QString &note)
{
    m_selectionNote = note;
    updateContent();
}

std::optional<Viewport::Point> WaterfallView::peakAround(const Viewport::Point &point) const
{
    const QPointF position = positionOf(point), reach(peakReach, peakReach);
    const Viewport::Point a = pointAt(position - reach), b = pointAt(position + reach);
    const auto around = [](double p, double q, double middle, double step) {
        return Span{std::min({p, q, middle - step}), std::max({p, q, middle + step})};
    };
    const double row = m_picture->time().step * static_cast<double>(m_picture->framesPerRow(0));
    return faintline::peakNear(*m_picture, m_frequency,
                               {around(a.seconds, b.seconds, point.seconds, row), around(a.hz, b.hz, point.hz, m_frequency.step)});
}

void WaterfallView::moveCursorToPeak()
{
    if (!m_picture || !m_viewport || !m_viewport->cursor())
        return;
    if (const auto peak = peakAround(*m_viewport->cursor()))
        m_viewport->setCursor(*peak);
}

/// Where the pointer is; with Ctrl the strongest cell near it.
Viewport::Point WaterfallView::pointOf(const QMouseEvent &event) const
{
    const Viewport::Point point = pointAt(event.position());
    return event.modifiers().testFlag(Qt::ControlModifier) ? peakAround(point).value_or(point) : point;
}

void WaterfallView::updateMarks()
{
    const double frame = m_picture ? m_picture->time().step : 0.0;
    m_overlay->marks = OverlayItem::marksOf(m_events, m_overlay->tracks, frame, m_frequency.step);
    updateContent();
}

void WaterfallView::updateContent()
{
    m_grid->setVisible(m_picture && m_layers.testFlag(GridLayer));
    m_raster->setContour(m_layers.testFlag(ThresholdLayer) ? m_threshold : std::nullopt,
                         m_overlay->colours.contour.rgb());

    m_sentence->setVisible(!m_picture);
    m_overlay->setVisible(m_picture != nullptr);

    OverlayItem &overlay = *m_overlay;
    overlay.hasEvents = m_layers.testFlag(EventLayer);
    overlay.hasTracks = m_layers.testFlag(TrackLayer);
    overlay.hasTruth = m_layers.testFlag(TruthLayer);
    overlay.selectedEvent = m_selectedEvent;
    overlay.cursor = m_viewport && m_layers.testFlag(CursorLayer) ? m_viewport->cursor() : std::nullopt;
    overlay.selection = m_viewport ? m_viewport->selection() : std::nullopt;
    overlay.selectionText = selectionText();
    overlay.sidebands = sidebands();
    overlay.sidebandText = sidebandText();
    overlay.harmonicsHz.clear();
    if (m_hasHarmonics && m_frequency.unit == "Hz" && m_viewport && m_viewport->cursor())
        for (int i = 1; i <= harmonicCount; ++i)
            overlay.harmonicsHz.push_back(i * m_viewport->cursor()->hz);
    replot();
}

std::optional<Sidebands> WaterfallView::sidebands() const
{
    if (m_sidebandHz <= 0.0 || m_frequency.unit != "Hz" || !m_viewport || !m_viewport->cursor())
        return {};
    return Sidebands{m_viewport->cursor()->hz, m_sidebandHz};
}

QString WaterfallView::sidebandText() const
{
    const auto lines = sidebands();
    if (!lines)
        return {};
    const auto level = [&](int order) {
        const auto value = valueAt(m_viewport->cursor()->seconds, lines->hz(order));
        return (value ? numberText(*value, 1) : QStringLiteral("–")).rightJustified(7);
    };
    QStringList rows{tr("carrier %1 %2 %3").arg(hertzText(lines->carrierHz, m_frequency.step), level(0), valueUnit()),
                     tr("spacing %1").arg(hertzText(lines->spacingHz, 0.1 * m_frequency.step)), tr(" n     −n     +n %1").arg(valueUnit())};
    for (int order = 1; order <= Sidebands::orders; ++order)
        rows << QStringLiteral("%1 %2%3").arg(order, 2).arg(level(-order), level(order));
    return rows.join(QLatin1Char('\n'));
}

QString WaterfallView::selectionText() const
{
    if (!m_viewport || !m_viewport->selection())
        return {};
    const Viewport::Box box = *m_viewport->selection();
    const double seconds = box.time.width(), hz = box.frequency.width();
    QStringList words;
    if (hasTime())
        words << tr("Δt %1").arg(secondsText(seconds, 0.01 * seconds));
    else
        words << QStringLiteral("Δ ") + valueText(m_picture->time(), seconds, 0.01 * seconds);
    if (m_frequency.unit == "Hz" || m_frequency.unit.empty())
        words << tr("Δf %1").arg(hertzText(hz, 0.01 * hz));
    else
        words << QStringLiteral("Δ ") + valueText(m_frequency, hz, 0.01 * hz);
    if (seconds > 0.0 && hasTime())
        words << tr("%1 %2/s").arg(powerText(hz / seconds, 3), m_frequency.unit.empty()
                                                                   ? QStringLiteral("Hz")
                                                                   : QString::fromStdString(m_frequency.unit));
    const auto cellsOf = [](const Axis &axis, Index count, const Span &span) {
        const auto clamped = [count](double index) { return std::clamp<Index>(std::lround(index), 0, count - 1); };
        return std::pair(clamped(axis.position(span.low)), clamped(axis.position(span.high)) + 1);
    };
    if (m_picture && m_picture->frameCount() > 0 && m_frequency.count > 0) {
        const PeakPyramid &picture = pictureOf(box.time);
        const auto [firstFrame, endFrame] = cellsOf(picture.time(), picture.frameCount(), box.time);
        const auto [firstCell, endCell] = cellsOf(m_frequency, m_frequency.count, box.frequency);
        const BoxValues values = boxValues(picture, firstFrame, endFrame, firstCell, endCell);
        words << tr("peak %1 %2").arg(numberText(values.peak, 1), valueUnit());
        if (values.mean)
            words << tr("mean %1 dB").arg(numberText(*values.mean, 1));
    }
    constexpr qsizetype extents = 3; // a line of these, then one of the levels
    const QString levels = words.size() > extents ? words.mid(extents).join(QStringLiteral(" · ")) : QString();
    QStringList lines{words.mid(0, extents).join(QStringLiteral(" · ")), levels, m_selectionNote};
    lines.removeAll(QString());
    return lines.join(QLatin1Char('\n'));
}

void WaterfallView::followCursor()
{
    QString text = tr("Arrow keys move the cursor, Ctrl and wheel zoom, 0 shows all.");
    if (m_viewport && m_viewport->cursor()) {
        const Viewport::Point &cursor = *m_viewport->cursor();
        const auto value = valueAt(cursor.seconds, cursor.hz);
        text = tr("Cursor at %1, %2")
                   .arg(hasTime() ? secondsText(cursor.seconds, 0.01) : valueText(m_picture->time(), cursor.seconds, 0.1),
                        m_frequency.unit == "Hz" ? hertzText(cursor.hz, 0.1) : valueText(m_frequency, cursor.hz, 0.1));
        if (value)
            text += tr(", %1 %2").arg(numberText(*value, 1), valueUnit());
    }
    setAccessibleDescription(text);
    updateContent();
}

int WaterfallView::eventAt(const QPointF &position) const
{
    int nearest = 0;
    double smallest = std::numeric_limits<double>::infinity();
    for (const OverlayItem::Mark &mark : m_overlay->marks) {
        const QRectF frame = OverlayItem::frameOf(
            OverlayItem::rectOf(mark.box, canvasMap(QwtAxis::XBottom), canvasMap(QwtAxis::YLeft), isTimeVertical()));
        const double area = frame.width() * frame.height();
        if (frame.contains(position) && area < smallest) {
            smallest = area;
            nearest = mark.id;
        }
    }
    return nearest;
}

// ---- mouse ---------------------------------------------------------------------------------------------------------

bool WaterfallView::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == canvas() && event->type() == QEvent::Resize)
        followSpan(); // ticks and colours depend on the canvas as laid out, not on the window
    if (watched != canvas() || !m_picture || !m_viewport)
        return QwtPlot::eventFilter(watched, event);
    switch (event->type()) {
    case QEvent::MouseButtonPress:
        pressed(*static_cast<QMouseEvent *>(event));
        return true;
    case QEvent::MouseMove:
        moved(*static_cast<QMouseEvent *>(event));
        return true;
    case QEvent::MouseButtonRelease:
        released(*static_cast<QMouseEvent *>(event));
        return true;
    case QEvent::MouseButtonDblClick:
        if (const int id = eventAt(static_cast<QMouseEvent *>(event)->position()))
            emit eventActivated(id);
        return true;
    case QEvent::Leave:
        emit hoverEnded();
        break;
    default:
        break;
    }
    return QwtPlot::eventFilter(watched, event);
}

void WaterfallView::pressed(const QMouseEvent &event)
{
    setFocus(Qt::MouseFocusReason);
    if (event.button() != Qt::LeftButton && event.button() != Qt::MiddleButton)
        return;
    m_dragStart = event.position();
    m_dragVisible = m_viewport->visible();
    m_dragOrigin = pointAt(event.position());
    m_draggedOrder = sidebandAt(event.position());
    m_drag = event.button() == Qt::MiddleButton              ? Drag::Pan
             : event.modifiers().testFlag(Qt::ShiftModifier) ? Drag::Zoom
             : m_draggedOrder != 0                           ? Drag::Sideband
             : m_isMeasuring                                 ? Drag::Measure
                                                             : Drag::Press;
    if (m_drag == Drag::Measure)
        m_dragOrigin = pointOf(event);
}

/// The sideband whose line is under the pointer; 0 where there is none, or the carrier.
int WaterfallView::sidebandAt(const QPointF &position) const
{
    const auto lines = sidebands();
    if (!lines)
        return 0;
    const int order = lines->nearestOrder(pointAt(position).hz);
    const QPointF line = positionOf({m_viewport->cursor()->seconds, lines->hz(order)});
    return std::abs(isTimeVertical() ? line.x() - position.x() : line.y() - position.y()) <= sidebandReach ? order : 0;
}

void WaterfallView::dragSideband(const QMouseEvent &event)
{
    setSidebandSpacing(std::max(sidebands()->spacingFor(m_draggedOrder, pointOf(event).hz), m_frequency.step));
}

Viewport::Box WaterfallView::draggedBox(const Viewport::Point &to) const
{
    const Viewport::Point a = m_dragOrigin, b = to;
    const Viewport::Box &full = m_viewport->full();
    const auto spanOf = [](double p, double q, const Span &limits) {
        return Span{std::max(std::min(p, q), limits.low), std::min(std::max(p, q), limits.high)};
    };
    return {spanOf(a.seconds, b.seconds, full.time), spanOf(a.hz, b.hz, full.frequency)};
}

void WaterfallView::moved(const QMouseEvent &event)
{
    hover(event.position());
    const QPointF way = event.position() - m_dragStart;
    if (m_drag == Drag::Press && way.manhattanLength() >= clickSlop) {
        m_drag = Drag::Pan;
        canvas()->setCursor(Qt::ClosedHandCursor);
    }
    if (m_drag == Drag::Pan) {
        const QwtScaleMap time = canvasMap(timeAxis()), hz = canvasMap(hzAxis());
        const auto travel = [](const QwtScaleMap &map, double from, double to) {
            return map.invTransform(to) - map.invTransform(from);
        };
        const double seconds = isTimeVertical() ? travel(time, m_dragStart.y(), event.position().y())
                                                : travel(time, m_dragStart.x(), event.position().x());
        const double shift = isTimeVertical() ? travel(hz, m_dragStart.x(), event.position().x())
                                              : travel(hz, m_dragStart.y(), event.position().y());
        m_viewport->pan(m_dragVisible.time.low - seconds - m_viewport->time().low,
                        m_dragVisible.frequency.low - shift - m_viewport->frequency().low);
    } else if (m_drag == Drag::Zoom) {
        m_overlay->rubber = draggedBox(pointAt(event.position()));
        replot();
    } else if (m_drag == Drag::Measure) {
        m_viewport->setSelection(draggedBox(pointOf(event)));
    } else if (m_drag == Drag::Sideband) {
        dragSideband(event);
    } else if (m_drag == Drag::None) {
        const auto across = isTimeVertical() ? Qt::SplitHCursor : Qt::SplitVCursor;
        canvas()->setCursor(sidebandAt(event.position()) != 0 ? across : Qt::CrossCursor);
    }
}

void WaterfallView::released(const QMouseEvent &event)
{
    const Drag drag = std::exchange(m_drag, Drag::None);
    const bool isClick = (event.position() - m_dragStart).manhattanLength() < clickSlop;
    canvas()->setCursor(Qt::CrossCursor);
    m_overlay->rubber.reset();
    if (drag == Drag::Zoom && !isClick) {
        const Viewport::Box box = draggedBox(pointAt(event.position()));
        m_viewport->zoomTo(box.time, box.frequency);
    } else if (drag == Drag::Press || (drag == Drag::Measure && isClick)) {
        m_viewport->setCursor(pointOf(event));
    }
    replot();
}

void WaterfallView::hover(const QPointF &position)
{
    const Viewport::Point point = pointAt(position);
    if (const auto value = valueAt(point.seconds, point.hz))
        emit hovered(point.seconds, point.hz, *value);
    else
        emit hoverEnded();
}

void WaterfallView::scroll(Qt::Orientation direction, double notches)
{
    const bool isTime = (direction == Qt::Vertical) == isTimeVertical();
    const Span span = isTime ? m_viewport->time() : m_viewport->frequency();
    // The wheel away from oneself goes up or to the left; up is later with the newest on top, and higher in frequency.
    const bool isUpward = direction == Qt::Vertical && (isTime ? m_orientation == Orientation::NewestOnTop : true);
    const double shift = notches * scrollShare * span.width() * (isUpward ? 1.0 : -1.0);
    m_viewport->pan(isTime ? shift : 0.0, isTime ? 0.0 : shift);
}

void WaterfallView::wheelEvent(QWheelEvent *event)
{
    if (!m_picture || !m_viewport) {
        event->ignore();
        return;
    }
    const QPoint position = event->position().toPoint();
    const Viewport::Point point = pointAt(canvas()->mapFrom(this, event->position()));
    const double notches = notchesOf(*event);
    const auto isOver = [&](QwtAxisId axis) {
        return isAxisVisible(axis) && axisWidget(axis)->geometry().contains(position);
    };
    if (isOver(timeAxis()))
        m_viewport->zoomAt(std::pow(zoomPerNotch, notches), point, Viewport::Axes::Time);
    else if (isOver(hzAxis()))
        m_viewport->zoomAt(std::pow(zoomPerNotch, notches), point, Viewport::Axes::Frequency);
    else if (event->modifiers().testFlag(Qt::ControlModifier))
        m_viewport->zoomAt(std::pow(zoomPerNotch, notches), point);
    else if (event->modifiers().testFlag(Qt::ShiftModifier))
        scroll(isTimeVertical() ? Qt::Horizontal : Qt::Vertical, notches);
    else
        scroll(isTimeVertical() ? Qt::Vertical : Qt::Horizontal, notches);
    event->accept();
}

// ---- keyboard ------------------------------------------------------------------------------------------------------

void WaterfallView::moveCursor(int right, int up, int cells)
{
    const auto &cursor = m_viewport->cursor();
    Viewport::Point point =
        cursor ? *cursor : Viewport::Point{m_viewport->time().middle(), m_viewport->frequency().middle()};
    const int timeSteps = isTimeVertical() ? (m_orientation == Orientation::NewestOnTop ? up : -up) : right;
    const int hzSteps = isTimeVertical() ? right : up;
    // From cell centre to cell centre, so that every key press reads another cell.
    const auto moved = [](const Axis &axis, Index count, double value, Index by) {
        const auto index = static_cast<Index>(std::lround(axis.position(value)));
        return axis.value(static_cast<double>(std::clamp<Index>(index + by, 0, count - 1)));
    };
    point.seconds = moved(m_picture->time(), m_picture->frameCount(), point.seconds, timeSteps * cells);
    point.hz = moved(m_frequency, m_frequency.count, point.hz, hzSteps * cells);
    m_viewport->setCursor(point);

    const Span &time = m_viewport->time(), &hz = m_viewport->frequency();
    const auto beyond = [](const Span &span, double value) {
        return value < span.low ? value - span.low : value > span.high ? value - span.high : 0.0;
    };
    m_viewport->pan(beyond(time, point.seconds), beyond(hz, point.hz));
}

void WaterfallView::keyPressEvent(QKeyEvent *event)
{
    const int cells = event->modifiers().testFlag(Qt::ControlModifier) ? 10 : 1;
    const std::pair<int, std::function<void()>> cursorKeys[] = {
        {Qt::Key_Left, [=, this] { moveCursor(-1, 0, cells); }},
        {Qt::Key_Right, [=, this] { moveCursor(1, 0, cells); }},
        {Qt::Key_Up, [=, this] { moveCursor(0, 1, cells); }},
        {Qt::Key_Down, [=, this] { moveCursor(0, -1, cells); }},
    };
    const std::pair<int, std::function<void()>> plainKeys[] = {
        {Qt::Key_Backspace, [this] { m_viewport->zoomBack(); }},
        {Qt::Key_0, [this] { m_viewport->showAll(); }},
        {Qt::Key_O, [this] { cycleOrientation(); }},
        {Qt::Key_BracketLeft, [this] { stepBlack(-1); }},
        {Qt::Key_BracketRight, [this] { stepBlack(1); }},
        {Qt::Key_BraceLeft, [this] { stepWhite(-1); }},
        {Qt::Key_BraceRight, [this] { stepWhite(1); }},
        {Qt::Key_A, [this] { setAutomaticRange(); }},
        {Qt::Key_C, [this] { cycleColourMap(); }},
        {Qt::Key_Comma, [this] { emit thresholdStepRequested(-1); }},
        {Qt::Key_Period, [this] { emit thresholdStepRequested(1); }},
        {Qt::Key_M, [this] { setMeasuring(!m_isMeasuring); }},
        {Qt::Key_H, [this] { setHarmonics(!m_hasHarmonics); }},
        {Qt::Key_I, [this] { setSidebands(m_sidebandHz == 0.0); }},
        {Qt::Key_K, [this] { moveCursorToPeak(); }},
        {Qt::Key_Escape, [this] { clearMarks(); }},
    };
    const bool isPlain = !(event->modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier));
    const auto act = [&](const auto &keys) {
        const auto isPressed = [&](const auto &entry) { return entry.first == event->key(); };
        const auto found = std::find_if(std::begin(keys), std::end(keys), isPressed);
        if (found == std::end(keys))
            return false;
        found->second();
        return true;
    };
    const std::pair<int, std::function<void()>> spacingKeys[] = {
        {Qt::Key_Left, [this] { setSidebandSpacing(std::max(m_sidebandHz - m_frequency.step, m_frequency.step)); }},
        {Qt::Key_Right, [this] { setSidebandSpacing(m_sidebandHz + m_frequency.step); }},
    };
    const bool isSpacing = sidebands() && event->modifiers().testFlag(Qt::AltModifier);
    const bool isDone = m_picture && m_viewport && ((isSpacing && act(spacingKeys)) || act(cursorKeys) || (isPlain && act(plainKeys)));
    if (!isDone)
        QwtPlot::keyPressEvent(event);
}

void WaterfallView::clearMarks()
{
    setMeasuring(false);
    setHarmonics(false);
    setSidebandSpacing(0.0);
    m_viewport->clearSelection();
    m_viewport->clearCursor();
}

// ---- menu, look ----------------------------------------------------------------------------------------------------

void WaterfallView::fillMenu(QMenu &menu)
{
    const auto add = [this](QMenu &to, const QString &text, const QString &key, auto act) {
        // The key is text only: as a shortcut it would take the key from the view that has the focus.
        QAction *action = to.addAction(key.isEmpty() ? text : text + QLatin1Char('\t') + key);
        connect(action, &QAction::triggered, this, act);
        return action;
    };
    const auto check = [&](QMenu &to, const QString &text, const QString &key, bool isOn, auto act) {
        QAction *action = add(to, text, key, act);
        action->setCheckable(true);
        action->setChecked(isOn);
        return action;
    };
    add(menu, tr("Show all"), QStringLiteral("0"), [this] {
        m_viewport->showAll();
    })->setEnabled(m_viewport && !m_viewport->showsAll());
    add(menu, tr("Zoom back"), tr("Backspace"), [this] {
        m_viewport->zoomBack();
    })->setEnabled(m_viewport && m_viewport->canZoomBack());
    menu.addSeparator();

    QMenu &orientations = *menu.addMenu(tr("Orientation"));
    auto *orientationGroup = new QActionGroup(&orientations);
    const QStringList names{tr("Newest on top"), tr("Oldest on top"), tr("Left to right")};
    for (int i = 0; i < names.size(); ++i)
        orientationGroup->addAction(check(orientations, names[i], QString(), static_cast<int>(m_orientation) == i,
                                          [this, i] { setOrientation(static_cast<Orientation>(i)); }));
    QMenu &colours = *menu.addMenu(tr("Colours"));
    auto *colourGroup = new QActionGroup(&colours);
    for (const QString &name : ColourMap::names())
        colourGroup->addAction(
            check(colours, name, QString(), name == m_colourMap->name(), [this, name] { setColourMap(name); }));
    check(menu, tr("Automatic range"), QStringLiteral("A"), m_isRangeAutomatic, [this] { setAutomaticRange(); });

    QMenu &layers = *menu.addMenu(tr("Show"));
    const std::pair<Layer, QString> rows[] = {{EventLayer, tr("Events")}, {TrackLayer, tr("Tracks")},
                                              {TruthLayer, tr("Truth")},  {ThresholdLayer, tr("Threshold contour")},
                                              {GridLayer, tr("Grid")},    {CursorLayer, tr("Cursor")}};
    for (const auto &[layer, text] : rows)
        check(layers, text, QString(), m_layers.testFlag(layer),
              [this, layer = layer](bool isOn) { setLayer(layer, isOn); });
    menu.addSeparator();
    check(menu, tr("Measure a box"), QStringLiteral("M"), m_isMeasuring, [this](bool isOn) { setMeasuring(isOn); });
    if (m_frequency.unit == "Hz") {
        check(menu, tr("Harmonics of the cursor"), QStringLiteral("H"), m_hasHarmonics,
              [this](bool isOn) { setHarmonics(isOn); });
        check(menu, tr("Sidebands of the cursor"), QStringLiteral("I"), m_sidebandHz > 0.0, [this](bool isOn) { setSidebands(isOn); });
    }
    add(menu, tr("Cursor to the peak nearby"), QStringLiteral("K"), [this] {
        moveCursorToPeak();
    })->setEnabled(m_viewport && m_viewport->cursor());
}

void WaterfallView::addActionsTo(QMenu *menu)
{
    fillMenu(*menu);
}

void WaterfallView::contextMenuEvent(QContextMenuEvent *event)
{
    if (!m_picture || !m_viewport)
        return;
    const Viewport::Point point = pointAt(canvas()->mapFrom(this, event->pos()));
    QMenu menu(this);
    fillMenu(menu);
    emit contextMenuRequested(&menu, point.seconds, point.hz);
    menu.exec(event->globalPos());
}

void WaterfallView::changeEvent(QEvent *event)
{
    QwtPlot::changeEvent(event);
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::StyleChange)
        layAxes();
}

void WaterfallView::focusInEvent(QFocusEvent *event)
{
    QwtPlot::focusInEvent(event);
    Theme::frame(*this);
}

void WaterfallView::focusOutEvent(QFocusEvent *event)
{
    QwtPlot::focusOutEvent(event);
    Theme::frame(*this);
}

} // namespace faintline

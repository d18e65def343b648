#include "widgets/WaterfallView.h"

#include "widgets/CanvasSentence.h"
#include "widgets/NumberScaleDraw.h"
#include "widgets/OverlayItem.h"
#include "widgets/RasterItem.h"
#include "widgets/Theme.h"
#include "widgets/TimeScaleDraw.h"
#include "widgets/WaterfallMouse.h"
#include "widgets/axisWords.h"
#include "widgets/labelText.h"
#include "widgets/peakNear.h"
#include "widgets/scaleTicks.h"
#include "widgets/steadyAxes.h"
#include "widgets/waterfallCommands.h"
#include "widgets/waterfallWords.h"

#include <qwt_plot_grid.h>
#include <qwt_scale_map.h>
#include <qwt_text.h>

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double longSeconds = 600.0; ///< recordings from here on are labelled h:min:s
    constexpr int harmonicCount = 12;
    constexpr double peakReach = 12.0; ///< pixels

    bool measuresTime(const Axis &axis)
    {
        return axis.unit == "s" || axis.unit.empty();
    }

} // namespace

WaterfallView::WaterfallView(const QString &heading, QWidget *parent)
    : ThemedPlot(parent), m_heading(heading), m_raster(new RasterItem), m_overlay(new OverlayItem),
      m_sentence(new CanvasSentence), m_grid(new QwtPlotGrid), m_colourMap(&ColourMap::named(ColourMap::defaultName())),
      m_mouse(std::make_unique<WaterfallMouse>(*this))
{
    m_sentence->text = tr("Open a recording or choose a scenario to see something here.");
    m_sentence->pixelSize = 14;
    m_sentence->attach(this);
    m_raster->attach(this);
    m_grid->setZ(5.0);
    m_grid->attach(this);
    m_overlay->attach(this);
    setAccessibleName(tr("%1 waterfall").arg(heading));
    restyle();
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
        connect(viewport, &Viewport::extentsChanged, this, &WaterfallView::restyle);
        connect(viewport, &Viewport::cursorChanged, this, &WaterfallView::followCursor);
        connect(viewport, &Viewport::selectionChanged, this, [this] {
            m_selectionNote.clear();
            updateContent();
        });
    }
    restyle();
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
    m_levels.countAgain();
    if (!m_picture) {
        m_levels.clearHistogram();
        emit histogramChanged();
    }
    if (isOtherKind)
        m_levels.setAutomatic(true);
    hasSameAxes ? countHistogram() : restyle();
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
    const bool wasAutomatic = m_levels.isAutomatic();
    m_levels.setAutomatic(false);
    countHistogram();
    m_levels.setAutomatic(wasAutomatic);
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
    m_levels.countAgain();
    emit shownPictureChanged();
}

const PeakPyramid &WaterfallView::finestPicture(const Span &time) const
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
    restyle();
}

std::optional<double> WaterfallView::valueAt(double seconds, double hz) const
{
    if (!m_picture || m_picture->rowCount(0) == 0)
        return {};
    const Viewport::Box box = extents(m_picture->time(), m_frequency);
    if (!box.time.contains(seconds) || !box.frequency.contains(hz))
        return {};
    const PeakPyramid &picture = finestPicture({seconds, seconds});
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

void WaterfallView::restyle()
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
    const double cells = visible().frequency.width() / m_frequency.step / (isTimeVertical() ? size.width() : size.height());
    if (!m_levels.count(*m_shown, framesPerPixel(), cells))
        return;
    emit histogramChanged();
    if (m_levels.isAutomatic())
        applyRange(automaticRange());
}

Span WaterfallView::automaticRange() const
{
    return m_picture ? m_levels.suggested(m_picture->scale(), m_threshold) : range();
}

void WaterfallView::applyRange(const Span &range)
{
    m_raster->setColours(*m_colourMap, range);
    if (range == m_levels.range())
        return;
    m_levels.setRange(range);
    emit rangeChanged(range.low, range.high);
}

void WaterfallView::setRange(double low, double high)
{
    m_levels.setAutomatic(false);
    applyRange(m_levels.byHand(low, high, m_picture ? &m_picture->scale() : nullptr));
    replot();
}

void WaterfallView::setAutomaticRange()
{
    m_levels.setAutomatic(true);
    applyRange(automaticRange());
    replot();
}

double WaterfallView::levelStep() const
{
    return valueUnit() == tr("dB") ? 1.0 : 0.5;
}

void WaterfallView::stepBlack(int steps)
{
    const double step = levelStep();
    setRange(std::min(range().low + steps * step, range().high - step), range().high);
}

void WaterfallView::stepWhite(int steps)
{
    const double step = levelStep();
    setRange(range().low, std::max(range().high + steps * step, range().low + step));
}

void WaterfallView::setColourMap(const QString &name)
{
    const ColourMap &map = ColourMap::named(name);
    if (&map == m_colourMap)
        return;
    m_colourMap = &map;
    m_raster->setColours(map, range());
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
    restyle();
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
                                    labelText(box.label, 40), box.verdict == Verdict::Rejected});
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
    return lines ? faintline::sidebandText(*this, *lines, m_viewport->cursor()->seconds) : QString();
}

QString WaterfallView::selectionText() const
{
    if (!m_viewport || !m_viewport->selection())
        return {};
    const QString text = boxText(*this, *m_viewport->selection());
    return m_selectionNote.isEmpty() ? text : text + QLatin1Char('\n') + m_selectionNote;
}

void WaterfallView::followCursor()
{
    setAccessibleDescription(cursorText(*this));
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

void WaterfallView::setRubber(const std::optional<Viewport::Box> &box)
{
    m_overlay->rubber = box;
    replot();
}

// ---- mouse and keyboard ---------------------------------------------------------------------------------------------

void WaterfallView::wheelEvent(QWheelEvent *event)
{
    event->setAccepted(m_picture && m_viewport);
    if (event->isAccepted())
        m_mouse->turnWheel(*event);
}

void WaterfallView::keyPressEvent(QKeyEvent *event)
{
    if (!pressKey(*this, *event))
        ThemedPlot::keyPressEvent(event);
}

void WaterfallView::contextMenuEvent(QContextMenuEvent *event)
{
    if (!m_picture || !m_viewport)
        return;
    const Viewport::Point point = pointAt(canvas()->mapFrom(this, event->pos()));
    QMenu menu(this);
    addCommands(menu, *this);
    emit contextMenuRequested(&menu, point.seconds, point.hz);
    menu.exec(event->globalPos());
}

} // namespace faintline

#include "widgets/waterfall/MarkedWaterfall.h"

#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/waterfall/OverlayItem.h"
#include "widgets/waterfall/waterfallWords.h"

#include <qwt_plot_grid.h>
#include <qwt_scale_map.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace faintline {

namespace {

    constexpr int harmonicCount = 12;

} // namespace

MarkedWaterfall::MarkedWaterfall(const QString &heading, PictureDisplay *shown, TimeDirection *direction)
    : WaterfallPicture(heading, shown, direction), m_overlay(new OverlayItem), m_grid(new QwtPlotGrid)
{
    m_grid->setZ(5.0);
    m_grid->setPen(Theme::colours(Theme::Kind::Dark).grid, 1.0);
    m_grid->attach(this);
    m_overlay->attach(this);
    connect(&display(), &PictureDisplay::layersChanged, this, &MarkedWaterfall::updateContent);
    connect(&display(), &PictureDisplay::linesChanged, this, &MarkedWaterfall::updateContent);
    connect(&display(), &PictureDisplay::measuringChanged, this, [this] {
        if (!display().isMeasuring() && viewport())
            viewport()->clearSelection();
    });
    followCursor();
}

// ---- the picture below ---------------------------------------------------------------------------------------------

void MarkedWaterfall::setViewport(Viewport *viewport)
{
    WaterfallPicture::setViewport(viewport);
    if (viewport) {
        connect(viewport, &Viewport::cursorChanged, this, &MarkedWaterfall::followCursor);
        connect(viewport, &Viewport::selectionChanged, this, [this] {
            m_selectionNote.clear();
            updateContent();
        });
    }
    followCursor();
}

void MarkedWaterfall::setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency)
{
    WaterfallPicture::setPicture(std::move(picture), frequency);
    updateMarks();
}

void MarkedWaterfall::setNextPicture(std::shared_ptr<const PeakPyramid> picture)
{
    WaterfallPicture::setNextPicture(std::move(picture));
    followCursor();
}

// ---- layers and marks ----------------------------------------------------------------------------------------------

void MarkedWaterfall::setEvents(const std::vector<Event> &events)
{
    m_events = events;
    updateMarks();
}

void MarkedWaterfall::setTracks(const std::vector<Track> &tracks, const Axis &time)
{
    m_overlay->tracks = overlayLines(tracks, time, frequencyAxis());
    updateMarks();
}

void MarkedWaterfall::setLiveTracks(const std::vector<Event> &events,
                                    const std::vector<std::shared_ptr<const Track>> &tracks, const Axis &time)
{
    std::map<int, TrackStage> stages;
    for (const Event &event : events)
        stages[event.id] = stageOf(event);
    std::vector<Track> known;
    for (const auto &track : tracks)
        if (stages.contains(track->id))
            known.push_back(*track);
    m_events = events;
    m_overlay->tracks = overlayLines(known, time, frequencyAxis());
    for (OverlayLine &line : m_overlay->tracks)
        line.stage = stages[line.id];
    updateMarks();
    for (OverlayMark &mark : m_overlay->marks)
        mark.stage = stages[mark.id];
}

void MarkedWaterfall::setTimes(const std::vector<OverlayTime> &times)
{
    m_overlay->times = times;
    replot();
}

void MarkedWaterfall::setAreas(const std::vector<AreaEvent> &areas)
{
    m_overlay->areas = overlayBoxes(areas);
    replot();
}

void MarkedWaterfall::setTruth(const std::vector<TruthLine> &lines)
{
    m_overlay->truth = overlayLines(lines);
    replot();
}

void MarkedWaterfall::setSelectedEvent(int id)
{
    if (std::exchange(m_selectedEvent, id) != id)
        updateContent();
}

void MarkedWaterfall::setHoveredEvent(int id)
{
    if (std::exchange(m_overlay->hoveredEvent, id) != id)
        replot();
}

void MarkedWaterfall::setTracksPictured(bool arePictured)
{
    m_overlay->areTracksPictured = arePictured;
}

void MarkedWaterfall::setFaintEvents(const std::vector<int> &ids)
{
    m_overlay->faintEvents = ids;
    replot();
}

void MarkedWaterfall::setAnnotations(const std::vector<Annotation> &boxes)
{
    m_overlay->boxes.clear();
    constexpr double anyHz = 1e12;
    for (const Annotation &box : boxes)
        m_overlay->boxes.push_back(
            {{{box.startSeconds, box.endSeconds}, {box.lowHz.value_or(-anyHz), box.highHz.value_or(anyHz)}},
             labelText(box.label, 40),
             box.verdict == Verdict::Rejected});
    replot();
}

void MarkedWaterfall::updateMarks()
{
    const double frame = picture() ? picture()->time().step : 0.0;
    m_overlay->marks = overlayMarks(m_events, m_overlay->tracks, frame, frequencyAxis().step);
    updateContent();
}

void MarkedWaterfall::updateContent()
{
    OverlayItem &overlay = *m_overlay;
    overlay.colours = Theme::colours(*this);
    overlay.isTimeVertical = isTimeVertical();
    overlay.setVisible(picture() != nullptr);
    m_grid->setVisible(picture() && display().shows(PictureDisplay::GridLayer));

    overlay.hasEvents = display().shows(PictureDisplay::EventLayer);
    overlay.hasTracks = display().shows(PictureDisplay::TrackLayer);
    overlay.hasTruth = display().shows(PictureDisplay::TruthLayer);
    overlay.selectedEvent = m_selectedEvent;
    overlay.cursor = viewport() && display().shows(PictureDisplay::CursorLayer) ? viewport()->cursor() : std::nullopt;
    overlay.selection = viewport() ? viewport()->selection() : std::nullopt;
    overlay.selectionText = selectionText();
    overlay.sidebands = sidebands();
    overlay.sidebandText = sidebandText();
    overlay.cursorNote = m_cursorNote;
    overlay.harmonicsHz.clear();
    if (display().hasHarmonics() && frequencyAxis().unit == "Hz" && viewport() && viewport()->cursor())
        for (int i = 1; i <= harmonicCount; ++i)
            overlay.harmonicsHz.push_back(i * viewport()->cursor()->hz);
    WaterfallPicture::updateContent();
}

PictureColours MarkedWaterfall::colours() const
{
    PictureColours colours = WaterfallPicture::colours();
    colours.contour = display().shows(PictureDisplay::ThresholdLayer) ? threshold() : std::nullopt;
    colours.contourColour = Theme::colours(*this).contour.rgb();
    return colours;
}

int MarkedWaterfall::eventAt(const QPointF &position) const
{
    int nearest = 0;
    double smallest = std::numeric_limits<double>::infinity();
    for (const OverlayMark &mark : m_overlay->marks) {
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

void MarkedWaterfall::setRubber(const std::optional<Viewport::Box> &box)
{
    m_overlay->rubber = box;
    replot();
}

// ---- cursor and measurements ---------------------------------------------------------------------------------------

void MarkedWaterfall::followCursor()
{
    setAccessibleDescription(cursorText(*this));
    updateContent();
}

void MarkedWaterfall::moveCursorToPeak()
{
    if (!picture() || !viewport() || !viewport()->cursor())
        return;
    if (const auto peak = peakAround(*viewport()->cursor()))
        viewport()->setCursor(*peak);
}

QString MarkedWaterfall::selectionText() const
{
    if (!viewport() || !viewport()->selection())
        return {};
    const QString text = boxText(*this, *viewport()->selection());
    return m_selectionNote.isEmpty() ? text : text + QLatin1Char('\n') + m_selectionNote;
}

void MarkedWaterfall::setCursorNote(const QString &note)
{
    if (note == m_cursorNote)
        return;
    m_cursorNote = note;
    updateContent();
}

void MarkedWaterfall::setSelectionNote(const QString &note)
{
    m_selectionNote = note;
    updateContent();
}

std::optional<Sidebands> MarkedWaterfall::sidebands() const
{
    if (display().sidebandSpacing() <= 0.0 || frequencyAxis().unit != "Hz" || !viewport() || !viewport()->cursor())
        return {};
    return Sidebands{viewport()->cursor()->hz, display().sidebandSpacing()};
}

void MarkedWaterfall::setSidebands(bool isOn)
{
    if (!isOn || !picture() || !viewport() || frequencyAxis().unit != "Hz")
        return display().setSidebandSpacing(0.0);
    if (display().sidebandSpacing() > 0.0)
        return;
    constexpr double share = 1.0 / 14.0; // so that five fit on either side of a centred carrier
    if (!viewport()->cursor())
        viewport()->setCursor({viewport()->time().middle(), viewport()->frequency().middle()});
    const double bins = std::max(std::round(share * viewport()->frequency().width() / frequencyAxis().step), 1.0);
    display().setSidebandSpacing(bins * frequencyAxis().step);
}

QString MarkedWaterfall::sidebandText() const
{
    const auto lines = sidebands();
    return lines ? faintline::sidebandText(*this, *lines, viewport()->cursor()->seconds) : QString();
}

} // namespace faintline

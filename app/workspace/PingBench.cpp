#include "app/workspace/PingBench.h"

#include "app/control/OutputLayers.h"
#include "app/document/statisticUnit.h"
#include "app/workspace/PingBar.h"
#include "app/workspace/PingRegulation.h"
#include "app/workspace/pingReading.h"
#include "app/workspace/strongestPlace.h"
#include "spectrum/pictureCuts.h"
#include "widgets/base/TimeStack.h"
#include "widgets/pings/PingMap.h"
#include "widgets/pings/PolarView.h"

#include <QShortcut>
#include <QSplitter>

#include <algorithm>
#include <utility>

namespace faintline {

PingBench::PingBench(Document &document, OutputLayers &layers, QWidget *parent)
    : Bench(document, pingFrames(), parent), m_layers(layers), m_viewports(document.viewport()),
      m_input(new PingMap(tr("Input (dB over noise)"), m_viewports.map())),
      m_output(new PingMap(tr("Statistic D (nat)"), m_viewports.map())), m_bar(new PingBar),
      m_rangeHistory(new WaterfallView(tr("D over range, best bearing"))),
      m_bearingHistory(new WaterfallView(tr("D over bearing, best range"))),
      m_regulation(new PingRegulation(m_viewports.rangeTime())), m_maps(new QSplitter(Qt::Horizontal)),
      m_histories(new QSplitter(Qt::Vertical)), m_rows(new QSplitter(Qt::Vertical)), m_stack(new TimeStack(this))
{
    setObjectName(QStringLiteral("pingBench"));
    setMinimumHeight(220); // for the maps, as in the Workbench
    layOut();
    buildHistories();
    linkViews();
    linkBar();
    layers.addPings(*m_output, m_viewports);
    connect(&layers, &OutputLayers::layerChanged, this, &PingBench::showHeading);
    whenInUse(&layers, &OutputLayers::readingChanged, &PingBench::readCursor);

    connect(&document, &Document::opened, this, [this] { m_isFirstAnalysis = true; });
    connect(&m_player, &PingPlayer::stepRequested, this, &PingBench::play);
    connect(&m_player, &PingPlayer::playingChanged, this, &PingBench::playingChanged);
    auto *backward = new QShortcut(QKeySequence(Qt::SHIFT | Qt::Key_Space), this);
    backward->setContext(Qt::WidgetWithChildrenShortcut);
    connect(backward, &QShortcut::activated, this, [this] { setPlayingBackward(!m_player.isPlaying()); });
}

void PingBench::resizeEvent(QResizeEvent *event)
{
    showWhatFits();
    Bench::resizeEvent(event);
}

void PingBench::showWhatFits()
{
    constexpr int enoughForHistories = 460;
    constexpr int enoughForAll = 580;
    const int more = m_areMapsFirst ? 320 : 0;
    m_histories->setVisible(height() >= enoughForHistories + more);
    m_regulation->setVisible(height() >= enoughForAll + more);
}

void PingBench::setMapsFirst(bool areFirst)
{
    m_areMapsFirst = areFirst;
    showWhatFits();
}

QWidget *PingBench::histories() const
{
    return m_histories;
}

QWidget *PingBench::maps() const
{
    return m_maps;
}

void PingBench::setEmptySentence(const QString &sentence)
{
    m_shownPing = -1;
    m_isFirstAnalysis = true;
    for (WaterfallView *view : views())
        view->setEmptySentence(sentence);
    for (PingMap *map : {m_input, m_output})
        map->setPicture(nullptr, {});
    for (WaterfallView *view : {m_rangeHistory, m_bearingHistory})
        view->setPicture(nullptr, {});
    m_regulation->clear(sentence);
    m_bar->setReading({});
}

// ---- what is shown -------------------------------------------------------------------------------------------------

void PingBench::showAnalysis()
{
    const Analysis &analysis = *m_document.analysis();
    const Grid &grid = analysis.grid();
    const bool isFirst = std::exchange(m_isFirstAnalysis, false);
    showHeading();
    if (isFirst)
        followExtents();
    // Only on the map: maxima over an axis exceed the threshold nearly everywhere.
    m_output->plane()->setThreshold(analysis.threshold);
    m_rangeHistory->setPicture(analysis.statisticAlong[0], grid.axes[0]);
    m_bearingHistory->setPicture(analysis.statisticAlong[1], grid.axes[1]);
    m_rangeHistory->setTruth(truthAlong(m_document.pingTruth(), grid, analysis.time(), 0));
    m_bearingHistory->setTruth(truthAlong(m_document.pingTruth(), grid, analysis.time(), 1));
    m_regulation->show(analysis);
    m_bar->setPingCount(analysis.time().count);
    m_shownPing = -1;
    if (isFirst)
        placeCursor();
    followPlace();
}

/// Heading above the output. The colour bar belongs to the statistic; a layer shown in its place has its own key.
void PingBench::showHeading()
{
    const bool isStatistic = m_layers.layer() == OutputLayer::Statistic || m_layers.isOverlay();
    m_output->setColourBarShown(isStatistic);
    if (!m_document.analysis() || !isInUse())
        return;
    const bool isProvisional = provisional() != nullptr;
    const QString unit = statisticUnit(isProvisional ? m_document.settings() : m_document.analysis()->settings);
    const QString statistic =
        isProvisional ? tr("Statistic D (%1), provisional").arg(unit) : tr("Statistic D (%1)").arg(unit);
    m_output->plane()->setStatisticUnit(unit, isStatistic ? statistic : m_layers.heading());
    m_output->polar()->followPicture();
}

void PingBench::showThreshold()
{
    m_output->plane()->setThreshold(m_document.shownThreshold());
}

void PingBench::showEvents()
{
    if (!m_document.analysis())
        return;
    const Analysis &analysis = *m_document.analysis();
    const std::vector<Track> tracks = m_document.shownTracks();
    m_rangeHistory->setEvents(eventsAlong(m_document.shownEvents(), 0));
    m_rangeHistory->setTracks(tracksAlong(tracks, analysis.grid(), 0), analysis.time());
    m_bearingHistory->setEvents(eventsAlong(m_document.shownEvents(), 1));
    m_bearingHistory->setTracks(tracksAlong(tracks, analysis.grid(), 1), analysis.time());
    showMarks();
}

void PingBench::followExtents()
{
    const Analysis &analysis = *m_document.analysis();
    const auto whole = [](const Axis &axis) { return Span{axis.value(-0.5), axis.value(double(axis.count) - 0.5)}; };
    constexpr double fewestCells = 4.0;
    const Axis &range = analysis.grid().axes[0];
    const Axis &bearing = analysis.grid().axes[1];
    m_viewports.setExtents(whole(analysis.time()), whole(range), whole(bearing),
                           {fewestCells * analysis.time().step, fewestCells * range.step, fewestCells * bearing.step});
}

void PingBench::placeCursor()
{
    const Viewport::Box &map = m_viewports.map().full();
    const double middle = m_viewports.rangeTime().full().time.middle();
    m_viewports.setPlace(
        strongestPlace(m_document).value_or(PingViewports::Place{middle, map.time.middle(), map.frequency.middle()}));
}

QString PingBench::hint() const
{
    return tr("J and L step through the pings, Space plays them, P shows them from above, N goes to the next track.");
}

QWidget *PingBench::inputView() const
{
    return m_input;
}

QWidget *PingBench::outputView() const
{
    return m_output;
}

QWidget *PingBench::firstView() const
{
    return m_output->plane();
}

Bench::Place PingBench::place() const
{
    const PingViewports::Place &place = m_viewports.place();
    return {place.seconds, {}, place.range, place.bearing};
}

void PingBench::setPlace(const Place &wanted)
{
    PingViewports::Place place = m_viewports.place();
    place.seconds = wanted.seconds.value_or(place.seconds);
    place.range = wanted.range.value_or(place.range);
    place.bearing = wanted.bearing.value_or(place.bearing);
    m_viewports.setPlace(place);
}

Index PingBench::ping() const
{
    return m_document.analysis() ? m_document.analysis()->time().nearest(m_viewports.place().seconds) : 0;
}

void PingBench::followPlace()
{
    if (!m_document.analysis())
        return;
    const Analysis &analysis = *m_document.analysis();
    if (const Index now = ping(); now != m_shownPing) {
        m_shownPing = now;
        m_input->setPicture(pictureOfFrame(*analysis.input, analysis.grid(), now), analysis.grid().axes[1]);
        showStatistic();
        m_bar->setPing(now);
        showMarks();
    }
    readCursor();
}

/// The ping shown, computed with changed settings until their analysis is available; null if that is not possible.
const PeakPyramid *PingBench::provisional() const
{
    const auto &statistic = m_document.provisional();
    return statistic && m_document.analysis()
                   && m_shownPing == m_document.analysis()->time().nearest(statistic->time().first)
               ? statistic.get()
               : nullptr;
}

void PingBench::showStatistic()
{
    if (!m_document.analysis() || m_shownPing < 0)
        return;
    const Analysis &analysis = *m_document.analysis();
    const PeakPyramid *now = provisional();
    m_output->setPicture(now ? pictureOfFrame(*now, analysis.grid(), 0)
                             : pictureOfFrame(*analysis.statistic, analysis.grid(), m_shownPing),
                         analysis.grid().axes[1]);
    showHeading();
}

void PingBench::showMarks()
{
    if (m_shownPing < 0)
        return;
    m_marks = pingMarks(*m_document.analysis(), m_document.shownTracks(), m_document.pingTruth(), m_shownPing);
    m_input->setMarks(m_marks);
    m_output->setMarks(m_marks);
}

void PingBench::read(double range, double bearing)
{
    if (m_shownPing >= 0)
        m_bar->setReading(pingReading({*m_document.analysis(), *m_input, *m_output, m_layers, m_marks}, m_shownPing,
                                      {range, bearing}));
}

void PingBench::readCursor()
{
    read(m_viewports.place().range, m_viewports.place().bearing);
}

QString PingBench::reading() const
{
    return m_bar->reading();
}

// ---- moving about --------------------------------------------------------------------------------------------------

void PingBench::showPing(Index ping)
{
    if (!m_document.analysis())
        return;
    const Axis &time = m_document.analysis()->time();
    PingViewports::Place place = m_viewports.place();
    place.seconds = time.value(double(std::clamp<Index>(ping, 0, time.count - 1)));
    m_viewports.setPlace(place);
    const double range = place.range;
    m_viewports.rangeTime().reveal({{place.seconds, place.seconds}, {range, range}});
}

void PingBench::stepFrames(int frames)
{
    showPing(ping() + frames);
}

void PingBench::selectEvent(int id)
{
    for (WaterfallView *view : {m_rangeHistory, m_bearingHistory})
        view->setSelectedEvent(id);
    for (PingMap *map : {m_input, m_output})
        map->setSelectedTrack(id);
    for (const Event &event : m_document.shownEvents())
        if (event.id == id) {
            m_viewports.setPlace({event.detectSeconds, event.position[0], event.position[1]});
            m_viewports.map().reveal({{event.position[0], event.position[0]}, {event.position[1], event.position[1]}});
            m_viewports.rangeTime().reveal(
                {{event.onsetSeconds, event.endSeconds}, {event.position[0], event.position[0]}});
        }
}

void PingBench::setPlaying(bool isPlaying)
{
    m_player.setPlaying(isPlaying);
}

void PingBench::setPlayingBackward(bool isPlaying)
{
    m_player.setPlayingBackward(isPlaying);
}

void PingBench::play(int step)
{
    const Index next = ping() + step;
    if (!m_document.analysis() || next < 0 || next >= m_document.analysis()->time().count)
        return setPlaying(false);
    showPing(next);
}

void PingBench::setPolar(bool isPolar)
{
    m_input->setPolar(isPolar);
    m_output->setPolar(isPolar);
}

void PingBench::cycleOrientation()
{
    m_output->plane()->cycleOrientation();
}

void PingBench::cycleColourMap()
{
    m_output->plane()->cycleColourMap();
}

void PingBench::setAutomaticRange()
{
    for (WaterfallView *view : views())
        view->setAutomaticRange();
}

// ---- session -------------------------------------------------------------------------------------------------------

ViewState PingBench::viewState() const
{
    ViewState view;
    if (!m_viewports.map().isEmpty()) {
        if (!m_viewports.rangeTime().showsAll() || !m_viewports.bearingTime().showsAll()) {
            view.visible = m_viewports.rangeTime().visible();
            view.bearing = m_viewports.map().frequency();
        }
        view.cursor = Viewport::Point{m_viewports.place().seconds, m_viewports.place().range};
        view.cursorBearing = m_viewports.place().bearing;
    }
    view.isPolar = m_output->isPolar();
    view.colourMap = m_output->plane()->colourMap().name();
    return view;
}

void PingBench::restore(const ViewState &view)
{
    if (view.visible)
        m_viewports.rangeTime().zoomTo(view.visible->time, view.visible->frequency);
    if (view.bearing)
        m_viewports.map().zoomTo(m_viewports.map().time(), *view.bearing);
    if (view.cursor)
        m_viewports.setPlace(
            {view.cursor->seconds, view.cursor->hz, view.cursorBearing.value_or(m_viewports.place().bearing)});
    setPolar(view.isPolar);
    if (!view.colourMap.isEmpty())
        m_output->plane()->setColourMap(view.colourMap);
}

} // namespace faintline

#include "app/workspace/PingBench.h"

#include "app/control/OutputLayers.h"
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

namespace faintline {

namespace {

    constexpr std::chrono::milliseconds stepInterval{200}; // a ping can be looked at

} // namespace

PingBench::PingBench(Document &document, OutputLayers &layers, QWidget *parent)
    : Bench(document, pingFrames(), stepInterval, parent), m_layers(layers), m_viewports(document.viewport()),
      m_input(new PingMap(tr("Input (dB over noise)"), m_viewports.map())),
      m_output(new PingMap(tr("Statistic D (nat)"), m_viewports.map())), m_bar(new PingBar),
      m_rangeHistory(new WaterfallView(tr("D over range, best bearing"))),
      m_bearingHistory(new WaterfallView(tr("D over bearing, best range"))),
      m_regulation(new PingRegulation(m_viewports.rangeTime())), m_maps(newSplitter(Qt::Horizontal))
{
    setObjectName(QStringLiteral("pingBench"));
    layOut();
    buildHistories();
    linkViews();
    linkBar();
    layers.addPings(*m_output, m_viewports);
    connect(&layers, &OutputLayers::layerChanged, this, &PingBench::showHeading);
    whenInUse(&layers, &OutputLayers::readingChanged, &PingBench::readCursor);

    auto *backward = new QShortcut(QKeySequence(Qt::SHIFT | Qt::Key_Space), this);
    backward->setContext(Qt::WidgetWithChildrenShortcut);
    connect(backward, &QShortcut::activated, this, [this] { setPlayingBackward(!player().isPlaying()); });
}

void PingBench::showWhatFits()
{
    constexpr int enoughForHistories = 460;
    constexpr int enoughForAll = 580;
    const int more = m_areMapsFirst ? 320 : 0;
    historyPanes()->setVisible(height() >= enoughForHistories + more);
    m_regulation->setVisible(height() >= enoughForAll + more);
}

void PingBench::setMapsFirst(bool areFirst)
{
    m_areMapsFirst = areFirst;
    showWhatFits();
}

QWidget *PingBench::histories() const
{
    return historyPanes();
}

QWidget *PingBench::maps() const
{
    return m_maps;
}

void PingBench::setEmptySentence(const QString &sentence)
{
    m_shownPing = -1;
    forgetAnalysis();
    Bench::setEmptySentence(sentence);
    for (PingMap *map : {m_input, m_output})
        map->setPicture(nullptr, {});
    m_regulation->clear(sentence);
    m_bar->setReading({});
}

// ---- what is shown -------------------------------------------------------------------------------------------------

void PingBench::showAnalysis()
{
    const Analysis &analysis = *m_document.analysis();
    const Grid &grid = analysis.grid();
    const bool isFirst = takeFirstAnalysis();
    showHeading();
    if (isFirst)
        followExtents();
    // Only on the map: maxima over an axis exceed the threshold nearly everywhere.
    m_output->plane()->setThreshold(analysis.threshold);
    m_rangeHistory->setPicture(analysis.statisticAlong[0], grid.axes[0]);
    m_bearingHistory->setPicture(analysis.statisticAlong[1], grid.axes[1]);
    showTruth();
    m_regulation->show(analysis);
    m_bar->setPingCount(analysis.time().count);
    m_shownPing = -1;
    if (isFirst)
        placeCursor();
    followPlace();
}

void PingBench::setColourBarShown(bool isShown)
{
    m_output->setColourBarShown(isShown);
}

void PingBench::showStatisticUnit(const QString &)
{
    m_output->polar()->followPicture();
}

void PingBench::showThreshold()
{
    m_output->plane()->setThreshold(m_document.shownThreshold());
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

WaterfallView *PingBench::firstView() const
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

void PingBench::markSelected(int track)
{
    for (PingMap *map : {m_input, m_output})
        map->setSelectedTrack(track);
}

void PingBench::goTo(const Event &event)
{
    const double range = event.position[0], bearing = event.position[1];
    m_viewports.setPlace({event.detectSeconds, range, bearing});
    m_viewports.map().reveal({{range, range}, {bearing, bearing}});
    m_viewports.rangeTime().reveal({{event.onsetSeconds, event.endSeconds}, {range, range}});
}

void PingBench::setPlayingBackward(bool isPlaying)
{
    player().setPlayingBackward(isPlaying);
}

int PingBench::framesToPlay(int direction) const
{
    const Index next = ping() + direction;
    return m_document.analysis() && next >= 0 && next < m_document.analysis()->time().count ? direction : 0;
}

void PingBench::setPolar(bool isPolar)
{
    m_input->setPolar(isPolar);
    m_output->setPolar(isPolar);
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

#include "app/workspace/PingBench.h"

#include "analysis/regulation.h"
#include "app/control/OutputLayers.h"
#include "app/document/statisticUnit.h"
#include "app/workspace/PingBar.h"
#include "spectrum/pictureCuts.h"
#include "widgets/base/TimeStack.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/pings/PingMap.h"
#include "widgets/pings/PolarView.h"
#include "widgets/plot/StripPlot.h"

#include <QLabel>
#include <QShortcut>
#include <QSplitter>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr int playerInterval = 200; // ms per ping
    constexpr int lowestHistory = 96;   // pixels, of one above the other

    QString unitText(const Axis &axis)
    {
        const QString unit = labelText(axis.unit, mostUnitLetters);
        return unit == QStringLiteral("°") ? unit : QLatin1Char(' ') + unit;
    }

    QString axisText(const Axis &axis, double value)
    {
        return numberText(value, decimalsFor(axis.step)) + unitText(axis);
    }

    Index cellOf(const Axis &axis, double value)
    {
        return axis.nearest(value);
    }

    double centreOf(const Axis &axis, double value)
    {
        return axis.value(double(cellOf(axis, value)));
    }

} // namespace

PingBench::PingBench(Document &document, OutputLayers &layers, QWidget *parent)
    : Bench(document, pingFrames(), parent), m_layers(layers), m_viewports(document.viewport()),
      m_input(new PingMap(tr("Input (dB over noise)"), m_viewports.map())),
      m_output(new PingMap(tr("Statistic D (nat)"), m_viewports.map())), m_bar(new PingBar),
      m_rangeHistory(new WaterfallView(tr("D over range, best bearing"))),
      m_bearingHistory(new WaterfallView(tr("D over bearing, best range"))),
      m_regulation(new StripPlot(tr("ln K (nat)"))), m_dragged(new QLabel), m_maps(new QSplitter(Qt::Horizontal)),
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
    m_player.setInterval(playerInterval);
    connect(&m_player, &QTimer::timeout, this, &PingBench::play);
    auto *backward = new QShortcut(QKeySequence(Qt::SHIFT | Qt::Key_Space), this);
    backward->setContext(Qt::WidgetWithChildrenShortcut);
    connect(backward, &QShortcut::activated, this, [this] { setPlayingBackward(!m_player.isActive()); });
}

void PingBench::layOut()
{
    for (WaterfallView *view : {m_rangeHistory, m_bearingHistory})
        view->setMinimumHeight(lowestHistory);
    m_maps->addWidget(m_input);
    m_maps->addWidget(m_output);
    m_histories->addWidget(m_rangeHistory);
    m_histories->addWidget(m_bearingHistory);
    const auto column = [](QWidget *first, QWidget *second, int share) {
        auto *result = new QWidget;
        auto *layout = new QVBoxLayout(result);
        layout->setContentsMargins(0, 0, 0, 0);
        layout->setSpacing(0);
        layout->addWidget(first, share);
        layout->addWidget(second, 1 - share);
        return result;
    };
    m_rows->addWidget(column(m_maps, m_bar, 1));
    m_rows->addWidget(m_histories);
    m_rows->addWidget(column(m_dragged, m_regulation, 0));
    m_rows->setStretchFactor(0, 1);
    m_rows->setSizes({450, 250, 120});
    for (QSplitter *splitter : {m_maps, m_histories, m_rows})
        splitter->setChildrenCollapsible(false);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(m_rows);
}

/// What runs along time.
void PingBench::buildHistories()
{
    m_input->setObjectName(QStringLiteral("pingInput"));
    m_output->setObjectName(QStringLiteral("pingOutput"));
    m_dragged->setWordWrap(true);
    m_dragged->setTextFormat(Qt::PlainText);
    m_dragged->setContentsMargins(10, 4, 10, 0);
    m_dragged->hide();
    m_regulation->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    m_regulation->setRightTitle(tr("resets"));
    m_regulation->setFixedScale(StripPlot::Side::Right, {0.0, 1.0});
    m_regulation->setViewport(&m_viewports.rangeTime());
    m_rangeHistory->setViewport(&m_viewports.rangeTime());
    m_bearingHistory->setViewport(&m_viewports.bearingTime());
    for (WaterfallView *view : {m_rangeHistory, m_bearingHistory}) {
        view->setOrientation(WaterfallView::Orientation::LeftToRight);
        view->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
        m_stack->add(*view, *view);
        connect(view, &WaterfallView::orientationChanged, view == m_rangeHistory ? m_bearingHistory : m_rangeHistory,
                &WaterfallView::setOrientation);
        connect(view, &WaterfallView::orientationChanged, this, &PingBench::arrangeHistories);
    }
    m_stack->add(*m_regulation, *m_regulation);
    arrangeHistories();
}

void PingBench::arrangeHistories()
{
    const bool isStacked = !m_rangeHistory->isTimeVertical();
    m_histories->setOrientation(isStacked ? Qt::Vertical : Qt::Horizontal);
    m_stack->setOn(isStacked);
}

void PingBench::resizeEvent(QResizeEvent *event)
{
    constexpr int enoughForHistories = 460;
    constexpr int enoughForAll = 580;
    m_histories->setVisible(height() >= enoughForHistories);
    m_regulation->parentWidget()->setVisible(height() >= enoughForAll);
    Bench::resizeEvent(event);
}

QWidget *PingBench::histories() const
{
    return m_histories;
}

QWidget *PingBench::maps() const
{
    return m_maps;
}

void PingBench::linkBar()
{
    connect(m_bar, &PingBar::pingRequested, this, &PingBench::showPing);
    connect(m_bar, &PingBar::stepRequested, this, &PingBench::stepFrames);
    connect(m_bar, &PingBar::playClicked, this, [this] { setPlaying(!m_player.isActive()); });
    connect(m_bar, &PingBar::backwardClicked, this, [this] { setPlayingBackward(!m_player.isActive()); });
    for (PingMap *map : {m_input, m_output}) {
        connect(m_bar, &PingBar::inhibitionToggled, map, &PingMap::setInhibitionShown);
        connect(m_bar, &PingBar::conventionalToggled, map, &PingMap::setConventionalShown);
    }
    connect(m_bar, &PingBar::polarToggled, this, &PingBench::setPolar);
    connect(m_output, &PingMap::polarChanged, m_bar, &PingBar::setPolar);
}

std::vector<WaterfallView *> PingBench::views() const
{
    return {m_output->plane(), m_input->plane(), m_rangeHistory, m_bearingHistory};
}

void PingBench::linkViews()
{
    for (WaterfallView *view : views()) {
        for (WaterfallView *other : views()) {
            if (other == view)
                continue;
            connect(view, &WaterfallView::colourMapChanged, other, &WaterfallView::setColourMap);
            connect(view, &WaterfallView::layersChanged, other, [view, other] {
                for (const auto layer :
                     {WaterfallView::EventLayer, WaterfallView::TrackLayer, WaterfallView::TruthLayer,
                      WaterfallView::ThresholdLayer, WaterfallView::GridLayer, WaterfallView::CursorLayer})
                    other->setLayer(layer, view->layers().testFlag(layer));
            });
        }
        connect(view, &WaterfallView::eventActivated, this, &PingBench::eventActivated);
        connect(view, &WaterfallView::thresholdStepRequested, this, &PingBench::thresholdStepRequested);
    }
    for (PingMap *map : {m_input, m_output}) {
        PingMap *other = map == m_input ? m_output : m_input;
        connect(map->plane(), &WaterfallView::orientationChanged, other->plane(), &WaterfallView::setOrientation);
        connect(map, &PingMap::polarChanged, other, &PingMap::setPolar);
        connect(map, &PingMap::hovered, this, &PingBench::read);
        whenInUse(map, &PingMap::hoverEnded, &PingBench::readCursor);
    }
    whenInUse(&m_viewports, &PingViewports::placeChanged, &PingBench::followPlace);
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
    m_regulation->removeSeries(tr("ln K"));
    m_regulation->removeSeries(tr("reset fraction"));
    m_regulation->setEmptySentence(sentence);
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
    showRegulation();
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

void PingBench::showRegulation()
{
    const Analysis &analysis = *m_document.analysis();
    std::vector<float> resetFraction(analysis.continuedFraction.size());
    std::transform(analysis.continuedFraction.begin(), analysis.continuedFraction.end(), resetFraction.begin(),
                   [](float continued) { return 1.0f - continued; });
    m_regulation->setSeries(tr("ln K"), analysis.time(), analysis.lnK);
    m_regulation->setSeries(tr("reset fraction"), analysis.time(), std::move(resetFraction), StripPlot::Side::Right);
    const NoiseBand &band = analysis.lnKBand;
    m_regulation->setBand(band.deviation > 0.0 ? std::optional(Span{band.low(), band.high()}) : std::nullopt);
    const std::vector<Index> dragged = draggedFrames(analysis);
    m_dragged->setVisible(!dragged.empty());
    if (!dragged.empty())
        m_dragged->setText(tr("⚠ ln K lies below its noise band in %1 of %2 pings, first in ping %3. Signals without a "
                              "track lower it, and with it every other statistic.")
                               .arg(dragged.size())
                               .arg(analysis.lnK.size())
                               .arg(dragged.front() + 1));
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
    const std::vector<Event> events = m_document.shownEvents();
    const auto strongest = std::max_element(events.begin(), events.end(),
                                            [](const Event &a, const Event &b) { return a.statistic < b.statistic; });
    const Viewport::Box &map = m_viewports.map().full();
    // In the middle of the strongest track, where most is visible.
    const Track *track = strongest == events.end() ? nullptr : m_document.track(strongest->id);
    const Analysis &analysis = *m_document.analysis();
    if (track && !track->points.empty()) {
        const Index middle = (track->detectFrame + track->endFrame) / 2;
        const auto at = std::find_if(track->points.begin(), track->points.end(),
                                     [&](const TrackPoint &point) { return point.frame >= middle; });
        const TrackPoint &point = at == track->points.end() ? track->points.back() : *at;
        const std::vector<Index> c = analysis.grid().coordinates(point.cell);
        m_viewports.setPlace({analysis.time().value(double(point.frame)), analysis.grid().axes[0].value(double(c[0])),
                              analysis.grid().axes[1].value(double(c[1]))});
    } else
        m_viewports.setPlace({m_viewports.rangeTime().full().time.middle(), map.time.middle(), map.frequency.middle()});
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
    if (m_shownPing < 0)
        return;
    const Analysis &analysis = *m_document.analysis();
    const Axis &ranges = analysis.grid().axes[0];
    const Axis &bearings = analysis.grid().axes[1];
    const double r = centreOf(ranges, range);
    const double b = centreOf(bearings, bearing);
    const auto value = [](const WaterfallView &view, double x, double y) {
        const auto there = view.valueAt(x, y);
        return there ? numberText(*there, 1) : QStringLiteral("–");
    };
    QStringList words{tr("ping %1/%2").arg(m_shownPing + 1).arg(analysis.time().count),
                      secondsText(analysis.time().value(double(m_shownPing)), 1.0),
                      axisText(ranges, r),
                      axisText(bearings, b),
                      tr("y %1 dB").arg(value(*m_input->plane(), r, b)),
                      tr("D %1 %2").arg(value(*m_output->plane(), r, b), m_output->plane()->valueUnit())};
    if (const auto best = m_layers.readingAt({analysis.time().value(double(m_shownPing)), {r, b}})) {
        const auto rate = [&](const Axis &axis, double perSecond) {
            return numberText(perSecond, decimalsFor(axis.step / analysis.time().step)) + unitText(axis)
                   + QStringLiteral("/s");
        };
        words
            << tr("best state %1, %2").arg(rate(ranges, best->ratePerSecond), rate(bearings, best->secondRatePerSecond))
            << tr("path age %1").arg(std::lround(best->ageSeconds / analysis.time().step));
    }
    if (const PingMarks::Box *box = m_marks.boxAt({r, b}))
        words << (box->pings == 1 ? tr("inhibited: track %1, from now on").arg(box->track)
                                  : tr("inhibited: track %1, %2 pings").arg(box->track).arg(box->pings));
    m_bar->setReading(words.join(QStringLiteral(" · ")));
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

void PingBench::startPlaying(int step)
{
    m_playStep = step;
    m_player.start();
    emit playingChanged(true);
}

void PingBench::setPlaying(bool isPlaying)
{
    if (isPlaying == m_player.isActive())
        return;
    if (isPlaying)
        return startPlaying(1);
    m_player.stop();
    emit playingChanged(false);
}

void PingBench::setPlayingBackward(bool isPlaying)
{
    setPlaying(false);
    if (isPlaying)
        startPlaying(-1);
}

void PingBench::play()
{
    const Index next = ping() + m_playStep;
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

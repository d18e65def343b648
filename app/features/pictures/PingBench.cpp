#include "app/features/pictures/PingBench.h"

#include "app/document/OutputLayers.h"
#include "app/features/pictures/PingBar.h"
#include "app/features/pictures/PingRegulation.h"
#include "app/features/pictures/RegulationPlot.h"
#include "app/features/pictures/ShownAxes.h"
#include "app/features/pictures/pingReading.h"
#include "app/features/pictures/strongestPlace.h"
#include "frames/pictureCuts.h"
#include "widgets/base/TimeStack.h"
#include "widgets/base/labelText.h"
#include "widgets/pings/PingMap.h"
#include "widgets/pings/PolarView.h"

#include <QShortcut>
#include <QSplitter>
#include <QVBoxLayout>

#include <algorithm>

namespace faintline {

namespace {

    constexpr std::chrono::milliseconds pingInterval{200}; // a ping can be looked at

} // namespace

PingBench::PingBench(Document &document, OutputLayers &layers, QWidget *parent)
    : Bench(document, pingFrames(), pingInterval, parent), m_layers(layers), m_viewports(document.viewport()),
      m_input(new PingMap(tr("Input (dB over noise)"), m_viewports.map(), &document.display(), &m_mapDirection)),
      m_output(new PingMap(tr("Statistic D (nat)"), m_viewports.map(), &document.display(), &m_mapDirection)),
      m_bar(new PingBar), m_axes(new ShownAxes(document, m_viewports, this)),
      m_alongHistory(new WaterfallView(tr("D over range, best bearing"), &document.display(), &m_historyDirection)),
      m_acrossHistory(new WaterfallView(tr("D over bearing, best range"), &document.display(), &m_historyDirection)),
      m_regulation(new PingRegulation(m_viewports.alongTime())), m_maps(newSplitter(Qt::Horizontal))
{
    setObjectName(QStringLiteral("pingBench"));
    layOut();
    buildHistories();
    linkViews();
    linkBar();
    linkAxes();
    layers.addPings(*m_output, m_viewports);
    connect(&layers, &OutputLayers::layerChanged, this, &PingBench::showHeading);
    whenInUse(&layers, &OutputLayers::readingChanged, &PingBench::readCursor);

    auto *backward = new QShortcut(QKeySequence(Qt::SHIFT | Qt::Key_Space), this);
    backward->setContext(Qt::WidgetWithChildrenShortcut);
    connect(backward, &QShortcut::activated, this, [this] { setPlayingBackward(!player().isPlaying()); });
}

void PingBench::layOut()
{
    constexpr int lowestHistory = 96; // pixels, of one above the other
    for (WaterfallView *view : {m_alongHistory, m_acrossHistory})
        view->setMinimumHeight(lowestHistory);
    m_maps->addWidget(m_input);
    m_maps->addWidget(m_output);
    auto *mapsAndBar = new QWidget;
    auto *column = new QVBoxLayout(mapsAndBar);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(&m_axes->bar());
    column->addWidget(m_maps, 1);
    column->addWidget(m_bar);
    addPlane(*m_output->plane());
    addPlane(*m_input->plane());
    addHistory(*m_alongHistory, *m_alongHistory, 0);
    addHistory(*m_acrossHistory, *m_acrossHistory, 1);
    timeStack().add(m_regulation->plot(), *m_regulation);
    addRows({{mapsAndBar, 400}, {historyPanes(), 330}, {m_regulation, 90}}); // histories are two
}

/// What runs along time.
void PingBench::buildHistories()
{
    m_input->setObjectName(QStringLiteral("pingInput"));
    m_output->setObjectName(QStringLiteral("pingOutput"));
    m_alongHistory->setViewport(&m_viewports.alongTime());
    m_acrossHistory->setViewport(&m_viewports.acrossTime());
    arrangeBy(m_historyDirection);
}

void PingBench::linkBar()
{
    connect(m_bar, &PingBar::pingRequested, this, &PingBench::showPing);
    connect(m_bar, &PingBar::stepRequested, this, &PingBench::stepFrames);
    connect(m_bar, &PingBar::playClicked, this, [this] { setPlaying(!player().isPlaying()); });
    connect(m_bar, &PingBar::backwardClicked, this, [this] { setPlayingBackward(!player().isPlaying()); });
    PictureDisplay *display = &m_document.display();
    connect(m_bar, &PingBar::inhibitionToggled, this,
            [display](bool isOn) { display->setLayer(PictureDisplay::InhibitionLayer, isOn); });
    connect(m_bar, &PingBar::conventionalToggled, this,
            [display](bool isOn) { display->setLayer(PictureDisplay::ConventionalLayer, isOn); });
    connect(m_bar, &PingBar::polarToggled, this, &PingBench::setPolar);
    connect(display, &PictureDisplay::projectionChanged, this, &PingBench::followProjection);
}

void PingBench::linkAxes()
{
    connect(m_axes, &ShownAxes::axesChanged, this, [this] {
        showAxes();
        showHeading();
    });
    connect(m_axes, &ShownAxes::slicedChanged, this, &PingBench::followPlace);
    connect(&m_viewports, &PingViewports::cursorMoved, this, [this] {
        if (isInUse())
            m_axes->goBehind();
    });
}

void PingBench::linkViews()
{
    for (PingMap *map : {m_input, m_output}) {
        connect(map, &PingMap::hovered, this, &PingBench::read);
        whenInUse(map, &PingMap::hoverEnded, &PingBench::readCursor);
    }
    whenInUse(&m_viewports, &PingViewports::placeChanged, &PingBench::followPlace);
}

void PingBench::showWhatFits()
{
    constexpr int leastMaps = 350;
    constexpr int histories = 200; // with their splitter
    constexpr int regulation = 85;
    const int others = m_bar->sizeHint().height() + (m_axes->bar().isHidden() ? 0 : m_axes->bar().sizeHint().height());
    const int more = m_areMapsFirst ? 220 : 0;
    const int room = height() - others - leastMaps - more;
    historyPanes()->setVisible(room >= histories);
    m_regulation->setVisible(room >= histories + regulation);
    m_maps->setMinimumHeight(std::min(leastMaps, std::max(0, height() - others)));
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
    m_axes->bar().setGrid({});
}

// ---- what is shown -------------------------------------------------------------------------------------------------

void PingBench::showAnalysis()
{
    const Analysis &analysis = *m_document.analysis();
    const Grid &grid = analysis.grid();
    const bool isFirst = takeFirstAnalysis();
    if (isFirst)
        followExtents();
    showHeading();
    // Only on the map: maxima over an axis exceed the threshold nearly everywhere.
    m_output->plane()->setThreshold(analysis.threshold);
    m_axes->bar().setGrid(grid);
    m_regulation->show(analysis);
    m_bar->setPingCount(analysis.time().count);
    m_bar->setFrameName(m_document.frameKind().frame);
    m_shownPing = -1;
    if (isFirst)
        placeCursor();
    showAxes();
}

/// What depends on the axes shown, besides the maps.
void PingBench::showAxes()
{
    const Analysis &analysis = *m_document.analysis();
    const Grid &grid = analysis.grid();
    const FramePlane &plane = m_viewports.plane();
    const auto nameOf = [&](std::size_t axis) { return labelText(grid.axes[axis].name, mostUnitLetters); };
    const auto show = [&](WaterfallView &history, std::size_t axis, std::size_t other) {
        history.setHeading(frameKindOf(grid).hasHiddenAxes
                               ? tr("D over %1, largest over the other axes").arg(nameOf(axis))
                               : tr("D over %1, best %2").arg(nameOf(axis), nameOf(other)));
        history.setPicture(analysis.statisticAlong[axis], grid.axes[axis]);
        setHistoryAxis(history, axis);
    };
    show(*m_alongHistory, plane.along, plane.across);
    show(*m_acrossHistory, plane.across, plane.along);
    m_bar->setPolarPossible(m_axes->isPolarPossible());
    if (!m_axes->isPolarPossible())
        setPolar(false);
    showTruth();
    showEvents();
    m_shownPing = -1;
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
    const auto extent = [&](const Axis &axis) { return PingViewports::Extent{whole(axis), fewestCells * axis.step}; };
    std::vector<PingViewports::Extent> extents;
    for (const Axis &axis : analysis.grid().axes)
        extents.push_back(extent(axis));
    m_axes->forgetSlice();
    m_viewports.setExtents(extent(analysis.time()), std::move(extents));
}

void PingBench::placeCursor()
{
    PingViewports::Place middle{m_viewports.alongTime().full().time.middle(), {}};
    for (const Axis &axis : m_document.analysis()->grid().axes)
        middle.position.push_back(axis.value(0.5 * double(axis.count - 1)));
    m_viewports.setPlace(strongestPlace(m_document).value_or(middle));
}

QString PingBench::hint() const
{
    return tr("J and L step through the %1, Space plays them, P shows them from above, N goes to the next track.")
        .arg(m_document.frameKind().frames);
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
    const auto on = [&](std::size_t axis) {
        return axis < place.position.size() ? std::optional(place.position[axis]) : std::nullopt;
    };
    return {place.seconds, {}, on(0), on(1), place.position};
}

void PingBench::setPlace(const Place &wanted)
{
    PingViewports::Place place = m_viewports.place();
    place.seconds = wanted.seconds.value_or(place.seconds);
    for (std::size_t axis = 0; axis < place.position.size(); ++axis) {
        if (axis < wanted.position.size())
            place.position[axis] = wanted.position[axis];
        else if (const auto &value = axis == 0 ? wanted.range : wanted.bearing; axis < 2 && value)
            place.position[axis] = *value;
    }
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
    if (m_axes->followPlace())
        m_shownPing = -1;
    if (const Index now = ping(); now != m_shownPing) {
        m_shownPing = now;
        const FramePlane &plane = m_viewports.plane();
        m_input->setPicture(pictureOfFrame(*analysis.input, analysis.grid(), now, plane),
                            analysis.grid().axes[plane.across]);
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
    const FramePlane &plane = m_viewports.plane();
    m_output->setPicture(now ? pictureOfFrame(*now, analysis.grid(), 0, plane)
                             : pictureOfFrame(*analysis.statistic, analysis.grid(), m_shownPing, plane),
                         analysis.grid().axes[plane.across]);
    showHeading();
}

void PingBench::showMarks()
{
    if (m_shownPing < 0)
        return;
    m_marks = pingMarks(*m_document.analysis(), m_document.shownTracks(), m_document.pingTruth(), m_shownPing,
                        m_viewports.plane());
    m_input->setMarks(m_marks);
    m_output->setMarks(m_marks);
}

void PingBench::read(double along, double across)
{
    if (m_shownPing >= 0)
        m_bar->setReading(
            pingReading({*m_document.analysis(), *m_input, *m_output, m_layers, m_marks, m_viewports.plane()},
                        m_shownPing, {along, across}));
}

void PingBench::readCursor()
{
    read(m_viewports.along(), m_viewports.across());
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
    const double along = m_viewports.along();
    m_viewports.alongTime().reveal({{place.seconds, place.seconds}, {along, along}});
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
    m_viewports.setPlace({event.detectSeconds, event.detectedPosition});
    const double along = m_viewports.along(), across = m_viewports.across();
    m_viewports.map().reveal({{along, along}, {across, across}});
    m_viewports.alongTime().reveal({{event.onsetSeconds, event.endSeconds}, {along, along}});
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

// ---- projection ----------------------------------------------------------------------------------------------------

void PingBench::setPolar(bool isPolar)
{
    m_document.display().setPolar(isPolar);
}

/// Whoever has set it.
void PingBench::followProjection()
{
    PictureDisplay &display = m_document.display();
    if (display.isPolar() && m_document.analysis() && isInUse() && !m_axes->isPolarPossible())
        display.setPolar(false);
    m_bar->setPolar(display.isPolar());
}

// ---- session -------------------------------------------------------------------------------------------------------

ViewState PingBench::viewState() const
{
    ViewState view;
    if (!m_viewports.map().isEmpty()) {
        if (!m_viewports.alongTime().showsAll() || !m_viewports.acrossTime().showsAll()) {
            view.visible = m_viewports.alongTime().visible();
            view.bearing = m_viewports.map().frequency();
        }
        view.cursor = Viewport::Point{m_viewports.place().seconds, m_viewports.along()};
        view.cursorBearing = m_viewports.across();
        if (m_viewports.place().position.size() > 2) {
            view.axes = {m_viewports.plane().along, m_viewports.plane().across};
            view.position = m_viewports.place().position;
            view.isSliced = m_axes->isSliced();
        }
    }
    view.isPolar = m_document.display().isPolar();
    view.colourMap = m_document.display().colourMap().name();
    return view;
}

void PingBench::restore(const ViewState &view)
{
    m_axes->restore(view);
    if (view.visible)
        m_viewports.alongTime().zoomTo(view.visible->time, view.visible->frequency);
    if (view.bearing)
        m_viewports.map().zoomTo(m_viewports.map().time(), *view.bearing);
    if (view.cursor) {
        PingViewports::Place place = m_viewports.place();
        place.seconds = view.cursor->seconds;
        if (view.position.size() == place.position.size()) {
            place.position = view.position;
        } else if (place.position.size() >= 2) {
            place.position[0] = view.cursor->hz;
            place.position[1] = view.cursorBearing.value_or(place.position[1]);
        }
        m_viewports.setPlace(place);
    }
    setPolar(view.isPolar);
    if (!view.colourMap.isEmpty())
        m_document.display().setColourMap(view.colourMap);
}

} // namespace faintline

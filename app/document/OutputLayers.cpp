#include "app/document/OutputLayers.h"

#include "app/document/LayerPlane.h"
#include "plan/chain.h"
#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"
#include "widgets/waterfall/LayerItem.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QEvent>

#include <algorithm>

namespace faintline {

namespace {

    constexpr int layerPauseMs = 40; ///< while the view changes

} // namespace

OutputLayers::OutputLayers(Document &document, WaterfallView &output, QObject *parent)
    : QObject(parent), m_document(document)
{
    connect(&document, &Document::opened, this, [this] {
        m_runner.cancel();
        m_result = {};
        show();
    });
    connect(&document, &Document::analysisChanged, this, &OutputLayers::follow);
    connect(&document, &Document::provisionalChanged, this, &OutputLayers::show);
    connect(&document, &Document::shownThresholdChanged, this, [this] {
        if (m_isOverlay) // which ends where the statistic passes it
            show();
    });
    connect(&document.display(), &PictureDisplay::coloursChanged, this, &OutputLayers::show);
    add(new LineLayerPlane(output, document.viewport(), this));
    connect(&m_runner, &JobRunner::failed, this, &OutputLayers::failed);
}

void OutputLayers::addPings(PingMap &map, PingViewports &viewports)
{
    add(new PingLayerPlane(map, viewports, this));
}

void OutputLayers::add(LayerPlane *plane)
{
    m_planes.push_back(plane);
    connect(plane, &LayerPlane::spanChanged, this, &OutputLayers::followSpan);
    connect(plane, &LayerPlane::shapeChanged, this, &OutputLayers::follow);
    connect(plane, &LayerPlane::cursorChanged, this, [this, plane] { followCursor(*plane); });
}

LayerPlane &OutputLayers::plane() const
{
    const auto own = std::find_if(m_planes.begin(), m_planes.end(), [this](const LayerPlane *one) {
        return one->kind().isShownLike(m_document.frameKind());
    });
    return own == m_planes.end() ? *m_planes.front() : **own;
}

bool OutputLayers::isOffered(OutputLayer layer) const
{
    if (layer == OutputLayer::Presence)
        return &m_document.frameKind() == &lineFrames();
    return layer != OutputLayer::SecondRate || m_document.frameKind().isSeenSingly;
}

OutputLayer OutputLayers::layer() const
{
    if (isOffered(m_layer))
        return m_layer;
    return m_layer == OutputLayer::SecondRate ? OutputLayer::Rate : OutputLayer::Statistic;
}

bool OutputLayers::isCovering() const
{
    // The picture of a single frame is made anew with every frame: its heading stays meanwhile.
    return layer() != OutputLayer::Statistic && !m_isOverlay && m_document.analysis() && !m_document.provisional()
           && (plane().isOfOneFrame() || isKnown());
}

/// Whether the layer has been computed for the analysis that is shown.
bool OutputLayers::isKnown() const
{
    return m_document.analysis() && !m_document.provisional() && m_result.analysis == m_document.analysis()
           && m_result.picture && layer() != OutputLayer::Statistic
           && (layer() == OutputLayer::Presence) == !m_result.picture->presence.empty();
}

bool OutputLayers::isPossible() const
{
    return m_document.analysis() && plane().kind().isShownLike(m_document.frameKind());
}

bool OutputLayers::eventFilter(QObject *watched, QEvent *event)
{
    const bool isView = qobject_cast<WaterfallView *>(watched); // otherwise a canvas
    if (event->type() == QEvent::PaletteChange && isView)
        show();
    if (event->type() == QEvent::Resize && !isView)
        followSpan();
    return QObject::eventFilter(watched, event);
}

void OutputLayers::setLayer(OutputLayer layer)
{
    if (layer == m_layer)
        return;
    m_layer = layer;
    show();
    follow();
    emit layerChanged();
}

QString OutputLayers::heading() const
{
    switch (layer()) {
    case OutputLayer::Rate:
        return tr("Winning %1 of each cell").arg(rateName(plane().shown().along));
    case OutputLayer::SecondRate:
        return tr("Winning %1 of each cell").arg(rateName(plane().shown().across));
    case OutputLayer::Age:
        return tr("Age of each cell's best path");
    case OutputLayer::Reset:
        return tr("States reset");
    case OutputLayer::Inhibited:
        return tr("Inhibited cells");
    case OutputLayer::Presence:
        return tr("What was found: probability of a signal");
    case OutputLayer::Statistic:
        break;
    }
    return tr("Statistic D");
}

QString OutputLayers::rateName(std::size_t axis) const
{
    const Grid grid = m_document.plan() ? m_document.plan()->grid() : Grid();
    return m_document.frameKind().rateName(grid.hasAxis(axis) ? grid.axes[axis] : Axis());
}

void OutputLayers::cycleLayer()
{
    auto next = layer();
    do
        next = static_cast<OutputLayer>((std::size_t(next) + 1) % outputLayerNames.size());
    while (!isOffered(next));
    setLayer(next);
}

void OutputLayers::toggleFound()
{
    setLayer(layer() == OutputLayer::Presence ? OutputLayer::Statistic : OutputLayer::Presence);
}

void OutputLayers::setOverlay(bool isOverlay)
{
    if (isOverlay == m_isOverlay)
        return;
    m_isOverlay = isOverlay;
    show();
    emit layerChanged();
}

void OutputLayers::setWatching(bool isWatching)
{
    m_isWatching = isWatching;
    follow();
}

void OutputLayers::followSpan()
{
    if (layer() != OutputLayer::Statistic)
        follow();
}

void OutputLayers::followCursor(const LayerPlane &of)
{
    if (!of.kind().isShownLike(m_document.frameKind()) || !isWanted())
        return;
    if (of.isOfOneFrame()) // results for another frame are removed at once
        show();
    follow();
}

OutputLayers::Place OutputLayers::placeOf(const FramePlace &place) const
{
    const Analysis &analysis = *m_document.analysis();
    const Grid &grid = analysis.grid();
    std::vector<Index> cell;
    for (std::size_t axis = 0; axis < place.position.size(); ++axis)
        cell.push_back(grid.axes[axis].nearest(place.position[axis]));
    const Index frame = analysis.time().nearest(place.seconds);
    if (!plane().isOfOneFrame())
        return {frame, grid.cell(cell), frame, cell.back()};
    const FramePlane &shown = plane().shown();
    return {frame, grid.cell(cell), cell[shown.along], cell[shown.across]};
}

std::optional<OutputLayers::Place> OutputLayers::cursor() const
{
    const auto at = plane().cursor();
    return at && m_document.analysis()->grid().fits(at->position) ? std::optional(placeOf(*at)) : std::nullopt;
}

/// The frame that a picture shows, if it shows a single one.
std::optional<Index> OutputLayers::singleFrame(const std::optional<Place> &cursor) const
{
    return plane().isOfOneFrame() && cursor ? std::optional(cursor->frame) : std::nullopt;
}

void OutputLayers::follow()
{
    if (!isPossible() || !isWanted())
        return;
    const auto analysis = m_document.analysis();
    const bool wantsPicture = layer() != OutputLayer::Statistic;
    const LayerPart wanted = plane().part(*analysis);
    const std::optional<Place> cursor = this->cursor();
    const auto job = [this, analysis, cursor, frame = singleFrame(cursor), wantsPicture, wanted,
                      shown = plane().shown(),
                      isOfTracks = layer() == OutputLayer::Presence](const RunContext &context) -> JobRunner::Delivery {
        if (!m_replay || m_replay->analysis() != analysis)
            m_replay = std::make_shared<LayerReplay>(
                analysis, memoryShares::orSome(memoryShares::layerReplay, 4 * bytesOfStates(*analysis)));
        Result result{analysis, {}, {}, cursor, frame, shown};
        if (wantsPicture)
            result.picture =
                std::make_shared<const LayerPicture>(isOfTracks ? presencePicture(*analysis, wanted)
                                                     : frame ? layerPictureOf(*m_replay, *frame, wanted, shown, context)
                                                             : layerPicture(*m_replay, wanted, context));
        const auto delivery = [this](const Result &made) -> JobRunner::Delivery {
            return [this, made] {
                if (m_document.analysis() != made.analysis)
                    return;
                const bool wasCovering = isCovering();
                m_result = made;
                show();
                if (isCovering() != wasCovering)
                    emit layerChanged(); // the heading
                emit readingChanged();
            };
        };
        if (cursor) {
            if (isOfTracks) // needs no detector, which has to run up to the cursor
                m_runner.deliver(delivery(result));
            result.atCursor = readCell(
                *analysis, m_replay->at(cursor->frame, context, {cursor->cell, cursor->cell + 1}), cursor->cell, shown);
        }
        return delivery(result);
    };
    m_runner.start(job, layerPauseMs);
}

std::optional<CellReading> OutputLayers::readingAt(const FramePlace &at) const
{
    const auto &analysis = m_document.analysis();
    if (!analysis || m_result.analysis != analysis)
        return {};
    const Place place = placeOf(at);
    if (m_result.frame && (m_result.frame != place.frame || m_result.shown != plane().shown()))
        return {};
    if (m_result.atCursor && m_result.cursor == place)
        return m_result.atCursor;
    // A picture of tracks has no values of the detector.
    const Index pixel = m_result.picture && m_result.picture->presence.empty()
                            ? m_result.picture->pixelAt(place.row, place.column)
                            : -1;
    return pixel >= 0 ? std::optional(readPixel(*m_result.picture, pixel)) : std::nullopt;
}

void OutputLayers::show()
{
    const auto &analysis = m_document.analysis();
    LayerPlane &plane = this->plane();
    LayerItem &item = plane.item();
    item.setTimeVertical(plane.view().isTimeVertical());
    const Theme::Colours &colours = Theme::colours(plane.view());
    item.setColours(colours.text, colours.canvas, m_document.display().colourMap());
    if (!isKnown() || m_result.frame != singleFrame(cursor()) || m_result.shown != plane.shown()) {
        item.setPicture(nullptr, {}, {});
        plane.view().setTracksPictured(false);
        return plane.replot();
    }
    const auto [rows, columns] = plane.axes(*analysis);
    item.setPicture(m_result.picture, rows, columns);
    item.setOverlay(m_isOverlay, m_document.shownThreshold());
    showLayer(item);
    plane.view().setTracksPictured(layer() == OutputLayer::Presence && !m_isOverlay);
    plane.replot();
}

void OutputLayers::showLayer(LayerItem &item)
{
    switch (layer()) {
    case OutputLayer::Rate:
        return showRates(item, plane().shown().along);
    case OutputLayer::SecondRate:
        return showRates(item, plane().shown().across);
    case OutputLayer::Age:
        return showAges(item);
    case OutputLayer::Reset:
        return item.setLayer(layer(), {0.0, 1.0}, tr("States reset (fraction)"), 1.0);
    case OutputLayer::Inhibited:
        return item.setLayer(layer(), {0.0, 1.0}, tr("Inhibited"), 1.0);
    case OutputLayer::Presence:
        return item.setLayer(layer(), {0.0, 1.0}, tr("Probability of a signal"), 1.0);
    case OutputLayer::Statistic:
        return;
    }
}

void OutputLayers::showRates(LayerItem &item, std::size_t axis)
{
    const double largest = largestRate(*m_document.analysis(), axis);
    const QString name = QString::fromStdString(m_document.analysis()->grid().axes[axis].unit);
    const FrequencyUnit unit = name == QLatin1String("Hz") ? rateUnit(largest) : FrequencyUnit{name + "/s", 1.0};
    const QString title = tr("Winning %1 (%2)").arg(rateName(axis), unit.name);
    item.setLayer(layer(), {-largest, largest}, title, unit.hz);
}

void OutputLayers::showAges(LayerItem &item)
{
    const double frameSeconds = m_document.analysis()->time().step;
    const std::vector<float> &ages = m_result.picture->age;
    const double longest = std::max(double(*std::max_element(ages.begin(), ages.end())), frameSeconds);
    constexpr double manySeconds = 7200.0;
    struct {
        QString name;
        double seconds;
    } unit{tr("s"), 1.0};
    if (const QString &frames = m_document.frameKind().ageUnit; !frames.isEmpty())
        unit = {frames, frameSeconds};
    else if (longest > manySeconds)
        unit = {tr("h"), 3600.0};
    item.setLayer(layer(), {0.0, longest}, tr("Path age since reset (%1)").arg(unit.name), unit.seconds);
}

} // namespace faintline

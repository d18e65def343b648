#include "app/control/OutputLayers.h"

#include "analysis/chain.h"
#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"
#include "widgets/pings/PingMap.h"
#include "widgets/pings/PolarLayerItem.h"
#include "widgets/pings/PolarView.h"
#include "widgets/waterfall/LayerItem.h"
#include "widgets/waterfall/WaterfallView.h"

#include <qwt_plot_canvas.h>

#include <QEvent>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr int pauseMs = 40;

} // namespace

OutputLayers::OutputLayers(Document &document, WaterfallView &output, QObject *parent)
    : QObject(parent), m_document(document), m_output(output), m_item(new LayerItem)
{
    m_item->attach(&output);
    m_item->makeKey().release()->attach(&output); // the plot's from now on
    output.installEventFilter(this);
    output.canvas()->installEventFilter(this);
    m_pause.setSingleShot(true);
    m_pause.setInterval(pauseMs);
    connect(&m_pause, &QTimer::timeout, this, &OutputLayers::compute);
    connect(&document, &Document::opened, this, [this] {
        m_runner.cancel();
        m_result = {};
        if (!isOffered(m_layer))
            setLayer(OutputLayer::Rate);
        show();
    });
    connect(&document, &Document::analysisChanged, this, &OutputLayers::follow);
    connect(&document.viewport(), &Viewport::spanChanged, this, [this] {
        if (m_layer != OutputLayer::Statistic)
            follow();
    });
    connect(&document.viewport(), &Viewport::cursorChanged, this, &OutputLayers::followCursor);
    connect(&output, &WaterfallView::orientationChanged, this, &OutputLayers::follow);
    connect(&m_runner, &JobRunner::failed, this, [this](const Error &error) {
        emit failed(error);
        emit settled();
    });
    connect(&m_runner, &JobRunner::finished, this, &OutputLayers::settled);
    connect(&m_runner, &JobRunner::cancelled, this, &OutputLayers::settled);
}

void OutputLayers::addPings(PingMap &map, PingViewports &viewports)
{
    m_map = &map;
    m_pings = &viewports;
    m_pingItem = new LayerItem;
    m_pingItem->attach(map.plane());
    m_pingItem->makeKey().release()->attach(map.plane());
    (new PolarLayerItem(*m_pingItem))->attach(map.polar());
    m_pingItem->makeKey().release()->attach(map.polar());
    map.plane()->installEventFilter(this);
    map.plane()->canvas()->installEventFilter(this);
    map.polar()->canvas()->installEventFilter(this);
    connect(&viewports.map(), &Viewport::spanChanged, this, [this] {
        if (m_layer != OutputLayer::Statistic)
            follow();
    });
    connect(&viewports, &PingViewports::placeChanged, this, &OutputLayers::followPing);
    connect(&map, &PingMap::polarChanged, this, &OutputLayers::follow);
    connect(map.plane(), &WaterfallView::orientationChanged, this, &OutputLayers::follow);
}

const LayerItem &OutputLayers::item() const
{
    return m_document.hasPings() && m_pingItem ? *m_pingItem : *m_item;
}

bool OutputLayers::isOffered(OutputLayer layer) const
{
    return layer != OutputLayer::SecondRate || m_document.hasPings();
}

bool OutputLayers::isPossible() const
{
    const auto &analysis = m_document.analysis();
    if (!analysis)
        return false;
    return m_document.hasPings() ? m_map != nullptr : analysis->grid().axes.size() == 1;
}

bool OutputLayers::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::PaletteChange && (watched == &m_output || (m_map && watched == m_map->plane())))
        show();
    if (event->type() == QEvent::Resize && !qobject_cast<WaterfallView *>(watched)
        && m_layer != OutputLayer::Statistic) // of a canvas
        follow();
    return QObject::eventFilter(watched, event);
}

void OutputLayers::setLayer(OutputLayer layer)
{
    if (layer == m_layer || !isOffered(layer))
        return;
    m_layer = layer;
    show();
    follow();
    emit layerChanged();
}

QString OutputLayers::heading() const
{
    switch (m_layer) {
    case OutputLayer::Rate:
        return m_document.hasPings() ? tr("Winning range rate of each cell") : tr("Winning slope of each cell");
    case OutputLayer::SecondRate:
        return tr("Winning bearing rate of each cell");
    case OutputLayer::Age:
        return tr("Age of each cell's best path");
    case OutputLayer::Reset:
        return tr("States reset");
    case OutputLayer::Inhibited:
        return tr("Inhibited cells");
    case OutputLayer::Statistic:
        break;
    }
    return tr("Statistic D");
}

void OutputLayers::cycleLayer()
{
    auto next = m_layer;
    do
        next = static_cast<OutputLayer>((std::size_t(next) + 1) % outputLayerNames.size());
    while (!isOffered(next));
    setLayer(next);
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

void OutputLayers::follow()
{
    if (isPossible() && (m_layer != OutputLayer::Statistic || m_isWatching))
        m_pause.start();
}

void OutputLayers::followCursor()
{
    if (!m_document.hasPings() && (m_isWatching || m_layer != OutputLayer::Statistic))
        follow();
}

/// A layer is of its own ping: what is known of another one is taken away at once.
void OutputLayers::followPing()
{
    if (!m_document.hasPings() || (!m_isWatching && m_layer == OutputLayer::Statistic))
        return;
    show();
    follow();
}

std::optional<OutputLayers::Place> OutputLayers::cursor() const
{
    const Analysis &analysis = *m_document.analysis();
    const std::vector<Axis> &axes = analysis.grid().axes;
    if (m_document.hasPings()) {
        const PingViewports::Place &place = m_pings->place();
        return Place{analysis.time().nearest(place.seconds),
                     axes[0].nearest(place.range) * axes[1].count + axes[1].nearest(place.bearing)};
    }
    const auto &at = m_document.viewport().cursor();
    return at ? std::optional(Place{analysis.time().nearest(at->seconds), axes[0].nearest(at->hz)}) : std::nullopt;
}

/// The part of the map in view, no finer than its pixels.
LayerWindow OutputLayers::windowOfPing() const
{
    const std::vector<Axis> &axes = m_document.analysis()->grid().axes;
    const Viewport &viewport = m_pings->map();
    const auto span = [](const Axis &axis, const Span &visible) {
        return std::pair(axis.nearest(visible.low), axis.nearest(visible.high) + 1);
    };
    const auto [firstRange, endRange] = span(axes[0], viewport.time());
    // On a cyclic axis the ends of a view all round are neighbours.
    const bool isAllRound = viewport.frequency().width() > axes[1].step * double(axes[1].count - 1);
    const auto [firstBeam, endBeam] =
        isAllRound ? std::pair(Index(0), axes[1].count) : span(axes[1], viewport.frequency());
    LayerWindow window{firstRange, endRange, firstBeam, endBeam, axes[0].count, axes[1].count};
    if (m_map->isPolar()) {
        const PolarView &polar = *m_map->polar();
        const double perPixel = polar.invTransform(QwtAxis::XBottom, 1.0) - polar.invTransform(QwtAxis::XBottom, 0.0);
        window.mostRows = std::max<Index>(1, Index(viewport.time().width() / perPixel));
    } else {
        const QSize size = m_map->plane()->canvas()->contentsRect().size();
        const bool isRangeVertical = m_map->plane()->orientation() != WaterfallView::Orientation::LeftToRight;
        window.mostRows = std::max(1, isRangeVertical ? size.height() : size.width());
        window.mostColumns = std::max(1, isRangeVertical ? size.width() : size.height());
    }
    return window;
}

/// The frames and cells in view, no finer than the pixels.
LayerWindow OutputLayers::window() const
{
    const Analysis &analysis = *m_document.analysis();
    const Viewport::Box &visible = m_document.viewport().visible();
    const Axis &time = analysis.time();
    const Axis &frequency = analysis.grid().axes.front();
    const QSize size = (QSizeF(m_output.canvas()->contentsRect().size()) * m_output.devicePixelRatioF()).toSize();
    const bool isTimeVertical = m_output.orientation() != WaterfallView::Orientation::LeftToRight;
    return {time.nearest(visible.time.low),
            time.nearest(visible.time.high) + 1,
            frequency.nearest(visible.frequency.low),
            frequency.nearest(visible.frequency.high) + 1,
            std::max(1, isTimeVertical ? size.height() : size.width()),
            std::max(1, isTimeVertical ? size.width() : size.height())};
}

void OutputLayers::compute()
{
    if (!isPossible())
        return emit settled();
    const auto analysis = m_document.analysis();
    const bool wantsPicture = m_layer != OutputLayer::Statistic;
    const bool isOfPing = m_document.hasPings();
    const LayerWindow wanted = isOfPing ? windowOfPing() : window();
    m_runner.start([this, analysis, cursor = cursor(), wantsPicture, isOfPing,
                    wanted](const RunContext &context) -> JobRunner::Delivery {
        if (!m_replay || m_replay->analysis() != analysis)
            m_replay = std::make_shared<LayerReplay>(
                analysis, memoryShares::orSome(memoryShares::layerReplay, 4 * bytesOfStates(*analysis)));
        Result result{analysis, {}, {}, cursor};
        if (wantsPicture)
            result.picture = std::make_shared<const LayerPicture>(
                isOfPing ? layerPictureOf(*m_replay, cursor->frame, wanted, context)
                         : layerPicture(*m_replay, wanted, context));
        if (cursor)
            result.atCursor = readCell(
                *analysis, m_replay->at(cursor->frame, context, {cursor->cell, cursor->cell + 1}), cursor->cell);
        return [this, result] {
            if (m_document.analysis() != result.analysis)
                return;
            m_result = result;
            show();
            emit readingChanged();
        };
    });
}

std::optional<CellReading> OutputLayers::readingAt(const Viewport::Point &point) const
{
    const auto &analysis = m_document.analysis();
    if (!analysis)
        return {};
    const Index frame = analysis->time().nearest(point.seconds);
    const Index cell = analysis->grid().axes.front().nearest(point.hz);
    return readingAt({frame, cell}, frame, cell);
}

std::optional<CellReading> OutputLayers::readingAt(const PingViewports::Place &place) const
{
    const auto &analysis = m_document.analysis();
    if (!analysis)
        return {};
    const std::vector<Axis> &axes = analysis->grid().axes;
    const Index frame = analysis->time().nearest(place.seconds);
    const Index row = axes[0].nearest(place.range);
    const Index column = axes[1].nearest(place.bearing);
    if (m_result.cursor && m_result.cursor->frame != frame)
        return {};
    return readingAt({frame, row * axes[1].count + column}, row, column);
}

std::optional<CellReading> OutputLayers::readingAt(const Place &place, Index row, Index column) const
{
    if (m_result.analysis != m_document.analysis())
        return {};
    if (m_result.atCursor && m_result.cursor == place)
        return m_result.atCursor;
    const Index pixel = m_result.picture ? m_result.picture->pixelAt(row, column) : -1;
    return pixel >= 0 ? std::optional(readPixel(*m_result.picture, pixel)) : std::nullopt;
}

void OutputLayers::show()
{
    const auto &analysis = m_document.analysis();
    const bool isOfPing = m_document.hasPings() && m_map;
    WaterfallView &view = isOfPing ? *m_map->plane() : m_output;
    LayerItem &item = isOfPing ? *m_pingItem : *m_item;
    const auto replot = [&] {
        view.replot();
        if (isOfPing)
            m_map->polar()->replot();
    };
    item.setTimeVertical(view.orientation() != WaterfallView::Orientation::LeftToRight);
    const Theme::Colours &colours = Theme::colours(view);
    item.setColours(colours.text, colours.canvas);
    const bool isKnown =
        analysis && m_result.analysis == analysis && m_result.picture && m_layer != OutputLayer::Statistic;
    if (!isKnown || (isOfPing && m_result.cursor->frame != cursor()->frame)) {
        item.setPicture(nullptr, {}, {});
        return replot();
    }
    const std::vector<Axis> &axes = analysis->grid().axes;
    item.setPicture(m_result.picture, isOfPing ? axes[0] : analysis->time(), isOfPing ? axes[1] : axes[0]);
    item.setOverlay(m_isOverlay, analysis->threshold);
    switch (m_layer) {
    case OutputLayer::Rate:
        showRates(item, 0);
        break;
    case OutputLayer::SecondRate:
        showRates(item, 1);
        break;
    case OutputLayer::Age: {
        const std::vector<float> &ages = m_result.picture->age;
        const double longest = std::max(double(*std::max_element(ages.begin(), ages.end())), analysis->time().step);
        constexpr double manySeconds = 7200.0;
        const bool isLong = longest > manySeconds;
        if (isOfPing)
            item.setLayer(m_layer, {0.0, longest}, tr("Path age since reset (pings)"), analysis->time().step);
        else
            item.setLayer(m_layer, {0.0, longest},
                          isLong ? tr("Path age since reset (h)") : tr("Path age since reset (s)"),
                          isLong ? 3600.0 : 1.0);
        break;
    }
    case OutputLayer::Reset:
        item.setLayer(m_layer, {0.0, 1.0}, tr("States reset (fraction)"), 1.0);
        break;
    case OutputLayer::Inhibited:
        item.setLayer(m_layer, {0.0, 1.0}, tr("Inhibited"), 1.0);
        break;
    case OutputLayer::Statistic:
        break;
    }
    replot();
}

void OutputLayers::showRates(LayerItem &item, std::size_t axis)
{
    const double largest = largestRate(*m_document.analysis(), axis);
    const QString name = QString::fromStdString(m_document.analysis()->grid().axes[axis].unit);
    const FrequencyUnit unit = name == QLatin1String("Hz") ? rateUnit(largest) : FrequencyUnit{name + "/s", 1.0};
    const QString title = !m_document.hasPings() ? tr("Winning slope (%1)")
                          : axis == 0            ? tr("Winning range rate (%1)")
                                                 : tr("Winning bearing rate (%1)");
    item.setLayer(m_layer, {-largest, largest}, title.arg(unit.name), unit.hz);
}

} // namespace faintline

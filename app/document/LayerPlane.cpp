#include "app/document/LayerPlane.h"

#include "inspect/outputLayers.h"
#include "widgets/base/cellsOf.h"
#include "widgets/pings/PingMap.h"
#include "widgets/pings/PolarLayerItem.h"
#include "widgets/pings/PolarView.h"
#include "widgets/waterfall/LayerItem.h"
#include "widgets/waterfall/WaterfallView.h"

#include <qwt_plot_canvas.h>

#include <algorithm>

namespace faintline {

LayerPlane::LayerPlane(const FrameKind &kind, WaterfallView &view, QObject *parent)
    : QObject(parent), m_kind(kind), m_view(view), m_item(*new LayerItem)
{
    m_item.attach(&view); // the plot's from now on, as its key
    m_item.makeKey().release()->attach(&view);
    view.installEventFilter(parent);
    view.canvas()->installEventFilter(parent);
    connect(&view.direction(), &TimeDirection::changed, this, &LayerPlane::shapeChanged);
}

bool LayerPlane::areRowsVertical() const
{
    return m_view.isTimeVertical();
}

LineLayerPlane::LineLayerPlane(WaterfallView &view, Viewport &viewport, QObject *watcher)
    : LayerPlane(lineFrames(), view, watcher), m_viewport(viewport)
{
    connect(&viewport, &Viewport::spanChanged, this, &LayerPlane::spanChanged);
    connect(&viewport, &Viewport::cursorChanged, this, &LayerPlane::cursorChanged);
}

LayerPart LineLayerPlane::part(const Analysis &analysis) const
{
    const auto [beginFrame, endFrame] = cellsOf(analysis.time(), m_viewport.time());
    const auto [beginCell, endCell] = cellsOf(analysis.grid().axes.front(), m_viewport.frequency());
    const QSize size = (QSizeF(m_view.canvas()->contentsRect().size()) * m_view.devicePixelRatioF()).toSize();
    return {beginFrame,
            endFrame,
            beginCell,
            endCell,
            std::max(1, areRowsVertical() ? size.height() : size.width()),
            std::max(1, areRowsVertical() ? size.width() : size.height())};
}

std::pair<Axis, Axis> LineLayerPlane::axes(const Analysis &analysis) const
{
    return {analysis.time(), analysis.grid().axes.front()};
}

void LineLayerPlane::replot()
{
    m_view.replot();
}

PingLayerPlane::PingLayerPlane(PingMap &map, PingViewports &viewports, QObject *watcher)
    : LayerPlane(pingFrames(), *map.plane(), watcher), m_map(map), m_viewports(viewports)
{
    (new PolarLayerItem(m_item))->attach(map.polar());
    m_item.makeKey().release()->attach(map.polar());
    map.polar()->canvas()->installEventFilter(watcher);
    connect(&viewports.map(), &Viewport::spanChanged, this, &LayerPlane::spanChanged);
    connect(&viewports, &PingViewports::placeChanged, this, &LayerPlane::cursorChanged);
    connect(&viewports, &PingViewports::planeChanged, this, &LayerPlane::cursorChanged);
    connect(&map.plane()->display(), &PictureDisplay::projectionChanged, this, &LayerPlane::shapeChanged);
}

LayerPart PingLayerPlane::part(const Analysis &analysis) const
{
    const auto [rows, columns] = axes(analysis);
    const Viewport &viewport = m_viewports.map();
    const auto [firstRow, endRow] = cellsOf(rows, viewport.time());
    // On a cyclic axis, the ends of a full view are neighbours.
    const bool isAllRound = viewport.frequency().width() > columns.step * double(columns.count - 1);
    const auto [firstColumn, endColumn] =
        isAllRound ? std::pair(Index(0), columns.count) : cellsOf(columns, viewport.frequency());
    LayerPart part{firstRow, endRow, firstColumn, endColumn, rows.count, columns.count};
    if (m_map.isPolar()) {
        const PolarView &polar = *m_map.polar();
        const double perPixel = polar.invTransform(QwtAxis::XBottom, 1.0) - polar.invTransform(QwtAxis::XBottom, 0.0);
        part.mostRows = std::max<Index>(1, Index(viewport.time().width() / perPixel));
    } else {
        const QSize size = m_view.canvas()->contentsRect().size();
        part.mostRows = std::max(1, areRowsVertical() ? size.height() : size.width());
        part.mostColumns = std::max(1, areRowsVertical() ? size.width() : size.height());
    }
    return part;
}

std::pair<Axis, Axis> PingLayerPlane::axes(const Analysis &analysis) const
{
    return {analysis.grid().axes[shown().along], analysis.grid().axes[shown().across]};
}

void PingLayerPlane::replot()
{
    m_view.replot();
    m_map.polar()->replot();
}

} // namespace faintline

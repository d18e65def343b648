#pragma once

#include "app/document/FrameKind.h"
#include "app/document/FramePlace.h"
#include "base/FramePlane.h"

#include <QObject>

#include <memory>
#include <utility>

namespace faintline {

struct Analysis;
class LayerItem;
struct LayerPart;
class PingMap;
class WaterfallView;

/// The picture over which layers are shown for one kind of frames: for lines the output's waterfall, for pings the map
/// of the ping under the cursor.
class LayerPlane : public QObject
{
    Q_OBJECT

public:
    const FrameKind &kind() const { return m_kind; }
    LayerItem &item() const { return m_item; } ///< owned by the view
    WaterfallView &view() const { return m_view; }

    /// Whether the picture shows a plane of a single frame; otherwise rows are frames.
    virtual bool isOfOneFrame() const = 0;
    /// That plane; for frames on one axis, the initial one.
    virtual const FramePlane &shown() const = 0;
    virtual std::optional<FramePlace> cursor() const = 0;
    /// The visible part, with a resolution limited to its pixels.
    virtual LayerPart part(const Analysis &analysis) const = 0;
    /// Rows and columns of that part.
    virtual std::pair<Axis, Axis> axes(const Analysis &analysis) const = 0;
    virtual void replot() = 0;

signals:
    void spanChanged();  ///< the visible part has changed
    void shapeChanged(); ///< the same part on other pixels
    void cursorChanged();

protected:
    LayerPlane(const FrameKind &kind, WaterfallView &view, QObject *parent);
    /// Whether rows run along the picture's height.
    bool areRowsVertical() const;

    const FrameKind &m_kind;
    WaterfallView &m_view;
    LayerItem &m_item;
};

/// Time × frequency on a waterfall.
class LineLayerPlane : public LayerPlane
{
public:
    LineLayerPlane(WaterfallView &view, Viewport &viewport, QObject *watcher);

    bool isOfOneFrame() const override { return false; }
    const FramePlane &shown() const override { return m_shown; }
    std::optional<FramePlace> cursor() const override { return cursorOf(m_viewport); }
    LayerPart part(const Analysis &analysis) const override;
    std::pair<Axis, Axis> axes(const Analysis &analysis) const override;
    void replot() override;

private:
    const Viewport &m_viewport;
    FramePlane m_shown;
};

/// Two axes of one ping, as a plane or from above.
class PingLayerPlane : public LayerPlane
{
public:
    PingLayerPlane(PingMap &map, PingViewports &viewports, QObject *watcher);

    bool isOfOneFrame() const override { return true; }
    const FramePlane &shown() const override { return m_viewports.plane(); }
    std::optional<FramePlace> cursor() const override { return cursorOf(m_viewports); }
    LayerPart part(const Analysis &analysis) const override;
    std::pair<Axis, Axis> axes(const Analysis &analysis) const override;
    void replot() override;

private:
    PingMap &m_map;
    const PingViewports &m_viewports;
};

} // namespace faintline

#pragma once

#include "app/base/JobRunner.h"
#include "app/document/Document.h"
#include "app/document/FramePlace.h"
#include "inspect/outputLayers.h"

#include <memory>
#include <optional>

namespace faintline {

class LayerItem;
class LayerPlane;
class PingMap;
class WaterfallView;

/// Layers of the detector's output besides the statistic: winning rate, path age, resets, inhibited cells, presence of
/// the tracks, instead of the statistic or over it; and the best state at the cursor. Each kind of frames has a plane
/// on which they are shown.
///
/// Computed for the visible part on a worker by repeating the run (LayerReplay), or from the tracks; the newest view
/// wins. Nothing is computed while no layer is shown and the cursor is not watched.
class OutputLayers : public QObject
{
    Q_OBJECT

public:
    OutputLayers(Document &document, WaterfallView &output, QObject *parent = nullptr);
    /// Adds the views of pings.
    void addPings(PingMap &map, PingViewports &viewports);

    /// Whether the open source has this layer.
    bool isOffered(OutputLayer layer) const;
    /// As chosen; where the open source lacks that layer, the one in its place.
    OutputLayer layer() const;
    OutputLayer chosen() const { return m_layer; }
    /// Whether the picture shows a layer and not the statistic: there is an analysis, and no preview of other settings.
    bool isCovering() const;
    QString heading() const; ///< heading of a picture that shows the layer
    bool isOverlay() const { return m_isOverlay; }

    /// Values of a cell: exact for the cell under the cursor, elsewhere from the layer's picture.
    std::optional<CellReading> readingAt(const FramePlace &place) const;

public slots:
    void setLayer(faintline::OutputLayer layer);
    void cycleLayer();
    void toggleFound(); ///< presence, or the statistic
    void setOverlay(bool isOverlay);
    /// Whether the cursor's cell is evaluated even while no layer is shown.
    void setWatching(bool isWatching);

signals:
    void layerChanged();
    void readingChanged();
    void failed(const faintline::Error &error);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override; ///< for size and theme changes of the view

private:
    struct Place {
        Index frame = -1;
        Index cell = -1;
        Index row = -1, column = -1; ///< of the plane
        bool operator==(const Place &) const = default;
    };

    struct Result {
        std::shared_ptr<const Analysis> analysis;
        std::shared_ptr<const LayerPicture> picture;
        std::optional<CellReading> atCursor;
        std::optional<Place> cursor;
        std::optional<Index> frame; ///< the only frame in the picture
        FramePlane shown;           ///< of that frame
    };

    void add(LayerPlane *plane);
    LayerPlane &plane() const; ///< for the open source
    bool isKnown() const;
    bool isPossible() const;
    bool isWanted() const { return m_isWatching || layer() != OutputLayer::Statistic; }
    void follow();
    void followSpan();
    void followCursor(const LayerPlane &of);
    QString rateName(std::size_t axis) const;
    Place placeOf(const FramePlace &place) const;
    std::optional<Place> cursor() const;
    std::optional<Index> singleFrame(const std::optional<Place> &cursor) const;
    void show();
    void showLayer(LayerItem &item);
    void showRates(LayerItem &item, std::size_t axis);
    void showAges(LayerItem &item);

    Document &m_document;
    std::vector<LayerPlane *> m_planes; ///< one for each kind of frames
    OutputLayer m_layer = OutputLayer::Statistic;
    bool m_isOverlay = false;
    bool m_isWatching = false;
    Result m_result;
    std::shared_ptr<LayerReplay> m_replay; ///< used by jobs only, one at a time
    JobRunner m_runner{this};              ///< last, so that its jobs end first
};

} // namespace faintline

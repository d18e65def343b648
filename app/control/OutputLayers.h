#pragma once

#include "analysis/outputLayers.h"
#include "app/base/JobRunner.h"
#include "app/control/FramePlace.h"
#include "app/document/Document.h"

#include <QTimer>

#include <memory>
#include <optional>

namespace faintline {

class LayerItem;
class LayerPlane;
class PingMap;
class WaterfallView;

/// What else the detector says of its output than the statistic: winning rate, path age, resets, inhibited cells, in
/// the statistic's place or over it; and the best state at the cursor. Each kind of frames has a plane that they are
/// shown on.
///
/// Computed for what can be seen, on a worker, by going through the run again (LayerReplay); the newest view wins.
/// Nothing is computed while no layer is on and nobody watches the cursor.
class OutputLayers : public QObject
{
    Q_OBJECT

public:
    OutputLayers(Document &document, WaterfallView &output, QObject *parent = nullptr);
    /// Where pings are looked at.
    void addPings(PingMap &map, PingViewports &viewports);

    /// Whether what is open has such a layer.
    bool isOffered(OutputLayer layer) const;
    OutputLayer layer() const { return m_layer; }
    QString heading() const; ///< of a picture that shows the layer
    bool isOverlay() const { return m_isOverlay; }
    const LayerItem &item() const; ///< of what is open
    bool isBusy() const { return m_pause.isActive() || m_runner.isRunning(); }

    /// What is known of that cell: exactly of the one under the cursor, elsewhere as far as a layer's picture goes.
    std::optional<CellReading> readingAt(const FramePlace &place) const;

public slots:
    void setLayer(faintline::OutputLayer layer);
    void cycleLayer();
    void setOverlay(bool isOverlay);
    /// Whether the cursor's cell is followed even while no layer is on.
    void setWatching(bool isWatching);

signals:
    void layerChanged();
    void readingChanged();
    void failed(const faintline::Error &error);
    void settled();

protected:
    bool eventFilter(QObject *watched, QEvent *event) override; ///< the view's: another size, another theme

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
        std::optional<Index> frame; ///< the only one in the picture
    };

    void add(LayerPlane *plane);
    LayerPlane &plane() const; ///< of what is open
    bool isPossible() const;
    bool isWanted() const { return m_isWatching || m_layer != OutputLayer::Statistic; }
    void follow();
    void followSpan();
    void followCursor(const LayerPlane &of);
    void compute();
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
    QTimer m_pause;                        ///< a view on its way is not computed
    std::shared_ptr<LayerReplay> m_replay; ///< touched by jobs only, one at a time
    JobRunner m_runner;                    ///< last, so that its jobs end first
};

} // namespace faintline

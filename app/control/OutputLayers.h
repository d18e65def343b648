#pragma once

#include "analysis/outputLayers.h"
#include "app/base/JobRunner.h"
#include "app/document/Document.h"
#include "widgets/pings/PingViewports.h"

#include <QTimer>

#include <memory>
#include <optional>

namespace faintline {

class LayerItem;
class PingMap;
class WaterfallView;

/// What else the detector says of its output than the statistic: winning rate, path age, resets, inhibited cells, in
/// the statistic's place or over it; and the best state at the cursor. Of lines on their waterfall, of pings on the map
/// of the one that is shown.
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
    std::optional<CellReading> readingAt(const Viewport::Point &point) const;
    std::optional<CellReading> readingAt(const PingViewports::Place &place) const;

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
        bool operator==(const Place &) const = default;
    };

    struct Result {
        std::shared_ptr<const Analysis> analysis;
        std::shared_ptr<const LayerPicture> picture;
        std::optional<CellReading> atCursor;
        std::optional<Place> cursor;
    };

    bool isPossible() const;
    void follow();
    void followCursor();
    void followPing();
    void compute();
    std::optional<Place> cursor() const;
    std::optional<CellReading> readingAt(const Place &place, Index row, Index column) const;
    LayerWindow window() const;
    LayerWindow windowOfPing() const;
    void show();
    void showRates(LayerItem &item, std::size_t axis);

    Document &m_document;
    WaterfallView &m_output;
    LayerItem *m_item; ///< the view's
    PingMap *m_map = nullptr;
    PingViewports *m_pings = nullptr;
    LayerItem *m_pingItem = nullptr; ///< the map's
    OutputLayer m_layer = OutputLayer::Statistic;
    bool m_isOverlay = false;
    bool m_isWatching = false;
    Result m_result;
    QTimer m_pause;                        ///< a view on its way is not computed
    std::shared_ptr<LayerReplay> m_replay; ///< touched by jobs only, one at a time
    JobRunner m_runner;                    ///< last, so that its jobs end first
};

} // namespace faintline

#pragma once

#include "analysis/outputLayers.h"
#include "app/Document.h"
#include "app/JobRunner.h"

#include <QTimer>

#include <memory>
#include <optional>

namespace faintline {

class LayerItem;
class WaterfallView;

/// What else the detector says of its output than the statistic: winning rate, path age, resets, inhibited cells, in the statistic's
/// place or over it; and the best state at the cursor.
///
/// Computed for what can be seen, on a worker, by going through the run again (LayerReplay); the newest view wins. Nothing is computed
/// while no layer is on and nobody watches the cursor.
class OutputLayers : public QObject
{
    Q_OBJECT

public:
    OutputLayers(Document &document, WaterfallView &output, QObject *parent = nullptr);

    OutputLayer layer() const { return m_layer; }
    QString heading() const; ///< of a picture that shows the layer
    bool isOverlay() const { return m_isOverlay; }
    const LayerItem &item() const { return *m_item; }
    bool isBusy() const { return m_pause.isActive() || m_runner.isRunning(); }

    /// What is known of that cell: exactly of the one under the cursor, elsewhere as far as a layer's picture goes.
    std::optional<CellReading> readingAt(const Viewport::Point &point) const;

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
    struct Result {
        std::shared_ptr<const Analysis> analysis;
        std::shared_ptr<const LayerPicture> picture;
        std::optional<CellReading> atCursor;
        Index frame = -1; ///< of the cursor
        Index cell = -1;
    };

    bool isPossible() const;
    void follow();
    void followCursor();
    void compute();
    LayerWindow window() const;
    void show();

    Document &m_document;
    WaterfallView &m_output;
    LayerItem *m_item; ///< the view's
    OutputLayer m_layer = OutputLayer::Statistic;
    bool m_isOverlay = false;
    bool m_isWatching = false;
    Result m_result;
    QTimer m_pause; ///< a view on its way is not computed
    std::shared_ptr<LayerReplay> m_replay; ///< touched by jobs only, one at a time
    JobRunner m_runner;                    ///< last, so that its jobs end first
};

} // namespace faintline

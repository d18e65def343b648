#pragma once

#include "analysis/Review.h"
#include "base/Axis.h"
#include "recording/Truth.h"
#include "spectrum/PeakPyramid.h"
#include "track/Track.h"
#include "widgets/ColourLevels.h"
#include "widgets/ColourMap.h"
#include "widgets/Sidebands.h"
#include "widgets/ThemedPlot.h"
#include "widgets/Viewport.h"

#include <QPointer>

#include <memory>
#include <optional>
#include <vector>

class QMenu;
class QwtPlotGrid;

namespace faintline {

class CanvasSentence;
class OverlayItem;
class RasterItem;
class WaterfallMouse;

/// A spectrogram, or a detector's statistic, over time and frequency; or over any two axes, such as a sonar's range and bearing:
/// where the picture's own axis is no time, it is labelled as what it is.
///
/// The picture is a PeakPyramid and keeps its maxima in time and frequency however far one zooms out; zoomed in, every
/// cell is a plain rectangle. Looking (zooming, colours, orientation) is the view's own affair and is told by signals
/// that say `…Changed`; what touches the document is only asked for by signals that say `…Requested`.
///
/// This file says what is shown and how it is laid out; what a hand does to it is WaterfallMouse's and waterfallCommands', what is
/// said about it waterfallWords', what is drawn RasterItem's and, above that, OverlayItem's.
class WaterfallView : public ThemedPlot
{
    Q_OBJECT

public:
    enum class Orientation { NewestOnTop, OldestOnTop, LeftToRight };
    Q_ENUM(Orientation)

    enum Layer {
        EventLayer = 1,
        TrackLayer = 2,
        TruthLayer = 4,
        ThresholdLayer = 8, ///< cells above the threshold are outlined
        GridLayer = 16,
        CursorLayer = 32
    };
    Q_DECLARE_FLAGS(Layers, Layer)

    /// `heading`: what the picture shows, "Input" or "Statistic".
    explicit WaterfallView(const QString &heading, QWidget *parent = nullptr);
    ~WaterfallView() override;

    /// Shared with other views; not owned. The caller sets its extents (see `extents`).
    void setViewport(Viewport *viewport);
    Viewport *viewport() const { return m_viewport; }

    /// The picture and the axis of its cells. Null shows the empty sentence. The range stays unless it is automatic.
    void setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency);
    /// The next one of a film, on the same axes: colours keep their range, so that what moves is the signal.
    void setNextPicture(std::shared_ptr<const PeakPyramid> picture);
    const std::shared_ptr<const PeakPyramid> &picture() const { return m_picture; }
    const Axis &frequencyAxis() const { return m_frequency; }

    /// A stretch of the picture in rows of fewer frames: shown in its place wherever it holds all that can be seen and pixels are
    /// smaller than the picture's own rows. Another picture drops it.
    void setCloseup(std::shared_ptr<const PeakPyramid> closeup);
    /// The picture, or its close-up where that is what can be seen.
    const std::shared_ptr<const PeakPyramid> &shownPicture() const { return m_shown; }
    /// Of these two the one that tells most of that time.
    const PeakPyramid &finestPicture(const Span &time) const;
    double framesPerPixel() const; ///< as visible

    /// The box all cells of a picture fill: half a cell beyond the outermost frames and bins.
    static Viewport::Box extents(const Axis &time, const Axis &frequency);

    /// What stands on the canvas while there is no picture.
    void setEmptySentence(const QString &sentence);

    Orientation orientation() const { return m_orientation; }
    const ColourMap &colourMap() const { return *m_colourMap; }
    /// Values drawn in the map's first and last colour: dB or nat.
    const Span &range() const { return m_levels.range(); }
    bool isRangeAutomatic() const { return m_levels.isAutomatic(); }
    /// The range the picture's values suggest at this zoom: noise dark, what stands out of it bright.
    Span automaticRange() const;
    /// Number of pixels per byte of the picture's scale, for the whole picture, or its close-up, at this zoom.
    const std::vector<double> &histogram() const { return m_levels.histogram(); }
    QString valueUnit() const; ///< "dB", or the statistic's
    bool hasTime() const;      ///< as the picture's own axis
    /// What a statistic is measured in, "nat" unless said otherwise, and the heading that says so.
    void setStatisticUnit(const QString &unit, const QString &heading);

    /// The value of the cell there, at the finest level kept; nothing outside the picture.
    std::optional<double> valueAt(double seconds, double hz) const;

    std::optional<double> threshold() const { return m_threshold; }
    Layers layers() const { return m_layers; }
    int selectedEvent() const { return m_selectedEvent; }
    bool isMeasuring() const { return m_isMeasuring; }
    bool hasHarmonics() const { return m_hasHarmonics; }
    /// Of the sidebands round the cursor's frequency, Hz; 0: none are shown.
    double sidebandSpacing() const { return m_sidebandHz; }
    std::optional<Sidebands> sidebands() const; ///< as shown
    /// What is said about the sidebands: carrier, spacing, the level of each at the cursor's time.
    QString sidebandText() const;
    /// What is said about the measured box.
    QString selectionText() const;
    /// The strongest cell within a few pixels.
    std::optional<Viewport::Point> peakAround(const Viewport::Point &point) const;
    int eventAt(const QPointF &canvasPosition) const; ///< 0: none

    /// Pixel on the canvas ↔ time and frequency.
    Viewport::Point pointAt(const QPointF &canvasPosition) const;
    QPointF positionOf(const Viewport::Point &point) const;
    bool isTimeVertical() const { return m_orientation != Orientation::LeftToRight; }
    QwtAxisId timeAxis() const { return isTimeVertical() ? QwtAxis::YLeft : QwtAxis::XBottom; }
    QwtAxisId hzAxis() const { return isTimeVertical() ? QwtAxis::XBottom : QwtAxis::YLeft; }

    QSize sizeHint() const override { return {520, 420}; }
    QSize minimumSizeHint() const override { return {220, 180}; }

public slots:
    void setOrientation(faintline::WaterfallView::Orientation orientation);
    void cycleOrientation();
    void setColourMap(const QString &name);
    void cycleColourMap();
    void setRange(double low, double high);
    void setAutomaticRange();
    /// Moves the black or white level by so many steps of 1 dB or ½ nat.
    void stepBlack(int steps);
    void stepWhite(int steps);
    /// The contour on the statistic, in nats; NaN for none. Live while the threshold is dragged.
    void setThreshold(double nats);
    void setEvents(const std::vector<faintline::Event> &events);
    /// `time`: of the frames the tracks were made from.
    void setTracks(const std::vector<faintline::Track> &tracks, const faintline::Axis &time);
    void setTruth(const std::vector<faintline::TruthLine> &lines);
    void setSelectedEvent(int id); ///< 0: none
    void setFaintEvents(const std::vector<int> &ids); ///< rejected ones
    void setAnnotations(const std::vector<faintline::Annotation> &boxes);
    void setLayer(faintline::WaterfallView::Layer layer, bool isOn);
    void setMeasuring(bool isOn);
    void setHarmonics(bool isOn); ///< lines at the multiples of the cursor's frequency
    void setSidebandSpacing(double hz); ///< lines beside the cursor's frequency; 0: none
    void setSidebands(bool isOn);       ///< with a spacing that suits what is visible; a cursor is placed where there is none
    void setSelectionNote(const QString &note); ///< what else is known of the measured box; until it changes
    void moveCursorToPeak();                    ///< to the strongest cell nearby
    void setRubber(const std::optional<faintline::Viewport::Box> &box); ///< shown while a box is dragged

signals:
    /// The pointer is over a cell; `value` in dB or nat.
    void hovered(double seconds, double hz, double value);
    void hoverEnded();
    void orientationChanged(faintline::WaterfallView::Orientation orientation);
    void colourMapChanged(const QString &name);
    void rangeChanged(double low, double high);
    void histogramChanged();
    void shownPictureChanged();
    void thresholdChanged(double nats); ///< NaN: none
    void layersChanged();
    void measuringChanged(bool isOn);
    void harmonicsChanged(bool isOn);
    void sidebandsChanged(double spacingHz); ///< 0: none
    /// `,` and `.`: so many steps of a quarter nat.
    void thresholdStepRequested(int steps);
    void eventActivated(int id);
    /// Emitted before the context menu opens: add actions to it. The point is where it was asked for.
    void contextMenuRequested(QMenu *menu, double seconds, double hz);

protected:
    void keyPressEvent(QKeyEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void contextMenuEvent(QContextMenuEvent *event) override;
    void restyle() override;
    void followCanvas() override { followSpan(); }

private:
    Viewport::Box full() const;
    Viewport::Box visible() const;
    void followSpan();
    void followCursor();
    void choosePicture();
    void countHistogram();
    void applyRange(const Span &range);
    double levelStep() const;
    void updateContent();
    void updateMarks();

    QString m_heading;
    QString m_statisticUnit = QStringLiteral("nat");
    QPointer<Viewport> m_viewport;
    std::shared_ptr<const PeakPyramid> m_picture;
    std::shared_ptr<const PeakPyramid> m_closeup;
    std::shared_ptr<const PeakPyramid> m_shown; ///< one of them
    Axis m_frequency;
    RasterItem *m_raster;
    OverlayItem *m_overlay;
    CanvasSentence *m_sentence;
    QwtPlotGrid *m_grid;
    const ColourMap *m_colourMap;
    Orientation m_orientation = Orientation::NewestOnTop;
    ColourLevels m_levels;
    std::optional<double> m_threshold;
    Layers m_layers = Layers(EventLayer | TrackLayer | TruthLayer | ThresholdLayer | CursorLayer);
    std::vector<Event> m_events;
    int m_selectedEvent = 0;
    bool m_isMeasuring = false;
    bool m_hasHarmonics = false;
    double m_sidebandHz = 0.0;
    QString m_selectionNote;
    std::unique_ptr<WaterfallMouse> m_mouse;
};

Q_DECLARE_OPERATORS_FOR_FLAGS(WaterfallView::Layers)

} // namespace faintline

#pragma once

#include "analysis/Review.h"
#include "base/Axis.h"
#include "recording/Truth.h"
#include "spectrum/PeakPyramid.h"
#include "track/Track.h"
#include "widgets/ColourMap.h"
#include "widgets/Sidebands.h"
#include "widgets/Viewport.h"

#include <qwt_plot.h>

#include <QPointer>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

class QMenu;
class QwtPlotGrid;

namespace faintline {

class CanvasSentence;
class OverlayItem;
class RasterItem;

/// A spectrogram, or a detector's statistic, over time and frequency; or over any two axes, such as a sonar's range and bearing:
/// where the picture's own axis is no time, it is labelled as what it is.
///
/// The picture is a PeakPyramid and keeps its maxima in time and frequency however far one zooms out; zoomed in, every
/// cell is a plain rectangle. Looking (zooming, colours, orientation) is the view's own affair and is told by signals
/// that say `…Changed`; what touches the document is only asked for by signals that say `…Requested`.
///
/// Mouse: wheel scrolls time, with Shift frequency, with Ctrl zooms about the pointer, over an axis zooms that axis;
/// drag pans, Shift+drag zooms to a box, click places the cursor, double-click activates an event. Keys: arrows move
/// the cursor by a cell (with Ctrl by ten), Backspace back, 0 all, O orientation, [ ] black level, { } white level, A
/// automatic range, C colour map, `,` `.` threshold, M measure, H harmonics, I sidebands, K to the peak, Escape clears.
/// With Ctrl the cursor, a corner of the measured box and a dragged sideband go to the strongest cell nearby. A sideband's line is dragged
/// to change their spacing; Alt with Left and Right does so by a bin.
class WaterfallView : public QwtPlot
{
    Q_OBJECT

public:
    using Axis = faintline::Axis; ///< QwtPlot has one of its own
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
    double framesPerPixel() const; ///< as visible

    /// The box all cells of a picture fill: half a cell beyond the outermost frames and bins.
    static Viewport::Box extents(const Axis &time, const Axis &frequency);

    /// What stands on the canvas while there is no picture.
    void setEmptySentence(const QString &sentence);

    Orientation orientation() const { return m_orientation; }
    const ColourMap &colourMap() const { return *m_colourMap; }
    /// Values drawn in the map's first and last colour: dB or nat.
    const Span &range() const { return m_range; }
    bool isRangeAutomatic() const { return m_isRangeAutomatic; }
    /// The range the picture's values suggest at this zoom: noise dark, what stands out of it bright.
    Span automaticRange() const;
    /// Number of pixels per byte of the picture's scale, for the whole picture, or its close-up, at this zoom.
    const std::vector<double> &histogram() const { return m_histogram; }
    QString valueUnit() const; ///< "dB", or the statistic's
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
    /// What is said about the sidebands: carrier, spacing, the level of each at the cursor's time.
    QString sidebandText() const;
    /// What is said about the measured box.
    QString selectionText() const;

    /// Pixel on the canvas ↔ time and frequency.
    Viewport::Point pointAt(const QPointF &canvasPosition) const;
    QPointF positionOf(const Viewport::Point &point) const;

    /// The view's own actions, for a program's menus; the app adds to it through `contextMenuRequested`.
    void addActionsTo(QMenu *menu);

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
    void changeEvent(QEvent *event) override;
    void focusInEvent(QFocusEvent *event) override;
    void focusOutEvent(QFocusEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    enum class Drag { None, Press, Pan, Zoom, Measure, Sideband };

    bool isTimeVertical() const { return m_orientation != Orientation::LeftToRight; }
    QwtAxisId timeAxis() const { return isTimeVertical() ? QwtAxis::YLeft : QwtAxis::XBottom; }
    QwtAxisId hzAxis() const { return isTimeVertical() ? QwtAxis::XBottom : QwtAxis::YLeft; }
    Viewport::Box full() const;
    Viewport::Box visible() const;
    void layAxes();
    void followSpan();
    void followCursor();
    void choosePicture();
    const PeakPyramid &pictureOf(const Span &time) const;
    void countHistogram();
    void applyRange(const Span &range);
    bool hasTime() const;
    void updateContent();
    void updateMarks();
    std::optional<Sidebands> sidebands() const;
    int sidebandAt(const QPointF &canvasPosition) const;
    void dragSideband(const QMouseEvent &event);
    Viewport::Point pointOf(const QMouseEvent &event) const;
    std::optional<Viewport::Point> peakAround(const Viewport::Point &point) const;
    int eventAt(const QPointF &canvasPosition) const;
    void moveCursor(int right, int up, int cells);
    void clearMarks();
    void scroll(Qt::Orientation direction, double notches);
    void pressed(const QMouseEvent &event);
    void moved(const QMouseEvent &event);
    void released(const QMouseEvent &event);
    void hover(const QPointF &canvasPosition);
    Viewport::Box draggedBox(const Viewport::Point &to) const;
    void fillMenu(QMenu &menu);

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
    Span m_range{-6.0, 14.0};
    bool m_isRangeAutomatic = true;
    std::vector<double> m_histogram;
    std::pair<int, Index> m_histogramKey{-1, 0}; ///< level and cells per pixel it was counted at
    std::optional<double> m_threshold;
    Layers m_layers = Layers(EventLayer | TrackLayer | TruthLayer | ThresholdLayer | CursorLayer);
    std::vector<Event> m_events;
    int m_selectedEvent = 0;
    bool m_isMeasuring = false;
    bool m_hasHarmonics = false;
    double m_sidebandHz = 0.0;
    QString m_selectionNote;

    Drag m_drag = Drag::None;
    QPointF m_dragStart;         ///< canvas pixels
    Viewport::Box m_dragVisible; ///< what was visible when a pan began
    Viewport::Point m_dragOrigin; ///< where a box began
    int m_draggedOrder = 0;       ///< of the sideband
};

Q_DECLARE_OPERATORS_FOR_FLAGS(WaterfallView::Layers)

} // namespace faintline

#pragma once

#include "inspect/Review.h"
#include "scene/Truth.h"
#include "track/Track.h"
#include "widgets/waterfall/Sidebands.h"
#include "widgets/waterfall/WaterfallPicture.h"
#include "widgets/waterfall/overlayMarks.h"

class QwtPlotGrid;

namespace faintline {

class OverlayItem;

/// A picture with marks: events, tracks, truth, the threshold's contour, annotations, the cursor with its harmonics and
/// sidebands, the measured box. waterfallWords gives the texts, OverlayItem draws.
class MarkedWaterfall : public WaterfallPicture
{
    Q_OBJECT

public:
    explicit MarkedWaterfall(const QString &heading, PictureDisplay *display = nullptr,
                             TimeDirection *direction = nullptr);

    void setViewport(Viewport *viewport) override;
    void setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency) override;
    void setNextPicture(std::shared_ptr<const PeakPyramid> picture) override;

    PictureColours colours() const override; ///< with the threshold's contour, if that is shown
    int selectedEvent() const { return m_selectedEvent; }
    std::optional<Sidebands> sidebands() const;       ///< as shown
    int eventAt(const QPointF &canvasPosition) const; ///< 0: none

public slots:
    void setEvents(const std::vector<faintline::Event> &events);
    /// `time`: axis of the tracks' frames.
    void setTracks(const std::vector<faintline::Track> &tracks, const faintline::Axis &time);
    /// Events and tracks that are followed live, drawn according to their stage.
    void setLiveTracks(const std::vector<faintline::Event> &events,
                       const std::vector<std::shared_ptr<const faintline::Track>> &tracks, const faintline::Axis &time);
    void setTimes(const std::vector<faintline::OverlayTime> &times);
    void setAreas(const std::vector<faintline::AreaEvent> &areas); ///< shown with the events
    void setTruth(const std::vector<faintline::TruthLine> &lines);
    void setSelectedEvent(int id); ///< 0: none
    void setHoveredEvent(int id);  ///< under the pointer; 0: none
    /// Whether the picture itself is one of the tracks.
    void setTracksPictured(bool arePictured);
    void setFaintEvents(const std::vector<int> &ids); ///< rejected ones
    void setAnnotations(const std::vector<faintline::Annotation> &boxes);
    void setSidebands(bool isOn); ///< uses a spacing that suits the visible part; places a cursor if there is none
    void setCursorNote(const QString &note);    ///< additional text for the cursor, in a corner
    void setSelectionNote(const QString &note); ///< additional text for the measured box, until that changes
    void moveCursorToPeak();                    ///< to the strongest cell nearby
    void setRubber(const std::optional<faintline::Viewport::Box> &box); ///< shown while a box is dragged

signals:
    /// The pointer is over a cell; `value` in dB or nat.
    void hovered(double seconds, double hz, double value);
    void hoverEnded();
    /// `,` and `.`: number of steps of a quarter nat.
    void thresholdStepRequested(int steps);
    void eventActivated(int id);

protected:
    void updateContent() override;

private:
    /// Carrier, spacing, the level of each at the cursor's time.
    QString sidebandText() const;
    QString selectionText() const; ///< of the measured box
    void followCursor();
    void updateMarks();

    OverlayItem *m_overlay;
    QwtPlotGrid *m_grid;
    std::vector<Event> m_events;
    int m_selectedEvent = 0;
    QString m_cursorNote;
    QString m_selectionNote;
};

} // namespace faintline

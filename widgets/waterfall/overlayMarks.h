#pragma once

#include "analyse/events.h"
#include "plan/Analysis.h"
#include "scene/Truth.h"
#include "widgets/base/Viewport.h"

#include <QPolygonF>
#include <QString>

#include <vector>

namespace faintline {

// Items that an OverlayItem draws for events, tracks, areas and the truth.

/// Stage of a track that is followed live; all others have ended.
enum class TrackStage { Provisional, Confirmed, Ended };

/// An event as a box with its number.
struct OverlayMark {
    int id = 0;
    Viewport::Box box;
    bool isConfirmed = true;
    TrackStage stage = TrackStage::Ended;
};

/// A box with a text: drawn by the user, or an area of raised level.
struct OverlayBox {
    Viewport::Box box;
    QString text;
    bool isFaint = false;
};

/// A polyline, x in seconds, y in Hz.
struct OverlayLine {
    int id = 0; ///< several have the same if a track has pauses
    QPolygonF points;
    QPolygonF band{}; ///< 5 % of the posterior forward, 95 % back, if known
    TrackStage stage = TrackStage::Ended;
};

/// A time, marked across the picture, from which settings differ.
struct OverlayTime {
    double seconds = 0.0;
    QString text;
};

/// One line for each stretch without a pause.
std::vector<OverlayLine> overlayLines(const std::vector<Track> &followed, const Axis &time, const Axis &frequency);
std::vector<OverlayLine> overlayLines(const std::vector<TruthLine> &known);
std::vector<OverlayBox> overlayBoxes(const std::vector<AreaEvent> &areas);
TrackStage stageOf(const Event &event);
/// Boxes around the events' tracks if available, otherwise along their straight lines; at least a bin and a frame wide.
std::vector<OverlayMark> overlayMarks(const std::vector<Event> &events, const std::vector<OverlayLine> &lines,
                                      double frameSeconds, double binHz);

} // namespace faintline

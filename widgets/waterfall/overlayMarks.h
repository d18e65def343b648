#pragma once

#include "analysis/analyse.h"
#include "recording/Truth.h"
#include "widgets/base/Viewport.h"

#include <QPolygonF>
#include <QString>

#include <vector>

namespace faintline {

// What an OverlayItem draws of events, tracks, areas and the truth.

/// How far a track has come, of those that are followed live: all others have ended.
enum class TrackStage { Provisional, Confirmed, Ended };

/// An event as a box with its number.
struct OverlayMark {
    int id = 0;
    Viewport::Box box;
    bool isConfirmed = true;
    TrackStage stage = TrackStage::Ended;
};

/// A box with a text: one that somebody drew, or an area of raised level.
struct OverlayBox {
    Viewport::Box box;
    QString text;
    bool isFaint = false;
};

/// A polyline, x in seconds, y in Hz.
struct OverlayLine {
    int id = 0;
    QPolygonF points;
    QPolygonF band{}; ///< 5 % of the posterior forth, 95 % back, where it is known
    TrackStage stage = TrackStage::Ended;
};

/// A time, across the picture, from which something is different.
struct OverlayTime {
    double seconds = 0.0;
    QString text;
};

std::vector<OverlayLine> overlayLines(const std::vector<Track> &followed, const Axis &time, const Axis &frequency);
std::vector<OverlayLine> overlayLines(const std::vector<TruthLine> &known);
std::vector<OverlayBox> overlayBoxes(const std::vector<AreaEvent> &areas);
TrackStage stageOf(const Event &event);
/// Boxes around the events' tracks where there are any, otherwise along their straight lines; at least a bin and a
/// frame wide.
std::vector<OverlayMark> overlayMarks(const std::vector<Event> &events, const std::vector<OverlayLine> &lines,
                                      double frameSeconds, double binHz);

} // namespace faintline

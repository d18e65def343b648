#pragma once

#include "analysis/analyse.h"
#include "recording/PingTruth.h"
#include "recording/Truth.h"
#include "widgets/base/Span.h"

#include <optional>
#include <vector>

namespace faintline {

/// What is to be marked on the map of one ping, in the units of the range and the bearing axis.
struct PingMarks {
    struct Place {
        double range = 0.0;
        double bearing = 0.0;
    };
    /// Where something has been in the last pings, oldest first; the last place is that of this ping.
    struct Trail {
        int id = 0;
        std::vector<Place> places;
        bool isDetected = true; ///< false: before its detection, known only because its path was traced back
        bool isConfirmed = true;
    };
    /// Cells kept from the detector in this ping.
    struct Box {
        int track = 0;
        int pings = 0; ///< for how many pings in a row, this one included, something has been kept for that track
        Span range;
        Span bearing;
    };
    /// A track that starts in this ping.
    struct Detection {
        int id = 0;
        Place place;
    };

    std::vector<Trail> tracks;
    std::vector<Trail> conventional; ///< of the conventional detector: places of its hits
    std::vector<Trail> truth;
    std::vector<Box> boxes; ///< one that goes over the end of a cyclic axis is in two pieces
    std::vector<Detection> detections;

    /// The box over a place, of the oldest track among several.
    const Box *boxAt(const Place &place) const;
};

/// The marks of one ping of an analysis on two axes: of these tracks, and of the known targets.
PingMarks pingMarks(const Analysis &analysis, const std::vector<Track> &tracks, const PingTruth &truth, Index ping,
                    Index tailPings = 12);

/// One axis's view of tracks on two axes: the same tracks on a grid of that axis alone. Where a path goes over the end
/// of a cyclic axis, it is cut: the pieces are tracks of the same number.
std::vector<Track> tracksAlong(const std::vector<Track> &tracks, const Grid &grid, std::size_t axis);

/// The same for events …
std::vector<Event> eventsAlong(std::vector<Event> events, std::size_t axis);

/// … and for known targets, as lines over time whose frequency is the place on the axis.
std::vector<TruthLine> truthAlong(const PingTruth &truth, const Grid &grid, const Axis &time, std::size_t axis);

} // namespace faintline

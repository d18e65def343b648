#pragma once

#include "analyse/events.h"
#include "base/FramePlane.h"
#include "plan/Analysis.h"
#include "scene/PingTruth.h"
#include "scene/Truth.h"
#include "widgets/base/Span.h"

#include <optional>
#include <vector>

namespace faintline {

/// Marks on the map of one ping, in the units of the two axes shown.
struct PingMarks {
    struct Place {
        double along = 0.0;  ///< such as range
        double across = 0.0; ///< such as bearing
    };
    /// Positions in the last pings, oldest first; the last one is that of this ping.
    struct Trail {
        int id = 0;
        std::vector<Place> places;
        bool isDetected = true; ///< false: before its detection, from tracing its path back
        bool isConfirmed = true;
    };
    /// Cells inhibited in this ping.
    struct Box {
        int track = 0;
        int pings = 0; ///< consecutive pings, including this one, with an inhibited box for that track
        Span along;
        Span across;
    };
    /// A track that starts in this ping.
    struct Detection {
        int id = 0;
        Place place;
    };

    std::vector<Trail> tracks;
    std::vector<Trail> conventional; ///< of the conventional detector: positions of its hits
    std::vector<Trail> truth;
    std::vector<Box> boxes; ///< a box that wraps around the end of a cyclic axis is in two pieces
    std::vector<Detection> detections;

    /// The box at a place; that of the oldest track if there are several.
    const Box *boxAt(const Place &place) const;
};

/// The marks of one ping of an analysis on a plane of its axes, for these tracks and for the known targets. Where
/// hidden axes are cut, only what lies in the cut's cell or a neighbour of it is marked.
PingMarks pingMarks(const Analysis &analysis, const std::vector<Track> &tracks, const PingTruth &truth, Index ping,
                    const FramePlane &plane = {}, Index tailPings = 12);

/// Projection of tracks on several axes to one axis: the same tracks on a grid of that axis. A path that wraps around
/// the end of a cyclic axis is cut into tracks of the same number.
std::vector<Track> tracksAlong(const std::vector<Track> &tracks, const Grid &grid, std::size_t axis);

/// The same for events …
std::vector<Event> eventsAlong(std::vector<Event> events, std::size_t axis);

/// … and for known targets, as lines over time whose frequency is the position on the axis.
std::vector<TruthLine> truthAlong(const PingTruth &truth, const Grid &grid, const Axis &time, std::size_t axis);

} // namespace faintline

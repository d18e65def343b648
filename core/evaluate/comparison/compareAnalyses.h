#pragma once

#include "analyse/events.h"
#include "plan/Analysis.h"

#include <optional>
#include <vector>

namespace faintline {

/// Maximum distance between the positions of one signal in two analyses.
struct CompareTolerance {
    double cells = 4.0;  ///< along each axis, in steps of the coarser of the two grids
    double frames = 2.0; ///< in time, in frames of the coarser of the two

    bool operator==(const CompareTolerance &) const = default;
};

/// A signal detected by A, B or both.
struct ComparedEvent {
    enum class In { A, B, Both };

    std::optional<Event> a;
    std::optional<Event> b;
    double sharedSeconds = 0.0; ///< time for which both follow it within the tolerance

    In in() const { return !b ? In::A : !a ? In::B : In::Both; }
    const Event &event() const { return b ? *b : *a; } ///< that of B if it has one
};

/// Signals detected by two analyses of the same recording, ordered by onset, then frequency.
struct Comparison {
    std::vector<ComparedEvent> events;

    std::ptrdiff_t count(ComparedEvent::In in) const;
};

/// Determines which events of A and B are the same signal.
///
/// Two tracks are compared at common times: those from the later onset to the earlier end, each extended by the
/// tolerance in frames, where a track stays at its first or last position. They are one signal if they lie within the
/// tolerance along each axis for at least half of these times. Pairs are one to one, those that share the longest time
/// first; a line that one detector breaks into pieces is in both once, and its other pieces belong to that detector
/// alone. Apart from ties, exchanging A and B only exchanges their roles.
///
/// The axes must measure the same quantities; their steps may differ. Tested on hand-made tracks. Cost: pairs of tracks
/// whose boxes touch × at most 1000 times.
Comparison compareAnalyses(const Analysis &a, const Analysis &b, const CompareTolerance &tolerance = {});

} // namespace faintline

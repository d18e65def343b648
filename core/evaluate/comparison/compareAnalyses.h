#pragma once

#include "analysis/analyse.h"

#include <optional>
#include <vector>

namespace faintline {

/// How far apart two analyses may place one and the same signal.
struct CompareTolerance {
    double cells = 4.0;  ///< along every axis, in steps of the coarser of the two grids
    double frames = 2.0; ///< in time, in frames of the coarser of the two

    bool operator==(const CompareTolerance &) const = default;
};

/// A signal that A, B or both have found.
struct ComparedEvent {
    enum class In { A, B, Both };

    std::optional<Event> a;
    std::optional<Event> b;
    double sharedSeconds = 0.0; ///< how long both follow it within the tolerance

    In in() const { return !b ? In::A : !a ? In::B : In::Both; }
    const Event &event() const { return b ? *b : *a; } ///< B's where there is one
};

/// What two analyses of the same recording have found, ordered by onset, then frequency.
struct Comparison {
    std::vector<ComparedEvent> events;

    std::ptrdiff_t count(ComparedEvent::In in) const;
};

/// Which events of A and B are the same signal.
///
/// Two tracks are compared at common times: those from the later onset to the earlier end, each extended by the
/// tolerance in frames, where a track stays at its first or last place. They are one signal if they lie within the
/// tolerance along every axis for at least half of these times. Pairs are one to one, those that share the longest time
/// first; a line that one detector breaks into pieces is in both once, and its other pieces are that one's alone.
/// Exchanging A and B exchanges nothing else, but for ties.
///
/// The axes must measure the same quantities; their steps may differ. Tested on tracks made by hand. Cost: pairs of
/// tracks whose boxes touch × at most 1000 times.
Comparison compareAnalyses(const Analysis &a, const Analysis &b, const CompareTolerance &tolerance = {});

} // namespace faintline

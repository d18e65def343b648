#pragma once

#include "widgets/pings/PingMarks.h"

namespace faintline {

/// A simulated target as it is drawn for editing.
struct TargetShape {
    std::vector<PingMarks::Place> path;    ///< one place per ping
    std::vector<PingMarks::Place> corners; ///< its start and the ends of its legs, which can be dragged
};

/// One corner of one target, by their numbers; target -1: none.
struct TargetHandle {
    int target = -1;
    int corner = 0;

    bool isNone() const { return target < 0; }
    bool operator==(const TargetHandle &) const = default;
};

} // namespace faintline

#pragma once

#include "analysis/explain.h"
#include "analysis/pathEvidence.h"

#include <span>
#include <vector>

namespace faintline {

/// What one member of a family brought along a path, in one channel where several are added.
struct FamilyTooth {
    double member = 0.0;    ///< the multiple, or the distance in Hz
    double hz = 0.0;        ///< where it lies at the path's end
    int channel = -1;       ///< of the recording; -1 where there is only one
    Index frames = 0;       ///< of the path in which it lay inside the band and was observed
    double meanPower = 0.0; ///< mean y over these frames, 1 on noise; 0 without any
    /// Σ over these frames of λ(y of all members) - λ(y of the others), nat: what the path would have less without it.
    /// Negative: without it, it would have more.
    double evidence = 0.0;

    bool isSeen() const { return evidence > 0.0; }
    bool operator==(const FamilyTooth &) const = default;
};

/// The members of the analysis's family along a path of its frames, in the order of the settings, each in all channels
/// that are added; of no family, the line in each of several channels; none without either. λ is that of its model
/// number `model`.
///
/// Members in common carry the evidence, so their parts do not add up to it: where any of two would do, each one's is
/// small. In a frame in which a member is the only one observed its part is all of λ. Throws Error for frames or cells
/// that do not exist, Cancelled. Cost: one transform a frame. Oracle: y of an analysis without a family, gamma
/// functions of Boost.Math.
std::vector<FamilyTooth> familyTeeth(const Analysis &analysis, std::span<const PathCell> path, std::size_t model = 0,
                                     const RunContext &context = {});

/// The same along the path that an explanation found.
std::vector<FamilyTooth> familyTeeth(const Analysis &analysis, const Explanation &explanation,
                                     const RunContext &context = {});

} // namespace faintline

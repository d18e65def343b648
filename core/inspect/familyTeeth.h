#pragma once

#include "inspect/explain.h"
#include "inspect/pathEvidence.h"

#include <span>
#include <vector>

namespace faintline {

/// The contribution of one family member to a path; per channel if several channels are summed.
struct FamilyTooth {
    double member = 0.0;    ///< the multiple, or the offset in Hz
    double hz = 0.0;        ///< its frequency at the path's end
    int channel = -1;       ///< of the recording; -1 if there is only one
    Index frames = 0;       ///< of the path in which it was in the band and observed
    double meanPower = 0.0; ///< mean y over these frames, 1 on noise; 0 if there are none
    /// Σ over these frames of λ(y of all members) - λ(y of the others), nat: the score that the path would lose without
    /// this member. Negative if the path would gain.
    double evidence = 0.0;

    bool isSeen() const { return evidence > 0.0; }
    bool operator==(const FamilyTooth &) const = default;
};

/// The members of the analysis's family along a path of its frames, in the order of the settings, each in all channels
/// that are summed. Without a family: the line in each of several channels, or nothing for a single one. λ is that of
/// the family's model number `model`.
///
/// The evidence is joint, so the contributions do not add up to it: where either of two members would suffice, each
/// contributes little. In a frame where only one member is observed, it contributes all of λ. Throws Error if frames or
/// cells do not exist, Cancelled. Cost: one transform per frame. Oracle: y of an analysis without a family, gamma
/// functions of Boost.Math.
std::vector<FamilyTooth> familyTeeth(const Analysis &analysis, std::span<const PathCell> path, std::size_t model = 0,
                                     const RunContext &context = {});

/// The same, along the path found by an explanation.
std::vector<FamilyTooth> familyTeeth(const Analysis &analysis, const Explanation &explanation,
                                     const RunContext &context = {});

} // namespace faintline

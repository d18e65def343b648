#pragma once

#include "model/KinematicAxis.h"

#include <vector>

namespace faintline {

/// The evidence in a corridor around a path along one axis: `width` cells in each frame, from a first cell that follows
/// the path.
struct Corridor {
    Index width = 0;
    std::vector<Index> firstCells; ///< lowest cell of each frame; may lie off the axis
    std::vector<float> lambda;     ///< frames × width; -∞ off the axis

    Index frameCount() const { return Index(firstCells.size()); }
};

/// What is known of the signal before a corridor's first frame and after its last one.
struct CorridorEnds {
    bool absentBefore = false; ///< it begins in the corridor, or not at all; else both states are equally probable
    bool absentAfter = false;
};

/// Whether a signal is present, and where, given all frames before and after. One value per frame of the corridor.
struct Presence {
    std::vector<float> present;   ///< probability
    std::vector<double> mean;     ///< position given that it is present, cells
    std::vector<float> low, high; ///< 5 and 95 % quantiles of the position, linear inside a cell
};

/// Forward-backward algorithm for a hidden Markov chain with one state "off" and the corridor's states (rate, cell)
/// "on":
///
///   α_t(s)   ∝ e^{λ_t(s)} [p/N·α_{t-1}(off) + (1 - p) Σ_m P(s|m) α_{t-1}(m)]
///   α_t(off) ∝ (1 - p)·α_{t-1}(off) + p Σ_s α_{t-1}(s),        γ = α·β,   present = 1 - γ(off)
///
/// p = e^{lnChange}: for lnChange = -T/2 an interruption must be as significant as a detection. P is the axis's law in
/// step firstStep, firstStep + 1, …; probability that leaves the corridor is lost. Both states are equally probable
/// before the first frame and after the last one, unless `ends` says that the signal is absent there: a signal that is
/// present from the first frame on then costs as much as one that begins later, p, so that the evidence alone decides
/// where it begins. Source: Baum and others 1970. Oracle: enumeration of all sequences. Cost: frames × moves ×
/// width, twice if they fit into 2 MiB, else three times; memory: √frames.
Presence presenceIn(const Corridor &corridor, const KinematicAxis &axis, double lnChange, Index firstStep,
                    CorridorEnds ends = {});

/// Expected number of slope changes by 0, 1, … steps of the slope set between frames for a signal in the corridor,
/// given all of its frames and presence in both frames (Baum's ξ, summed over cells and directions). Has as many values
/// as the law.
std::vector<double> expectedSlopeChanges(const Corridor &corridor, const KinematicAxis &axis, double lnChange,
                                         Index firstStep);

/// The largest score of a path in the corridor, by the detector's own recursion:
///
///   u_t(s) = λ_t(s) + max(0, ln K_t + max_m [ln P(s|m) + u_{t-1}(m)])
///
/// `lnK`: one per frame.
double strongestPath(const Corridor &corridor, const KinematicAxis &axis, const std::vector<double> &lnK,
                     Index firstStep);

} // namespace faintline

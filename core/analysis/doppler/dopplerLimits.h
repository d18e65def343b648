#pragma once

#include "analysis/doppler/DopplerProblem.h"

#include <array>
#include <vector>

namespace faintline {

/// The best fit of a problem and what its intervals are measured by.
struct DopplerOptimum {
    DopplerCoordinates x;
    double cost = 0.0;     ///< sum of squares of the whitened residuals
    double variance = 1.0; ///< of one of them, estimated
    double critical = 0.0; ///< how many standard deviations an interval reaches: a quantile of Student's law
};

/// The limits of the four parameters by profile likelihood, in the order of DopplerParameter.
///
/// A value ψ of a parameter lies inside while √((min cost over the other three at ψ - cost)/variance) ≤ critical. From
/// the optimum the profile is followed outwards, in steps that grow, until that is exceeded; the crossing is found by
/// TOMS 748. Where one profile comes to places beyond another's limit, that one is followed further from there. An end
/// is open where it is not exceeded up to the limits of the parameter: f0 = 0, v = 0 and v = c, R a million times
/// smaller or larger, t0 200 track lengths away.
///
/// Where a profile comes upon a lower cost than the optimum's, `optimum` moves there, and the limits are those of the
/// new one.
///
/// `others`: other minima, which count where they lie inside.
std::array<DopplerBounds, 4> dopplerLimits(const DopplerProblem &problem, DopplerOptimum &optimum,
                                           const std::vector<DopplerCoordinates> &others);

} // namespace faintline

#pragma once

#include "inspect/doppler/DopplerProblem.h"

#include <array>
#include <vector>

namespace faintline {

/// The best fit of a problem and the scale of its intervals.
struct DopplerOptimum {
    DopplerCoordinates x;
    double cost = 0.0;     ///< sum of squares of the whitened residuals
    double variance = 1.0; ///< estimated variance of one of them
    double critical = 0.0; ///< half-width of an interval in standard deviations: a Student quantile
};

/// The limits of the four parameters by profile likelihood, in the order of DopplerParameter.
///
/// A value ψ of a parameter lies inside if √((min cost over the other three at ψ - cost)/variance) ≤ critical. The
/// profile is followed outwards from the optimum in growing steps until this is exceeded; TOMS 748 locates the
/// crossing. If another profile passes the limit, this one is followed further from there. An end is open if it is not
/// exceeded within the limits of the parameter: f0 = 0, v = 0 and v = c, R a million times smaller or larger, t0 200
/// track lengths away.
///
/// If a profile finds a lower cost than the optimum's, `optimum` moves there, and the limits are those of the new one.
///
/// `others`: other minima, included if they lie inside.
std::array<DopplerBounds, 4> dopplerLimits(const DopplerProblem &problem, DopplerOptimum &optimum,
                                           const std::vector<DopplerCoordinates> &others);

} // namespace faintline

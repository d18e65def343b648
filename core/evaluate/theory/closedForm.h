#pragma once

#include "analysis/Calibration.h"

#include <vector>

namespace faintline {

/// One point of an exceedance curve.
struct ExceedancePoint {
    double level = 0.0; ///< nat, or multiples of the noise
    double probability = 0.0;
};

/// P(D > T) of a cell of noise where it is known without simulating, for T from the lowest level worth drawing up to
/// where it falls below 10⁻¹⁵; empty where it is not.
///
///   energy       e^{-T}                                       for any overlap: one cell's law
///   integrator   gamma law of n looks (pfaOfMeanPower)        of a boxcar of n windows without overlap in time
///   SMD          σ e^{-(1-σ)(T + ln K)} (lindleyExceedance)   one slope kept, linear likelihood, no overlap in time,
///                                                             ln K < -1 fixed: D is Lindley's L before ln K is added,
///                                                             T ≥ -ln K
///
/// Bins beside one another may overlap: the law is that of one cell. That the noise background is estimated is left
/// out.
std::vector<ExceedancePoint> closedFormExceedance(const AnalysisSettings &settings, const Calibration &calibration);

} // namespace faintline

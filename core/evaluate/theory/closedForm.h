#pragma once

#include "frames/PeakPyramid.h"
#include "plan/Calibration.h"

#include <vector>

namespace faintline {

/// One point of an exceedance curve.
struct ExceedancePoint {
    double level = 0.0; ///< nat, or multiples of the noise
    double probability = 0.0;
};

/// P(D > T) of a noise cell where it is known in closed form, from the lowest T worth drawing to where it falls below
/// 10⁻¹⁵; empty otherwise.
///
///   energy       e^{-T}                                       for any overlap: one cell's law
///   integrator   gamma law of n looks (pfaOfMeanPower)        of a boxcar of n windows without overlap in time
///   SMD          σ e^{-(1-σ)(T + ln K)} (lindleyExceedance)   one slope kept, linear likelihood, no overlap in time,
///                                                             ln K < -1 fixed: D is Lindley's L before ln K is added,
///                                                             T ≥ -ln K
///
/// Adjacent bins may overlap: the law is that of one cell. The error of the estimated noise background is ignored.
std::vector<ExceedancePoint> closedFormExceedance(const AnalysisSettings &settings, const Calibration &calibration);

/// Fraction of cells in a box of a statistic's picture whose D exceeds a level, for each level of the picture's scale
/// (a quarter of a unit) down to the last level that ten cells exceed; this is the behaviour of noise in this recording
/// if the box holds nothing else. Frames begin … end-1 and cells begin … end-1 of the last axis. Examines at most 2·10⁶
/// cells, in evenly spread rows. Empty for an empty box, and if frames have been merged, because the picture then holds
/// maxima.
std::vector<ExceedancePoint> boxExceedance(const PeakPyramid &statistic, Index beginFrame, Index endFrame,
                                           Index beginCell, Index endCell);

} // namespace faintline

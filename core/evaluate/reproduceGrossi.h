#pragma once

#include "evaluate/reproduce.h"

namespace faintline {

/// Grossi and Lops, "Sequential detection and tracking …", 2006: ASN against what is known of the trajectory, correct trajectories, and
/// the radar case. The publication's figures give no numbers; references are an independent program's, with their standard errors.
/// 4·√(SE² + SE²) judges, for the coefficient of variation twice that.
Reproduction reproduceGrossiFigure2(const ReproduceOptions &options, const RunContext &context);
Reproduction reproduceGrossiFigure3(const ReproduceOptions &options, const RunContext &context);
Reproduction reproduceGrossiFigure4(const ReproduceOptions &options, const RunContext &context);

} // namespace faintline

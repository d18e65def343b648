#pragma once

namespace faintline {

/// Depth of a calibration. A first estimate has the same ln K and P(D > level), and rates from a fifth of the noise and
/// shorter splitting: accurate to a factor of about 1.5, after 2 s instead of 7. If that accuracy is not possible (no
/// score of paths, no splitting), the result is a refined one.
enum class CalibrationDepth { FirstEstimate, Refined };

} // namespace faintline

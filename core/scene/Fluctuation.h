#pragma once

#include "base/Random.h"

#include <array>
#include <string_view>

namespace faintline {

/// Fluctuation of a target's power about its mean: the cases of Swerling (1954), numbered as in the literature.
///
///   none        constant power, also called case 0 or 5
///   swerling1   exponential (χ² with 2 degrees of freedom), one power per look
///   swerling2   exponential, an independent power in each frame
///   swerling3   χ² with 4 degrees of freedom, one power per look
///   swerling4   χ² with 4 degrees of freedom, an independent power in each frame
///
/// A look is what a detector integrates: here a target's whole track, from its appearance to its end.
enum class Fluctuation { None, Swerling1, Swerling2, Swerling3, Swerling4 };
inline constexpr std::array<std::string_view, 5> fluctuationNames{"none", "swerling1", "swerling2", "swerling3",
                                                                  "swerling4"};

/// Whether each frame has an independent power (cases 2 and 4).
inline bool changesFromFrameToFrame(Fluctuation fluctuation)
{
    return fluctuation == Fluctuation::Swerling2 || fluctuation == Fluctuation::Swerling4;
}

/// Draws a power of mean 1: e^{-g} for cases 1 and 2, 4g·e^{-2g} for cases 3 and 4. Without fluctuation it is 1 and
/// nothing is drawn.
double relativePower(Fluctuation fluctuation, Random &random);

} // namespace faintline

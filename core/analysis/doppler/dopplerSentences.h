#pragma once

#include "analysis/doppler/DopplerPass.h"

#include <string>
#include <vector>

namespace faintline {

/// Limitations of a fit, most important first: open intervals and their reasons, evidence against a straight pass, and
/// what one sensor can never tell.
std::vector<std::string> dopplerSentences(const DopplerFit &fit, const std::vector<DopplerPoint> &points);

} // namespace faintline

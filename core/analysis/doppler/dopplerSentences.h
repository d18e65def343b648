#pragma once

#include "analysis/doppler/DopplerPass.h"

#include <string>
#include <vector>

namespace faintline {

/// What a fit cannot tell, most important first: what is open and why, what speaks against a straight pass, and what
/// one sensor never tells.
std::vector<std::string> dopplerSentences(const DopplerFit &fit, const std::vector<DopplerPoint> &points);

} // namespace faintline

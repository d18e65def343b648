#pragma once

#include "inspect/doppler/DopplerPass.h"

#include <string>
#include <vector>

namespace faintline {

/// Limitations of a fit, most important first: open intervals and their reasons, evidence against a straight pass, and
/// what one sensor cannot determine.
std::vector<std::string> dopplerSentences(const DopplerFit &fit, const std::vector<DopplerPoint> &points);

} // namespace faintline

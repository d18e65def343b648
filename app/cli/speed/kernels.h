#pragma once

#include <cstddef>
#include <vector>

namespace faintline {

struct SpeedKernel;

/// Of the detectors: states a second.
std::vector<SpeedKernel> recursionKernels();
/// Of what is before them and beside them: spectra, noise, evidence.
std::vector<SpeedKernel> signalKernels();

/// Names of forms that more than one kernel has.
inline const char *const ours = "faintline";
inline const char *const twoThreads = "two threads";

/// Powers of white noise, the same every time.
std::vector<float> exponentials(std::size_t n);

} // namespace faintline

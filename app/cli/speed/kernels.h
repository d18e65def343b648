#pragma once

#include <cstddef>
#include <vector>

namespace faintline {

struct SpeedKernel;

/// Kernels of the detectors: states per second.
std::vector<SpeedKernel> recursionKernels();
/// Kernels of spectra, noise and evidence.
std::vector<SpeedKernel> signalKernels();

/// Form names used by several kernels.
inline const char *const ours = "faintline";
inline const char *const twoThreads = "two threads";

/// Powers of white noise, the same in each run.
std::vector<float> exponentials(std::size_t n);

} // namespace faintline

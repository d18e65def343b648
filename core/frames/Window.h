#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace faintline {

/// Shapes of the sample window, by decreasing side lobes.
enum class WindowShape { Rectangular, Hann, Hamming, Blackman, BlackmanHarris, Kaiser };

/// Names as used in settings, in the order of WindowShape.
inline constexpr std::array<std::string_view, 6> windowShapeNames{"rectangular", "hann",           "hamming",
                                                                  "blackman",    "blackmanHarris", "kaiser"};

/// Symmetric window of `length` samples with unit energy, Σ w² = 1, so that complex white noise keeps unit variance in
/// each bin. Kaiser uses β = 14 (first side lobe -105 dB).
std::vector<float> sampleWindow(WindowShape shape, int length);

/// Number of neighbouring cells of white noise that carry as much information on its level as one independent cell: N Σ
/// w⁴ with Σ w² = 1, which is 1 for a rectangular and 35/18 for a Hann window.
double cellLikeness(const std::vector<float> &window);

/// Standard error of a mean over many successive frames, `steps` per window, relative to that over as many
/// independent ones.
double overlapFactor(const std::vector<float> &window, int steps);

/// Noise bandwidth of a bin, in resolution cells 1/T_FT: N·Σw²/(Σw)², which is 1 for a rectangular and 1.5 for a Hann
/// window.
double noiseBandwidthCells(WindowShape shape);

/// Half width of the main lobe, from its peak to its first zero, in resolution cells 1/T_FT.
double mainLobeHalfWidth(WindowShape shape);

/// Largest leakage |W(Δ)|²/|W(0)|² at a distance of Δ resolution cells or more, as a power ratio: the contribution that
/// a line can make to a bin that far away. The main lobe is bounded by the parabola (in dB) that touches its peak, side
/// lobes by their envelope; those of a sampled window alias at half the sample rate and are up to 6 dB higher there.
double leakageBound(WindowShape shape, double distanceCells);

/// Leakage |W(Δ)|²/|W(0)|² at a distance of Δ resolution cells, as a power ratio: the window's transform up to one cell
/// beyond its main lobe, leakageBound() further out.
double leakageAt(WindowShape shape, double distanceCells);

} // namespace faintline

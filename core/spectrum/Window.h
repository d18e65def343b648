#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace faintline {

/// The shapes a sample window can have, by falling side lobes.
enum class WindowShape { Rectangular, Hann, Hamming, Blackman, BlackmanHarris, Kaiser };

/// Names as settings spell them, in the order of WindowShape.
inline constexpr std::array<std::string_view, 6> windowShapeNames{"rectangular", "hann",           "hamming",
                                                                  "blackman",    "blackmanHarris", "kaiser"};

/// Symmetric window of `length` samples with unit energy, Σ w² = 1, so that complex white noise of unit variance keeps
/// unit variance in every bin. Kaiser takes β = 14 (first side lobe -105 dB).
std::vector<float> sampleWindow(WindowShape shape, int length);

/// How many neighbouring cells of white noise tell as much of its level as one that is like no other: N Σ w⁴ with Σ w²
/// = 1, which is 1 for a rectangle and 35/18 for Hann's.
double cellLikeness(const std::vector<float> &window);

/// By how much the scatter of a mean over many successive frames, `steps` of them a window, exceeds that over as many
/// independent ones.
double overlapFactor(const std::vector<float> &window, int steps);

/// Half the width of the main lobe, from its peak to its first zero, in resolution cells 1/T_FT.
double mainLobeHalfWidth(WindowShape shape);

/// Largest leakage |W(Δ)|²/|W(0)|² at a distance of Δ resolution cells or more, as a power ratio: what a line may still
/// add to a bin that far away. The main lobe is bounded by the parabola (in dB) that touches its peak, side lobes by
/// their envelope; a sampled window's are folded over at half the sample rate and lie up to 6 dB higher there.
double leakageBound(WindowShape shape, double distanceCells);

} // namespace faintline

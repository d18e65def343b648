#pragma once

#include "base/Axis.h"
#include "signal/Fft.h"

#include <complex>
#include <span>
#include <vector>

namespace faintline {

/// A linear filter that may change from block to block, with blocks of N samples at intervals of N/2:
///
///   s(n) = Σ_b w_b(n)·F⁻¹{ g_b(f)·F{ w_b x } }(n),   w_b(n) = sin(π(n - bN/2 + ½)/N)
///
/// w is a √Hann window with Σ_b w_b(n)² = 1, so that g = 1 leaves x unchanged. Thread-safe. Oracle: g = 1.
class BlockFilter
{
public:
    /// `length`: N, even.
    explicit BlockFilter(Index length);

    Index length() const { return std::ssize(m_window); }
    /// The first sample of a block.
    Index beginOf(Index block) const { return block * (length() / 2); }
    /// The first of the two blocks that contain sample n ≥ 0.
    Index firstBlockOf(Index sample) const { return sample / (length() / 2) - 1; }

    /// Replaces a block's x by its contribution w F⁻¹{ g F{ w x } }. `gains`: g/N of each bin, from 0 Hz upward, then
    /// the negative frequencies.
    void apply(std::span<std::complex<float>> block, std::span<const float> gains) const;

private:
    std::vector<float> m_window;
    Fft m_fft;
};

} // namespace faintline

#pragma once

#include "noise/NoiseBackground.h"
#include "signal/BlockFilter.h"
#include "signal/Recording.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace faintline {

/// Noise that resembles a recording's, without signals: white noise shaped by the recording's estimated background,
///
///   s(n) = Σ_b w_b(n)·F⁻¹{ √B(t_b, f)·F{ w_b x } }(n),   Σ_b w_b(n)² = 1
///
/// with blocks b as long as the spectrogram's window (BlockFilter) and x white noise of unit variance. It has the
/// recording's length, rate, channel type and quantisation step, and is digitally silent where the recording is.
/// Oracle: its own estimated background is the recording's. Thread-safe; samples are a pure function of (recording,
/// background, seed, index).
class SurrogateRecording final : public DerivedRecording
{
public:
    /// `windowSamples`: of the spectrogram, as of its background, which is that of the channel.
    SurrogateRecording(RecordingPointer recording, int channel, int windowSamples,
                       std::shared_ptr<const NoiseBackground> background, std::uint64_t seed);

    void read(int channel, Index first, Index count, std::span<float> out) const override;

private:
    void fillWhite(Index block, std::span<std::complex<float>> samples) const;
    std::vector<float> gainsAt(double seconds) const;
    void addBlock(Index block, Index first, std::span<float> out) const;
    void silence(Index first, std::span<float> out) const;

    int m_baseChannel;
    std::shared_ptr<const NoiseBackground> m_background;
    std::uint64_t m_seed;
    BlockFilter m_filter;
    double m_step = 0.0; ///< quantisation step; 0: none
};

} // namespace faintline

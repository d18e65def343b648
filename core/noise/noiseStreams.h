#pragma once

#include "frames/Spectrogram.h"

#include <memory>
#include <span>
#include <vector>

namespace faintline {

class Random;

/// A sequence of noise frames whose future depends only on `state()` and the random numbers to come.
class NoiseStream
{
public:
    virtual ~NoiseStream() = default;
    virtual Index cells() const = 0;
    /// The next frame, y with mean 1.
    virtual void next(Random &random, std::span<float> y) = 0;
    virtual std::vector<float> state() const { return {}; }
    virtual void setState(std::span<const float> /*state*/) {}
};

/// Independent exponential cells.
std::unique_ptr<NoiseStream> independentNoise(Index cells);

/// The spectrogram of complex white noise on `windowSamples` samples, full band: neighbouring frames and bins are
/// correlated as in a recording. The background is known, not estimated.
std::unique_ptr<NoiseStream> spectralNoise(const SpectrogramSettings &settings, int windowSamples);

} // namespace faintline

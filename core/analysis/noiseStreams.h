#pragma once

#include "spectrum/Spectrogram.h"

#include <memory>
#include <span>
#include <vector>

namespace faintline {

class Random;

/// Frames of noise, one after the other, whose future depends on nothing but `state()` and the random numbers to come.
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

/// The spectrogram of complex white noise on `windowSamples` samples, a full band: neighbouring frames and bins are
/// correlated as those of a recording are. The background is known, not estimated.
std::unique_ptr<NoiseStream> spectralNoise(const SpectrogramSettings &settings, int windowSamples);

} // namespace faintline

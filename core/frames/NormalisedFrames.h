#pragma once

#include "base/Grid.h"
#include "base/RunContext.h"
#include "frames/Window.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace faintline {

class Spectrogram;

/// How a line fills frames: their overlap, the bins of a resolution cell, and the leakage beyond it.
struct FrameGeometry {
    double framesPerWindow = 1.0; ///< k_t
    double binsPerCell = 1.0;     ///< k_f
    /// Frames of a block that precede the first frame, for detectors that decide in blocks.
    Index blockPhase = 0;
    WindowShape window = WindowShape::Hann;
    double windowSeconds = 0.0; ///< T_FT
    int windowSamples = 0;      ///< the same in samples; 0: frames that are no spectra of a recording
    int hopSamples = 0;         ///< from frame to frame
    Index firstSample = 0;      ///< of the recording, in the first frame
    bool hasRealEnds = false;   ///< Spectrogram::hasRealEnds

    bool isOfSpectra() const { return windowSamples > 0; }
    double likeness() const; ///< cells that count as one (cellLikeness); 1 for frames that are no spectra
    double overlap() const;  ///< factor on the variance of means over many frames, overlapFactor²; 1 for those
    /// The samples of the recording in a frame: from beginOf to endOf - 1.
    Index beginOf(Index frame) const { return firstSample + frame * hopSamples; }
    Index endOf(Index frame) const { return beginOf(frame) + windowSamples; }
};

/// Frames whose noise has mean 1 in every cell: the only input of a detector.
///
/// A frame holds one value y ≥ 0 per cell of `grid`, power over noise power, or NaN if not observed. Frames are read by
/// index, in any order, from any thread. A spectrogram must be normalised first.
class NormalisedFrames
{
public:
    virtual ~NormalisedFrames() = default;

    const Axis &time() const { return m_time; }
    const Grid &grid() const { return m_grid; }

    /// Writes frames first … first+count-1, count × grid().size() values, row by row.
    virtual void read(Index first, Index count, std::span<float> out) const = 0;

    /// The spectrogram from which the frames were made; null for ready-made frames.
    virtual const Spectrogram *spectrogram() const { return nullptr; }

    /// Whether a frame was observed; always of ready-made frames.
    virtual bool isObserved(Index frame) const;
    /// Reads the power itself, before the noise was divided out, in the unit of its background. Precondition: frames of
    /// a spectrogram.
    void readPower(Index first, Index count, std::span<float> out, const RunContext &context = {}) const;

    /// The spectrogram's geometry. Ready-made frames are taken as independent, with one bin a resolution cell and the
    /// leakage of a Hann window.
    FrameGeometry geometry() const;

    /// What was assumed about the numbers of a file, in one sentence; empty if nothing was. Guessed: the file did not
    /// say it, and neither did the settings.
    virtual std::string assumption() const { return {}; }
    virtual bool isGuessed() const { return false; }

protected:
    NormalisedFrames(Axis time, Grid grid) : m_time(std::move(time)), m_grid(std::move(grid)) {}

    Axis m_time;
    Grid m_grid;
};

using NormalisedFramesPointer = std::shared_ptr<const NormalisedFrames>;

/// Ready-made normalised frames held in memory: simulated pings, arrays from files, tests.
class FrameArray final : public NormalisedFrames
{
public:
    /// `values`: time.count × grid.size(), row by row.
    FrameArray(Axis time, Grid grid, std::vector<float> values)
        : NormalisedFrames(std::move(time), std::move(grid)), m_values(std::move(values))
    {
    }

    void read(Index first, Index count, std::span<float> out) const override;

private:
    std::vector<float> m_values;
};

} // namespace faintline

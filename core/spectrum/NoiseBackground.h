#pragma once

#include "base/Axis.h"
#include "base/Field.h"
#include "base/RunContext.h"
#include "spectrum/NoiseStretch.h"
#include "spectrum/Spectrogram.h"

#include <memory>
#include <span>
#include <vector>

namespace faintline {

/// How the noise under the lines is estimated.
struct NormaliserSettings {
    int halfWidthCells = 20;    ///< half the frequency window, in resolution cells
    double blockWindows = 48.0; ///< length of one time block, in T_FT
    bool followLevel = true; ///< divide out broad-band level changes shorter than a block (bursts, gain steps, clicks)
    bool causal = false;     ///< from the past alone (CausalSpectrogram)

    static const std::vector<Field<NormaliserSettings>> &fields();
    bool operator==(const NormaliserSettings &) const = default;
};

/// The coarse background of a recording: mean noise power per time block and resolution cell.
///
/// Per block and cell: the median over the block's non-overlapping frames (frames of digital silence left out, frames
/// much louder or softer than most brought to their level), freed of its bias for exponential data. Blocks are averaged
/// with their neighbours in time as far as the noise keeps its spectral shape, independent of its level. Then a running
/// median over ±halfWidth cells, continued beyond the band edges by point reflection of the logarithm, which follows
/// any slope; then the mean ratio of the unsuspicious cells to that median within the same window, which removes the
/// median's bias and variance. A line, however long, is narrower than the window, so it never becomes its own
/// background; a burst, however broad, is shorter than half a block. Between block centres and between cells the
/// logarithm is interpolated. What changes faster than a block is a level over the background, of each of the
/// detector's frames: the whole band's, a mean over its cells of noise cut off at five times itself, and what each
/// sub-band of about 96 cells has besides, both as far as they are beyond their own scatter (`beyondScatter`): a steady
/// level is averaged over some two hundred frames, a step is kept as it is. Where sub-bands go ways of their own, a
/// stretch of a dozen blocks is taken for a sum of a few sources (`NoiseSources`) whose levels are those of each frame,
/// if that leaves less of a deviation from 1 than the one background.
struct NoiseBackground {
    Axis time;      ///< block centres, s
    Axis frequency; ///< cells, Hz
    /// time.count × frequency.count, natural logarithm of mean noise power, in the spectrogram's unit.
    std::vector<float> lnPower;
    double lnUnit = 0.0;        ///< ln of that unit, in squares of the samples' own (Spectrogram::scaleExponent)
    Axis levelTime;             ///< of the detector's frames, up to four a window; s
    Index bandCount = 0;        ///< sub-bands of equal width; 0 where the band is too narrow to tell
    std::vector<float> lnLevel; ///< levelTime.count × bandCount, to be added to lnPower
    /// In the order of time: instead of lnPower, where it is several noises in turn.
    std::vector<NoiseStretch> stretches{};
    Axis bins{}; ///< of the detector's frames, Hz
    std::vector<float>
        lnAtEdges; ///< of each of those bins, to be added to what is interpolated; empty: nothing is steep

    /// ln power that stands for "nothing was recorded".
    static constexpr float silence = -200.0f;

    /// ln of the mean noise power at one time and frequency, without levels, in squares of the samples' unit.
    double lnPowerAt(double seconds, double hz) const;
    /// The same of all cells at one time, with levels, in the spectrogram's unit: what a frame is divided by.
    void readLnPower(double seconds, std::span<float> ln) const;

    /// Sub-bands of about 96 cells; none where fewer than 48 could tell the level.
    static Index subBandCount(double cells);
};

/// How closely to look: a sketch takes no more than 64 frames of all, and one background for all time.
enum class BackgroundDepth { Whole, Sketch };

/// One pass over the recording at the detector's frames (at most four a window) and one bin per cell: a fraction 1/k_f
/// of the detector's own transforms, and less where blocks are long. Memory: at most 1024 blocks and 64 MiB, twice.
std::shared_ptr<const NoiseBackground> estimateBackground(const Spectrogram &spectrogram,
                                                          const NormaliserSettings &settings,
                                                          const RunContext &context = {},
                                                          BackgroundDepth depth = BackgroundDepth::Whole);

} // namespace faintline

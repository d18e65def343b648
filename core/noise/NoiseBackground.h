#pragma once

#include "base/Axis.h"
#include "base/Field.h"
#include "base/RunContext.h"
#include "frames/Spectrogram.h"

#include <memory>
#include <span>
#include <vector>

namespace faintline {

/// Noise as a sum of independent sources of constant colour and variable level, such as a receiver's own noise and
/// intermittent wind:
///
///   B(t, f) = Σ_k P_k(t)·a_k(f),  y(t, f)/B(t, f) exponential of mean 1
///
/// Fitted by maximum likelihood, which minimises the Itakura-Saito divergence, with multiplicative updates
///
///   P_k ← P_k·Σ_f a_k min(y, cB)/B² / Σ_f a_k/B,  and for a_k likewise over t.
///
/// A running median over ±half cells is applied to colours in each iteration, so that no line becomes part of a colour,
/// except near their steep edges, which it would move. Sources are initialised with the frames that differ most from
/// one another. Source: Févotte, Bertin and Durrieu 2009, Nonnegative matrix factorization with the Itakura-Saito
/// divergence, section 3.
struct NoiseSources {
    Index cells = 0;
    std::vector<float> colours; ///< sources × cells

    Index count() const { return cells > 0 ? std::ssize(colours) / cells : 0; }

    /// The sources' levels in a frame that is near 1 somewhere; all 0 in digital silence.
    std::vector<float> levelsIn(std::span<const float> frame) const;

    /// B of a frame from its source levels.
    void addUp(std::span<const float> levels, std::span<float> out) const;
};

/// Fits `count` sources to frames (frames × cells) whose cells are of similar magnitude where nothing changes.
NoiseSources fitSources(std::span<const float> frames, Index cells, Index count, Index half);

/// A stretch of time in which the noise changes its colour, as a sum of sources with levels in each frame.
struct NoiseStretch {
    Index firstLevel = 0;            ///< index into the background's level times
    NoiseSources sources;            ///< colours relative to `lnPower`
    std::vector<float> lnPower;      ///< of each cell
    std::vector<float> sourceLevels; ///< level times × sources
    float floor = 0.0f;              ///< ln power of rounding errors

    Index levelCount() const { return sources.count() > 0 ? std::ssize(sourceLevels) / sources.count() : 0; }
};

/// ln power of a stretch's noise in a frame with the given source levels.
void readStretch(const NoiseStretch &stretch, std::span<const float> levels, std::span<float> ln);

/// A stop band of the filter that a recording went through (stopBands.h). It is not observed, except from the past alone.
struct StopBand {
    double lowHz = 0.0;
    double highHz = 0.0;
    double natsBelow = 0.0; ///< the band beside it
};

/// How the noise background is estimated.
struct NormaliserSettings {
    int halfWidthCells = 20;    ///< half the frequency window, in resolution cells
    double blockWindows = 48.0; ///< length of one time block, in T_FT
    bool followLevel = true; ///< divide out broad-band level changes shorter than a block (bursts, gain steps, clicks)
    bool causal = false;     ///< from past data alone (CausalSpectrogram)
    bool blankDc = true;     ///< the middle of a filterbank's coarse channels is not observed

    static const std::vector<Field<NormaliserSettings>> &fields();
    bool operator==(const NormaliserSettings &) const = default;
};

/// The coarse background of a recording: mean noise power per time block and resolution cell.
///
/// Per block and cell, takes the median over the block's non-overlapping frames and removes its bias for exponential
/// data; frames of digital silence are excluded, and frames much louder or softer than most are first scaled to the
/// common level. Blocks are averaged with their neighbours in time as far as the noise keeps its spectral shape,
/// independent of its level. A running median over ±halfWidth cells follows, extended beyond the band edges by point
/// reflection of the logarithm, which follows any slope; it is corrected by the mean ratio to it of the unsuspicious
/// cells within the same window, which removes the median's bias and variance. A line of any length is narrower than
/// the window, so it never becomes its own background; a burst of any width is shorter than half a block. The logarithm
/// is interpolated between block centres and between cells.
///
/// Changes faster than a block are levels over the background, one set per frame of the detector: the level of the
/// whole band (a mean over its noise cells, truncated at five times itself), and the additional level of each sub-band
/// of about 96 cells, both as far as they exceed their own scatter (`beyondScatter`): a steady level is averaged over
/// some two hundred frames, a step is kept unchanged. Where sub-bands vary independently, a stretch of a dozen blocks
/// is modelled as a sum of a few sources (`NoiseSources`) whose levels are fitted to each frame, if that deviates less
/// from 1 than the single background.
struct NoiseBackground {
    Axis time;      ///< block centres, s
    Axis frequency; ///< cells, Hz
    /// time.count × frequency.count values: natural logarithm of mean noise power, in the spectrogram's unit.
    std::vector<float> lnPower;
    double lnUnit = 0.0;        ///< ln of that unit, in squares of the samples' own unit (Spectrogram::scaleExponent)
    Axis levelTime;             ///< s; frames of the detector, up to four per window
    Index bandCount = 0;        ///< sub-bands of equal width; 0 if the band is too narrow to estimate levels
    std::vector<float> lnLevel; ///< levelTime.count × bandCount values, to be added to lnPower
    /// In ascending time: stretches where several alternating noises replace lnPower.
    std::vector<NoiseStretch> stretches{};
    Axis bins{};                       ///< frames of the detector, Hz
    std::vector<float> lnAtEdges;      ///< correction of each bin after interpolation; empty: none
    std::vector<StopBand> stopBands{}; ///< of the whole band; none in one that was selected

    /// ln power that denotes "nothing was recorded".
    static constexpr float silence = -200.0f;

    /// ln of the mean noise power at a time and frequency, without levels, in squares of the samples' unit.
    double lnPowerAt(double seconds, double hz) const;
    /// ln power of all cells at a time, with levels, in the spectrogram's unit: the divisor of a frame.
    void readLnPower(double seconds, std::span<float> ln) const;

    /// Number of sub-bands of about 96 cells; 0 if fewer than 48 would estimate the level.
    static Index subBandCount(double cells);
};

/// Depth of the estimate; a sketch takes at most 64 frames and one background for all time.
enum class BackgroundDepth { Whole, Sketch };

/// Estimates the background in one pass over the detector's frames (at most four per window) with one bin per cell: a
/// fraction 1/k_f of the detector's own transforms, and less for long blocks. Memory: at most 1024 blocks and 64 MiB,
/// twice.
std::shared_ptr<const NoiseBackground> estimateBackground(const Spectrogram &spectrogram,
                                                          const NormaliserSettings &settings,
                                                          const RunContext &context = {},
                                                          BackgroundDepth depth = BackgroundDepth::Whole);

} // namespace faintline

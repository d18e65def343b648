#pragma once

#include "base/RunContext.h"
#include "frames/NormalisedFrames.h"
#include "plan/Analysis.h"
#include "recursion/PathStrip.h"
#include "track/Track.h"

#include <span>
#include <vector>

namespace faintline {

/// Frames of a recording in runs of successive ones, without cells that may hold a signal.
///
/// At most four million cells, in runs of `runFrames` frames at even intervals. Cells within four resolution cells of a
/// track, two frames before and after each of its points and ten before and after the track are NaN, and so are cells
/// without power.
class NoiseSample
{
public:
    static constexpr Index runFrames = 32;

    /// Throws Cancelled.
    NoiseSample(const NormalisedFrames &frames, std::span<const Track> tracks, double binsPerCell,
                const RunContext &context);

    Index rows() const { return m_rows; }
    Index cells() const { return m_cells; }
    float at(Index row, Index cell) const { return m_y[std::size_t(row * m_cells + cell)]; }

    /// Values of a bin, in any order; empty if their median exceeds that of noise, because the bin holds a steady line,
    /// or if too few are known.
    std::vector<float> noiseIn(Index cell) const;

private:
    void mask(const TrackPoint &point, Index before, Index behind, Index half);
    void mask(const Track &track, Index half);

    Index m_cells;
    Index m_distance; ///< frames between the beginnings of runs, ≥ runFrames
    Index m_rows = 0;
    std::vector<float> m_y;
};

/// Deviation of a recording's noise, away from its tracks (NoiseSample), from the noise that detectors assume.
///
/// Rare powers:     g(y) = min( y, -ln P(Y > y) )
/// Runs of power:   V(n) = var(mean of n successive cells) · n / var(cell) / o
///
/// Detectors assume exponential noise: a fraction e^-y of its cells exceeds y. Clicks, fading, compression and
/// reverberation lift more cells beyond high levels. g(y) is the power that is as rare on exponential noise as y is on
/// this noise. Detectors also assume that cells of successive frames are independent, apart from the overlap o of
/// windows; if levels rise and fall over some frames, means over n of them have a variance V(n) times as large.
///
/// Both are measured in up to 16 parts of the band. P: at the values that 1/2, 1/4, 1/8 … of the cells exceed, down to
/// 60 cells; beyond, P continues with the slope of its last three octaves. V: from powers up to 5, over 2, 4 … 32
/// frames. A part whose quantiles lie within 3 %, or V within 5 %, and three standard deviations of the assumption
/// keeps g(y) = y, or V = 1. So do recordings of under 64 frames.
class OwnNoiseLaw
{
public:
    static constexpr Index fewestFrames = 64; ///< with which the noise can be measured: two of the longest runs

    /// `overlap`: o, overlapFactor² of the frames' windows. Throws Cancelled.
    OwnNoiseLaw(const NormalisedFrames &frames, std::span<const Track> tracks, double binsPerCell, double overlap,
                const RunContext &context);

    /// Whether g(y) = y and V = 1 everywhere.
    bool isAsAssumed() const;

    /// g(y) in a cell of a frame; NaN stays.
    float operator()(Index cell, float y) const;

    /// V(n) at a cell, n ≥ 1; over more than 32 frames that of 32.
    double runs(Index cell, Index n) const;

private:
    /// g at quantiles of y; empty where g(y) = y.
    struct Part {
        std::vector<float> y;
        std::vector<float> g;
        float slope = 1.0f;       ///< beyond the last one
        std::vector<double> runs; ///< V(1), V(2), V(4) …; empty if it is 1
    };

    static void setPowers(Part &part, std::vector<float> values);
    static void setRuns(Part &part, const NoiseSample &sample, const std::vector<Index> &cells, double overlap);
    const Part &partAt(Index cell) const;

    Index m_cells;
    std::vector<Part> m_parts;
};

/// The law of an analysis's frames, apart from these tracks.
OwnNoiseLaw ownNoiseLaw(const AnalysisPlan &analysis, std::span<const Track> tracks, const RunContext &context);

/// Fraction of the evidence along a strip's path that remains under the noise's own law: Λ(ḡ)/Λ(ȳ)/V̄(n) below.
double evidenceLeft(const PathStrip &strip, const OwnNoiseLaw &law);

/// Moves tracks that the recording's own noise explains (OwnNoiseLaw) from `tracks` to `explainedByNoise`.
///
/// A track is kept if its statistic D, without the share of its evidence that this noise explains, reaches the
/// threshold T:
///
///   D · Λ(ḡ)/Λ(ȳ) / V̄(n) ≥ T,   Λ(a) = n (a - 1 - ln a)
///
/// ȳ, ḡ, V̄: means of y, g(y) and V(n) over the track's n points. Λ is the log-likelihood ratio of exponential cells of
/// an unknown mean a > 1 to noise, and V(n) cells in a run count as one. A path through many small excesses keeps its
/// share, because there g(y) ≈ y; one that depends on a few high cells, or on a run of raised cells, of a kind that
/// this noise has everywhere, loses it. If the noise is as assumed, all tracks are kept.
///
/// Numbers are not changed. Nothing is done if tracks have no second pass (secondLook.h), for families, which have
/// their own members beside them, and over a causal background, where the law of the whole is not known in time. Throws
/// Cancelled.
void holdAgainstOwnNoise(Analysis &analysis, const RunContext &context);

} // namespace faintline

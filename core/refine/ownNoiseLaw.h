#pragma once

#include "refine/noiseSample.h"

#include <span>
#include <vector>

namespace faintline {

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
/// keeps g(y) = y, or V = 1. So do recordings of under 64 frames, two of the longest runs.
class OwnNoiseLaw
{
public:
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

} // namespace faintline

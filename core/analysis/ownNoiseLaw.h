#pragma once

#include "analysis/noiseSample.h"

#include <span>
#include <vector>

namespace faintline {

/// How the noise of a recording differs from that which detectors assume, away from its tracks (NoiseSample).
///
/// Rare powers:     g(y) = min( y, -ln P(Y > y) )
/// Runs of power:   V(n) = var(mean of n successive cells) · n / var(cell) / o
///
/// Detectors take noise for exponential: e^-y of its cells exceed y. Clicks, fading, compression and reverberation lift
/// more of them beyond high levels. g(y) is the power that is as rare on exponential noise as y is on this one. They
/// take cells of successive frames for independent, but for the overlap o of windows, too; where levels rise and fall
/// over some frames, means over n of them scatter V(n) times as much.
///
/// Both are counted in up to 16 parts of the band. P: where 1/2, 1/4, 1/8 … of the cells exceed y, down to 60 cells;
/// beyond, the slope of the last three octaves of P goes on. V: of powers up to 5, over 2, 4 … 32 frames. A part whose
/// quantiles lie within 3 %, or V within 5 %, and three standard deviations of what is assumed keeps g(y) = y, or
/// V = 1. So does everything under 128 frames: too few to tell a keyed line by them.
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

    /// V(n) about a cell, n ≥ 1; over more than 32 frames that of 32.
    double runs(Index cell, Index n) const;

private:
    /// g at quantiles of y; empty where g(y) = y.
    struct Part {
        std::vector<float> y;
        std::vector<float> g;
        float slope = 1.0f;       ///< beyond the last one
        std::vector<double> runs; ///< V(1), V(2), V(4) …; empty where it is 1
    };

    static void setPowers(Part &part, std::vector<float> values);
    static void setRuns(Part &part, const NoiseSample &sample, const std::vector<Index> &cells, double overlap);
    const Part &partAt(Index cell) const;

    Index m_cells;
    std::vector<Part> m_parts;
};

} // namespace faintline

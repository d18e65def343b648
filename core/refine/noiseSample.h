#pragma once

#include "base/RunContext.h"
#include "frames/NormalisedFrames.h"
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

} // namespace faintline

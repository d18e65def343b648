#pragma once

#include "base/Axis.h"
#include "noise/bandLevels.h"

#include <span>
#include <vector>

namespace faintline {

/// Significant level changes of noise over its background, frame by frame, from past data alone.
///
/// A frame has levels of `bands` sub-bands and one common level of the whole band (levelsOf in bandLevels.h), in ln
/// power. The significant level of a sub-band is what the common level shows beyond its scatter plus what the sub-band
/// adds to that (latestBeyondScatter), minus the offset that lines cause (LevelOffsets). Levels before the first frame
/// are 0.
class CausalLevels
{
public:
    /// Standard errors of a frame's common level and of a sub-band's level.
    CausalLevels(Index bands, double commonScatter, double bandScatter);

    /// Adds the next frame's levels, bands + 1 values; levelNotKnown marks digital silence, which keeps the previous
    /// level.
    void push(std::span<const float> levels);

    /// Lowers the background to which all levels refer, by bands + 1 values.
    void moveBy(std::span<const double> rise);

    /// Subtracts offsets from now on: the sure ones, and for other sub-bands the part that lines may cause.
    void setOffsets(const LevelOffsets &offsets);

    /// Levels of the newest frame, `bands` values.
    std::vector<float> latest() const;

    std::size_t bytes() const { return m_levels.capacity() * sizeof(float); }

private:
    Index rows() const { return std::ssize(m_levels) / m_columns; }
    void readSeries(Index column, std::vector<float> &series) const;

    Index m_columns;
    double m_commonScatter;
    double m_bandScatter;
    std::vector<float> m_levels; ///< rows × columns, newest last; interpolated over silence
    std::vector<float> m_offsets;
};

} // namespace faintline

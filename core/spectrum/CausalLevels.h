#pragma once

#include "base/Axis.h"
#include "spectrum/bandLevels.h"

#include <span>
#include <vector>

namespace faintline {

/// Levels of noise over its background, frame by frame and from the past alone: what of the newest frame's counts.
///
/// A frame has `bands` sub-bands' levels and the common one of the whole band (levelsOf in bandLevels.h), in ln power.
/// What counts of a sub-band is what the common level does beyond its scatter, and what the sub-band does besides
/// (latestBeyondScatter), less what lines raise it by (LevelOffsets). Before the first frame all levels were 0.
class CausalLevels
{
public:
    /// Standard errors of one frame's common level and of a sub-band's.
    CausalLevels(Index bands, double commonScatter, double bandScatter);

    /// The next frame's levels, bands + 1 values; levelNotKnown in digital silence, which keeps the level before it.
    void push(std::span<const float> levels);

    /// The background that all levels are over has become lower by as much, bands + 1 values.
    void moveBy(std::span<const double> rise);

    /// Takes offsets off from now on: the sure ones, else of sub-bands what lines may make.
    void setOffsets(const LevelOffsets &offsets);

    /// Of the newest frame, `bands` values.
    std::vector<float> latest() const;

    std::size_t bytes() const { return m_levels.capacity() * sizeof(float); }

private:
    Index rows() const { return std::ssize(m_levels) / m_columns; }
    void readSeries(Index column, std::vector<float> &series) const;

    Index m_columns;
    double m_commonScatter;
    double m_bandScatter;
    std::vector<float> m_levels; ///< rows × columns, the newest last; bridged over silence
    std::vector<float> m_offsets;
};

} // namespace faintline

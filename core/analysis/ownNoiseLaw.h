#pragma once

#include "base/RunContext.h"
#include "spectrum/NormalisedFrames.h"
#include "track/Track.h"

#include <span>
#include <vector>

namespace faintline {

/// The law that a recording's own noise follows, in units of the law that detectors assume.
///
///   g(y) = min( y, -ln P(Y > y) )
///
/// Detectors take noise for exponential: e^-y of its cells exceed y. Clicks, fading, compression and reverberation lift
/// more of them beyond high levels. g(y) is the power that is as rare on exponential noise as y is on this one.
///
/// P is counted in up to 16 parts of the band, where 1/2, 1/4, 1/8 … of the cells exceed y, down to 60 cells; beyond,
/// the slope of the last three octaves of P goes on. A part whose quantiles lie within 3 % and three standard
/// deviations of the exponential ones keeps g(y) = y. Cells within four resolution cells of a track, two frames before
/// and after each of its points and ten before and behind the track do not count; neither do bins whose median over
/// time exceeds that of noise, which hold a steady line. Under 128 frames g(y) = y: too few to tell a keyed line by
/// them.
class OwnNoiseLaw
{
public:
    /// Reads at most four million cells, evenly spread in time. Throws Cancelled.
    OwnNoiseLaw(const NormalisedFrames &frames, std::span<const Track> tracks, double binsPerCell,
                const RunContext &context);

    /// Whether g(y) = y everywhere.
    bool isExponential() const;

    /// g(y) in a cell of a frame; NaN stays.
    float operator()(Index cell, float y) const;

private:
    /// g at quantiles of y. Empty: g(y) = y.
    struct Part {
        std::vector<float> y;
        std::vector<float> g;
        float slope = 1.0f; ///< beyond the last one
    };

    static Part partOf(std::vector<float> values);

    Index m_cells;
    std::vector<Part> m_parts;
};

} // namespace faintline

#pragma once

#include "base/Grid.h"

#include <functional>
#include <span>
#include <vector>

namespace faintline {

/// A signal along its track, and what it puts into the cells beside it.
struct ExplainedSignal {
    Index firstFrame = 0;
    std::vector<double> positions; ///< one per frame, cells
    std::vector<float> levels;     ///< A, its power over the noise's
    /// Measured beside it, in blocks of `skirtFrames`: share of A that lies 0, 1, … cells away; empty: no more than the
    /// window's leakage.
    std::vector<std::vector<float>> skirts;

    static constexpr Index skirtFrames = 24;

    Index endFrame() const { return firstFrame + Index(positions.size()); } ///< one behind the last
};

/// The floor that explained signals raise under weaker ones:
///
///   floor(t, n) = Π 1 + 2·A_t·max(|W(n - f_t)|², e(|n - f_t|))
///
/// The factor 2 lets an explanation be 3 dB short before what is left of the signal gathers evidence: explained power
/// is constant, not exponential. One frame more at either end, for windows overlap.
class Explanations
{
public:
    /// `leakage`: |W|² at a distance in cells of an axis with `cells` cells.
    Explanations(Index cells, const std::function<double(double)> &leakage);

    void add(ExplainedSignal signal);

    /// The floor of cells firstCell … in a frame.
    void read(Index frame, Index firstCell, std::span<float> floor) const;

private:
    /// A signal in a piece of time, with all cells that it may raise there.
    struct Entry {
        std::size_t signal;
        double lowest;
        double highest;
    };

    double leakageAt(double distance) const;
    double reachAt(const ExplainedSignal &signal, std::size_t at) const;
    std::span<const float> skirtAt(const ExplainedSignal &signal, std::size_t at) const;

    std::vector<ExplainedSignal> m_signals;
    std::vector<std::vector<Entry>> m_byTime; ///< of each piece of 64 frames
    std::vector<float> m_leakage;             ///< at multiples of 1/16 cell
};

} // namespace faintline

#pragma once

#include "base/Grid.h"
#include "plan/Analysis.h"

#include <functional>
#include <span>
#include <vector>

namespace faintline {

/// A signal along its track, and its contribution to neighbouring cells.
struct ExplainedSignal {
    Index firstFrame = 0;
    std::vector<double> positions; ///< one per frame, cells
    std::vector<float> levels;     ///< A, signal power over the noise's
    /// Measured in blocks of `skirtFrames`: fraction of A at a distance of 0, 1, … cells; empty: only the window's
    /// leakage.
    std::vector<std::vector<float>> skirts;
    double hides = -1.0; ///< distance within which nothing else can be seen, cells; negative: nothing is hidden

    static constexpr Index skirtFrames = 24;

    Index endFrame() const { return firstFrame + Index(positions.size()); } ///< one past the last
};

/// The floor that explained signals raise for weaker ones:
///
///   floor(t, n) = Π 1 + 2·A_t·max(|W(n - f_t)|², e(|n - f_t|))
///
/// W is the window's transform beside a signal whose skirts were measured and which moves by a tenth of a cell per
/// frame at most; beside others, which may be wider than the window's main lobe, it is an upper bound. The factor 2
/// allows an explanation to be 3 dB too low before the remainder of the signal gathers evidence: explained power is
/// constant, not exponential. One frame is added at either end, because windows overlap.
class Explanations
{
public:
    /// `bound`, `exact`: |W|² at a distance in cells of an axis with `cells` cells.
    Explanations(Index cells, const std::function<double(double)> &bound, const std::function<double(double)> &exact);

    void add(ExplainedSignal signal);

    /// Reads the floor of cells firstCell … in a frame.
    void read(Index frame, Index firstCell, std::span<float> floor) const;

    /// Sets y to `value` in the cells firstCell … of a frame that signals hide.
    void hide(Index frame, Index firstCell, std::span<float> y, float value) const;

    /// A stretch of frames, of which signals raise the floor in some.
    struct RaisedStretch {
        Index first;
        Index last;
        Index raised; ///< frames

        bool operator==(const RaisedStretch &) const = default;
    };

    /// The stretches, in order, outside which no track lies of which at least half of the points are in frames where
    /// signals raise the floor. They may reach beyond all frames.
    std::vector<RaisedStretch> stretches() const;

private:
    /// A signal in a block of time, and the cells that it may raise there.
    struct Entry {
        std::size_t signal;
        double lowest;
        double highest;
    };

    /// Calls take(signal, point) for each signal that may raise one of `count` cells of a frame.
    template <class Take>
    void forEachAt(Index frame, Index firstCell, Index count, Take take) const;

    static bool isSharp(const ExplainedSignal &signal, std::size_t at);
    double reachAt(const ExplainedSignal &signal, std::size_t at) const;
    std::span<const float> skirtAt(const ExplainedSignal &signal, std::size_t at) const;

    std::vector<ExplainedSignal> m_signals;
    std::vector<std::vector<Entry>> m_byTime; ///< for each block of 64 frames
    std::vector<float> m_bound;               ///< at multiples of 1/16 cell
    std::vector<float> m_exact;               ///< at the same, at most the bound
};

/// Tracks of signals that stronger ones hide: a further run of the chain over the floor that explained signals raise.
///
/// The chain is that of the analysis, with the same threshold, on y/floor. Cells within the main lobe of an explained
/// signal are not known to hold nothing else: there λ = -(ln K + ln h(0)) - 0.05, so that a path that goes on behind a
/// stronger signal loses as much as in noise, and none gains. Only tracks that the first run could not find are
/// returned: at half of their points or more the floor is raised within a resolution cell, so that frames in which no
/// such track can lie are left out (Explanations::stretches). Because they are a second chance for noise, they also
/// have to be a hundred times rarer than ordered (AnalysisPlan::sureStatistic). Throws Cancelled.
std::vector<Track> searchBehind(const Analysis &analysis, const Explanations &explanations, const RunContext &context);

} // namespace faintline

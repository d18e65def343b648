#pragma once

#include <vector>

namespace faintline {

/// Rates at which a detector's statistic rises to levels that plain simulation would hardly ever reach.
///
/// A *cycle* begins when the largest D of a frame exceeds the first level and ends when it falls below the base, a
/// quantile of that maximum. The rate of cycles that reach level i is
///
///   rate(T₀)·Π p_i,   p_i the fraction of those that reached level i - 1
///
/// by multilevel splitting: each level restarts, with new noise, from states in which the previous one was reached. A
/// cycle that rises high is one event of the chain, so ratios of rates are those of events wherever these are rare.
/// Trials of a level share ancestors: the errors are those of four independent runs, or the binomial ones if larger.
/// They are large if single cells carry an excursion (exponential likelihood far above its K), but not with Rice's
/// likelihood.
/// Source: Kahn and Harris 1951; Au and Beck 2001. Oracles: Lindley's recursion in closed form for one slope;
/// importance sampling with planted lines (tests/calibrate/tst_rareRates).
struct RareRates {
    std::vector<double> levels;         ///< ascending, in the statistic's own unit
    std::vector<double> lnRates;        ///< ln of the rate of cycles per cell and frame that reach the level
    std::vector<double> relativeErrors; ///< standard error of each rate

    bool isEmpty() const { return levels.size() < 2; }
    /// Interpolated between levels, extrapolated with the last slope beyond the last one.
    double lnRateAt(double level) const;
    double relativeErrorAt(double level) const;

    bool operator==(const RareRates &) const = default;
};

} // namespace faintline

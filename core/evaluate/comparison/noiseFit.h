#pragma once

#include "analysis/AnalysisSettings.h"
#include "base/RunContext.h"
#include "spectrum/NormalisedFrames.h"

#include <cstdint>
#include <span>
#include <vector>

namespace faintline {

/// How the normalised noise of one band is distributed, beside the law that every threshold rests on:
///
///   P(y > t) = e^{-t},   mean 1
///
/// Values are counted in steps of 2⁻¹⁰ up to 32, so a band of any length costs the same memory and the distance is
/// known to 10⁻³.
class NoiseLaw
{
public:
    NoiseLaw();

    void add(std::span<const float> y);
    void add(const NoiseLaw &other);

    std::int64_t count() const { return m_count; }
    double mean() const { return m_count > 0 ? m_sum / double(m_count) : 0.0; }

    /// P(y > t), the share of the values counted.
    double exceedance(double t) const;

    /// The t with P(y > t) = probability, linear within a step.
    double quantile(double probability) const;

    /// Kolmogorov and Smirnov's distance: sup |P(y > t) - e^{-t}|.
    double distance() const;

    /// The distance's 95 % limit for `independent` values of the law itself: 1.358/√n (Smirnov 1948).
    static double distanceLimit(double independent);

private:
    static constexpr int stepsPerUnit = 1024;
    static constexpr int largest = 32;

    std::vector<std::int64_t> m_counts; ///< per step; the last counts all values above
    std::int64_t m_count = 0;
    double m_sum = 0.0;
};

/// One band's law, and what it does to false alarms.
struct FittedBand {
    double low = 0.0; ///< position on the frames' last axis, in its unit
    double high = 0.0;
    NoiseLaw law;
    double independent = 0.0; ///< values that overlap leaves independent: cells over k_t·k_f

    bool fits() const { return law.distance() <= NoiseLaw::distanceLimit(independent); }
};

/// Which of the frames' values are looked at.
struct NoiseSample {
    int bands = 1;                   ///< of equal width
    std::int64_t cells = 20'000'000; ///< about so many at most, in frames spread evenly
    /// Cells at either end of the axis that are kept from the detector, too (where a real recording's spectrum overlaps
    /// with its mirror image).
    Index leftOut = 0;
};

/// Counts frames' values band by band. `geometry`: how far overlap makes neighbours dependent. Throws Cancelled.
std::vector<FittedBand> fitNoise(const NormalisedFrames &frames, const NoiseSample &sample,
                                 const FrameGeometry &geometry = {}, const RunContext &context = {});

/// Of one detector's statistic at a threshold, per cell: as the exponential law has it, and as a band's own law has it.
struct MisfitPfa {
    double nominal = 0.0;
    double actual = 0.0;

    double ratio() const { return nominal > 0.0 ? actual / nominal : 1.0; }
};

/// What the bands' misfits do to a false-alarm probability per cell, band by band: the detector runs on independent
/// cells drawn from the band's law, and on cells of the exponential law made of the same random numbers; the threshold
/// is the one that gives `pfa` on the latter, with K found there. Beyond 3·10⁻⁵ the exceedance continues with the slope
/// of its last decade and a half, as the statistic's exponential tail does. Overlap's correlation is left out of both.
/// Oracle: the energy detector, whose exceedance is the law's own. Cost: 1.6·10⁶ cells a band. Throws Error, Cancelled.
std::vector<MisfitPfa> misfitPfa(std::span<const FittedBand> bands, const AnalysisSettings &settings, double pfa,
                                 const RunContext &context = {});

} // namespace faintline

#pragma once

#include "base/RunContext.h"
#include "frames/NormalisedFrames.h"
#include "plan/AnalysisSettings.h"

#include <cstdint>
#include <span>
#include <vector>

namespace faintline {

/// Distribution of the normalised noise of one band, compared with the law on which all thresholds are based:
///
///   P(y > t) = e^{-t},   mean 1
///
/// Values are counted in steps of 2⁻¹⁰ up to 32, so a band of any length costs the same memory and the distance is
/// accurate to 10⁻³.
class NoiseLaw
{
public:
    NoiseLaw();

    void add(std::span<const float> y);
    void add(const NoiseLaw &other);

    std::int64_t count() const { return m_count; }
    double mean() const { return m_count > 0 ? m_sum / double(m_count) : 0.0; }

    /// P(y > t), the fraction of the counted values.
    double exceedance(double t) const;

    /// The t with P(y > t) = probability, linear within a step.
    double quantile(double probability) const;

    /// Kolmogorov-Smirnov distance: sup |P(y > t) - e^{-t}|.
    double distance() const;

    /// The 95 % limit of the distance for `independent` values of the law itself: 1.358/√n (Smirnov 1948).
    static double distanceLimit(double independent);

private:
    static constexpr int stepsPerUnit = 1024;
    static constexpr int largest = 32;

    std::vector<std::int64_t> m_counts; ///< per step; the last counts all values above
    std::int64_t m_count = 0;
    double m_sum = 0.0;
};

/// One band's law, and its effect on false alarms.
struct FittedBand {
    double low = 0.0; ///< position on the frames' last axis, in its unit
    double high = 0.0;
    NoiseLaw law;
    double independent = 0.0; ///< equivalent number of independent values: cells over k_t·k_f

    bool fits() const { return law.distance() <= NoiseLaw::distanceLimit(independent); }
};

/// Selection of the frames' values to examine.
struct NoiseSample {
    int bands = 1;                   ///< of equal width
    std::int64_t cells = 20'000'000; ///< approximate maximum, in evenly spread frames
    /// Cells at either end of the axis to omit, as the detector does where a real recording's spectrum overlaps its
    /// mirror image.
    Index leftOut = 0;
};

/// Counts frames' values band by band. `geometry`: overlap that makes neighbours dependent. Throws Cancelled.
std::vector<FittedBand> fitNoise(const NormalisedFrames &frames, const NoiseSample &sample,
                                 const FrameGeometry &geometry = {}, const RunContext &context = {});

/// False-alarm probabilities per cell of a detector at a threshold: under the exponential law, and under a band's own
/// law.
struct MisfitPfa {
    double nominal = 0.0;
    double actual = 0.0;

    double ratio() const { return nominal > 0.0 ? actual / nominal : 1.0; }
};

/// Effect of the bands' misfits on a false-alarm probability per cell, band by band: the detector runs on independent
/// cells drawn from the band's law, and on cells of the exponential law made from the same random numbers; the
/// threshold is the one that gives `pfa` on the latter, with K determined there. Beyond 3·10⁻⁵ the exceedance is
/// extrapolated with the slope of its last decade and a half, as the statistic's exponential tail. Correlation by
/// overlap is ignored in both. Oracle: the energy detector, whose exceedance is the law's own. Cost: 1.6·10⁶ cells per
/// band. Throws Error, Cancelled.
std::vector<MisfitPfa> misfitPfa(std::span<const FittedBand> bands, const AnalysisSettings &settings, double pfa,
                                 const RunContext &context = {});

} // namespace faintline

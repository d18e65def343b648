#pragma once

#include "spectrum/NoiseBackground.h"
#include "spectrum/NormalisedFrames.h"
#include "spectrum/PowerFrames.h"
#include "spectrum/Spectrogram.h"

#include <memory>
#include <vector>

namespace faintline {

/// Transforms power that is the mean of K looks at noise to the distribution of one look, for which detectors are
/// designed.
///
///   p/B ~ Gamma(K)/K,   y = -ln Q(K, K·p/B)
///
/// Q: regularised upper incomplete gamma function. y is exponential of mean 1 on noise and increases with p; K = 1
/// changes nothing. `median` is the measured median of p/B on noise; it replaces that of the gamma law and removes the
/// remaining bias of B. Uses a table over Wilson and Hilferty's cube root, |error| ≤ 1e-3 relative. Oracle: Boost.Math.
class LooksLaw
{
public:
    LooksLaw(double looks, double median);

    double looks() const { return m_looks; }
    float median() const { return m_median; }
    float operator()(float ratio) const;

    /// K and the median of noise whose 16, 50 and 84 % quantiles are the given values; 0.3 ≤ K ≤ 1e6.
    static LooksLaw fromQuantiles(double low, double middle, double high);

private:
    double m_looks;
    float m_median;
    float m_scale;  ///< scale of a ratio
    float m_centre; ///< centre of its cube root
    float m_spread;
    std::vector<float> m_table;
};

/// Power stored in a file over its noise: y(t, f), exponential of mean 1 on noise.
///
/// The background B is estimated like that of a recording (NoiseBackground): per block of at least `blockWindows`
/// frames the median over time of each cell, then the running median over ±halfWidth cells, then averages of blocks as
/// long as the noise keeps its colour. Frames whose level differs significantly from B are scaled to it. The number of
/// looks K is estimated from the values' spread. Values of few bits get a uniform random number below one step added, a
/// function of frame and cell, so that they have a median. Negative power counts as 0; NaN stays not observed.
/// Construction reads at most 2²⁸ values. Memory: 64 MiB for B. Thread-safe; frames are a pure function of (file, part,
/// settings, index).
class NormalisedPower final : public NormalisedFrames
{
public:
    /// Throws Error naming the file if most of a part's cells hold no power, and Cancelled.
    NormalisedPower(std::shared_ptr<const PowerFrames> power, const PowerPart &part,
                    const NormaliserSettings &settings = {}, const RunContext &context = {});

    void read(Index first, Index count, std::span<float> out) const override;

    const PowerFrames &power() const { return *m_power; }
    const PowerPart &part() const { return m_part; }
    double looks() const { return m_law.looks(); }

private:
    std::vector<float> readPower(Index first, Index count) const;
    void divide(Index frame, std::span<float> values, std::vector<float> &scratch) const;

    std::shared_ptr<const PowerFrames> m_power;
    PowerPart m_part;
    NoiseBackground m_background;
    LooksLaw m_law;
};

/// The part of a file that a selection specifies: channel, time and band, the whole band if low = high. Throws Error if
/// it is empty.
PowerPart partOf(const PowerInfo &info, const SelectionSettings &selection);

} // namespace faintline

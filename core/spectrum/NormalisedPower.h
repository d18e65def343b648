#pragma once

#include "spectrum/NoiseBackground.h"
#include "spectrum/NormalisedFrames.h"
#include "spectrum/PowerFrames.h"
#include "spectrum/Spectrogram.h"

#include <memory>
#include <vector>

namespace faintline {

/// The law of power that is the mean of K looks at noise, brought to the law of one look, which detectors are made for.
///
///   p/B ~ Gamma(K)/K,   y = -ln Q(K, K·p/B)
///
/// Q: regularised upper incomplete gamma function. y is exponential of mean 1 on noise, and grows with p; K = 1 changes
/// nothing. `median`: p/B's on noise, in place of the gamma law's, which takes out what is left of B's bias. From a
/// table over Wilson and Hilferty's cube root, |error| ≤ 1e-3 relative. Oracle: Boost.Math.
class LooksLaw
{
public:
    LooksLaw(double looks, double median);

    double looks() const { return m_looks; }
    float median() const { return m_median; }
    float operator()(float ratio) const;

    /// K and the median of noise of which 16, 50 and 84 % lie below these values; 0.3 ≤ K ≤ 1e6.
    static LooksLaw fromQuantiles(double low, double middle, double high);

private:
    double m_looks;
    float m_median;
    float m_scale;  ///< of a ratio
    float m_centre; ///< of its cube root
    float m_spread;
    std::vector<float> m_table;
};

/// Power that a file holds, over its noise: y(t, f), exponential of mean 1 on noise.
///
/// The background B is found as a recording's is (NoiseBackground): per block of at least `blockWindows` frames the
/// median over time of every cell, then the running median over ±halfWidth cells, then averages of blocks as long as
/// the noise keeps its colour. Frames whose level differs from B's by more than chance are brought to it. The number of
/// looks K comes from the values' own spread. Values of few bits get a uniform number below one step added, a function
/// of frame and cell, so that they have a median. Negative power counts as 0; NaN stays not observed. Cost of making
/// one: a reading of at most 2²⁸ values. Memory: 64 MiB for B. Thread-safe; frames are a pure function of (file, part,
/// settings, index).
class NormalisedPower final : public NormalisedFrames
{
public:
    /// Throws Error naming the file where most of a part's cells hold no power, and Cancelled.
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

/// The part of a file that a selection names: channel, time and band, the whole where low = high. Throws Error where it
/// is empty.
PowerPart partOf(const PowerInfo &info, const SelectionSettings &selection);

} // namespace faintline

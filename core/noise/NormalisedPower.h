#pragma once

#include "frames/LooksLaw.h"
#include "frames/NormalisedFrames.h"
#include "frames/Spectrogram.h"
#include "noise/NoiseBackground.h"
#include "signal/PowerFrames.h"

#include <memory>
#include <vector>

namespace faintline {

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

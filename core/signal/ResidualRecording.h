#pragma once

#include "base/RunContext.h"
#include "signal/LineFit.h"

namespace faintline {

/// A recording minus strong lines of one of its channels. Each line is fitted in amplitude and phase (LineFit) and
/// subtracted, the strongest first, to reveal weaker signals nearby. Other channels are unchanged.
///
/// A fit P also removes the noise within half a cell of its line. With noise w like the recording's own
/// (SurrogateRecording), the difference from it is fitted instead, x - P(x - w): the noise remains white, without a
/// notch that would lower the background nearby. Thread-safe; samples are a pure function of (recording, paths, noise,
/// index).
class ResidualRecording final : public Recording
{
public:
    /// `paths`: in order of decreasing strength; `noise`: as long as the recording, one channel; null: none. Reads the
    /// samples along each path. Throws Cancelled.
    ResidualRecording(RecordingPointer base, int channel, std::vector<LinePath> paths, const Recording *noise = nullptr,
                      const RunContext &context = {});

    const std::vector<LineFit> &lines() const { return m_lines; }

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    int scaleExponent(int channel) const override { return m_base->scaleExponent(channel); }
    bool isWhole(Index first, Index count) const override { return m_base->isWhole(first, count); }
    bool isFinite(int channel, Index first, Index count) const override
    {
        return m_base->isFinite(channel, first, count);
    }

private:
    RecordingPointer m_base;
    int m_channel;
    std::vector<LineFit> m_lines;
};

} // namespace faintline

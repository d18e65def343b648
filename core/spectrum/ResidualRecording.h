#pragma once

#include "base/RunContext.h"
#include "spectrum/LineFit.h"

namespace faintline {

/// A recording less strong lines of one of its channels: each is fitted with its amplitude and phase (LineFit) and
/// subtracted, the strongest first, so that what lies beside it is heard. Other channels stay as they are.
///
/// A fit P takes the noise within half a cell of its line, too. With noise w like the recording's own
/// (SurrogateRecording) what is fitted is the difference from that, x - P(x - w): the noise is white where it was,
/// without a hole, which the background beside it would be lower for. Thread-safe; samples are a pure function of
/// (recording, paths, noise, index).
class ResidualRecording final : public Recording
{
public:
    /// `paths`: by falling strength; `noise`: as long as the recording, of one channel; null for none. Reads the
    /// samples along each path. Throws Cancelled.
    ResidualRecording(RecordingPointer base, int channel, std::vector<LinePath> paths, const Recording *noise = nullptr,
                      const RunContext &context = {});

    const std::vector<LineFit> &lines() const { return m_lines; }

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    int scaleExponent(int channel) const override { return m_base->scaleExponent(channel); }
    bool isWhole(Index first, Index count) const override { return m_base->isWhole(first, count); }

private:
    RecordingPointer m_base;
    int m_channel;
    std::vector<LineFit> m_lines;
};

} // namespace faintline

#pragma once

#include "recording/Tone.h"

namespace faintline {

/// A line of known amplitude; its snrDb and referenceSeconds only go into the truth.
struct InjectedLine {
    LineSettings line;
    double amplitude = 0.0;
};

/// Checks lines that are to be added to a recording one after the other, in a list of that name: they are laid one over
/// the other, each with what it tells of itself. Throws Error naming the line.
void checkInjections(const std::vector<InjectedLine> &lines, const RecordingInfo &recording, const std::string &name);

/// A recording with known lines added to one of its channels. How strong a line must be for a wanted SNR in this noise
/// is the caller's to say (toneAmplitude). Thread-safe.
class InjectedRecording final : public Recording
{
public:
    /// Throws Error where checkLine does.
    InjectedRecording(RecordingPointer base, const std::vector<InjectedLine> &lines, int channel, std::uint64_t seed);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    int scaleExponent(int channel) const override { return m_base->scaleExponent(channel); }
    bool isWhole(Index first, Index count) const override { return m_base->isWhole(first, count); }

    Truth truth() const;

private:
    RecordingPointer m_base;
    int m_channel;
    std::vector<Tone> m_tones;
};

} // namespace faintline

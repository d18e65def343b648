#pragma once

#include "scene/Tone.h"

namespace faintline {

/// A line of known amplitude; its snrDb and referenceSeconds are only copied to the truth.
struct InjectedLine {
    LineSettings line;
    double amplitude = 0.0;

    bool operator==(const InjectedLine &) const = default;
};

/// Checks the list `name` of at most 1000 lines to add to a recording; injections are stacked, and each keeps its own
/// description. Throws Error naming the line.
void checkInjections(const std::vector<InjectedLine> &lines, const RecordingInfo &recording, const std::string &name);

/// A recording with known lines added to one channel. The caller computes the amplitude for a wanted SNR in this noise
/// (toneAmplitude). Thread-safe.
class InjectedRecording final : public DerivedRecording
{
public:
    /// Throws Error as checkLine does.
    InjectedRecording(RecordingPointer base, const std::vector<InjectedLine> &lines, int channel, std::uint64_t seed);

    void read(int channel, Index first, Index count, std::span<float> out) const override;

    Truth truth() const;

private:
    int m_channel;
    std::vector<Tone> m_tones;
};

} // namespace faintline

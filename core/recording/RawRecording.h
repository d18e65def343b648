#pragma once

#include "recording/FileBytes.h"
#include "recording/Recording.h"
#include "recording/SampleType.h"

namespace faintline {

/// What has to be known of a file of bare samples. Channels are interleaved.
struct RawLayout {
    SampleType type;
    double sampleRateHz = 0.0;
    int channelCount = 1;
    Index headerBytes = 0;   ///< before the first sample
    Index trailingBytes = 0; ///< after the last one
};

/// The layout with channels 2k and 2k+1 taken as I and Q of channel k: the same bytes under another name. A complex
/// layout stays as it is. Throws Error where channels are left over.
RawLayout withIqPairs(const std::string &path, RawLayout layout);

/// A file of bare samples, I/Q or real, read by random access for any size.
///
/// A last sample that is cut in the middle is left out, with a note. Thread-safe.
class RawRecording : public Recording
{
public:
    /// Throws Error where the file cannot be opened, the layout is impossible, or it holds no sample.
    RawRecording(const std::string &path, const RawLayout &layout);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    int scaleExponent(int channel) const override
    {
        return m_layout.type.number == SampleType::Number::Float ? measuredScaleExponent(channel) : 0;
    }

protected:
    /// Samples of the file from one on, all of which are there.
    void readFile(int channel, Index first, std::span<float> out) const;

private:
    FileBytes m_file;
    RawLayout m_layout;
    Index m_frameBytes = 0; ///< one sample of every channel
};

/// The type that a file's extension stands for by custom (".cf32", ".cs16", ".cu8" …); empty where it stands for raw
/// samples of an unknown type (".iq", ".raw", ".bin" …).
/// Nothing where the extension is not one of raw samples.
std::optional<std::string> rawTypeOfExtension(const std::string &path);

} // namespace faintline

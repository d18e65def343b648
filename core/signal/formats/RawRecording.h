#pragma once

#include "signal/FileBytes.h"
#include "signal/Recording.h"
#include "signal/formats/SampleType.h"

namespace faintline {

/// Layout of a file of raw samples. Channels are interleaved.
struct RawLayout {
    SampleType type;
    double sampleRateHz = 0.0;
    int channelCount = 1;
    Index headerBytes = 0;   ///< before the first sample
    Index trailingBytes = 0; ///< after the last one
};

/// The same layout with channels 2k and 2k+1 as I and Q of channel k. A complex layout is returned unchanged. Throws
/// Error if the number of channels is odd.
RawLayout withIqPairs(const std::string &path, RawLayout layout);

/// A file of raw samples, I/Q or real, of any size, with random access.
///
/// A truncated last sample is omitted, with a note. Thread-safe.
class RawRecording : public Recording
{
public:
    /// Throws Error if the file cannot be opened, the layout is invalid, or it holds no sample.
    RawRecording(const std::string &path, const RawLayout &layout);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    bool isFinite(int channel, Index first, Index count) const override
    {
        return m_layout.type.number != SampleType::Number::Float || isFiniteByReading(channel, first, count);
    }
    int scaleExponent(int channel) const override
    {
        return m_layout.type.number == SampleType::Number::Float ? measuredScaleExponent(channel) : 0;
    }

protected:
    /// Reads samples of the file from `first` on. Precondition: all of them exist.
    void readFile(int channel, Index first, std::span<float> out) const;

private:
    FileBytes m_file;
    RawLayout m_layout;
    Index m_frameBytes = 0; ///< one sample of every channel
};

/// Sample type that a file's extension conventionally denotes (".cf32", ".cs16", ".cu8" …). Empty if it denotes raw
/// samples of an unknown type (".iq", ".raw", ".bin" …); nothing if it is not an extension of raw samples.
std::optional<std::string> rawTypeOfExtension(const std::string &path);

} // namespace faintline

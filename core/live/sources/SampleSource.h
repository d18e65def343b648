#pragma once

#include "signal/formats/SampleType.h"

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace faintline {

/// Format of a stream. Channels are interleaved.
struct StreamFormat {
    SampleType type;
    double sampleRateHz = 0.0;
    int channelCount = 1;
    double centreHz = 0.0; ///< absolute frequency of 0 Hz in the samples
    std::string origin;    ///< "pipe, WAV", "rtl_tcp localhost:1234" …

    Index frameBytes() const { return type.sampleBytes() * channelCount; } ///< one sample of every channel
};

/// Data received from a source since the last call.
struct Heard {
    enum class Incident { None, Lost, Gone, Back };

    std::vector<std::byte> bytes;       ///< whole samples of all channels
    Index lostSamples = 0;              ///< missing before these samples
    Incident incident = Incident::None; ///< to be reported
    std::string words;                  ///< what happened, one sentence
    bool isOver = false;                ///< end of the stream
};

/// A source of live samples: a pipe, a socket, a receiver. Not thread-safe.
class SampleSource
{
public:
    virtual ~SampleSource() = default;

    virtual const StreamFormat &format() const = 0;

    /// Returns the samples received, possibly none, after at most `patience`. An interruption is not an error: it is
    /// reported, and on return the number of samples missed. Throws Error if the source cannot be used at all.
    virtual Heard hear(std::chrono::milliseconds patience) = 0;

    /// Whether the source waits to be read, as a pipe does; a receiver loses samples instead.
    virtual bool isPatient() const { return false; }
};

} // namespace faintline

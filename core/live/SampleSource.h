#pragma once

#include "recording/SampleType.h"

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace faintline {

/// What samples come as. Channels are interleaved.
struct StreamFormat {
    SampleType type;
    double sampleRateHz = 0.0;
    int channelCount = 1;
    double centreHz = 0.0; ///< frequency that 0 Hz of the samples stands for
    std::string origin;    ///< "pipe, WAV", "rtl_tcp localhost:1234" …

    Index frameBytes() const { return type.sampleBytes() * channelCount; } ///< one sample of every channel
};

/// What was heard of a source since it was last asked.
struct Heard {
    enum class Incident { None, Lost, Gone, Back };

    std::vector<std::byte> bytes;       ///< whole samples of all channels
    Index lostSamples = 0;              ///< that are missing before these
    Incident incident = Incident::None; ///< worth telling
    std::string words;                  ///< what happened, one sentence
    bool isOver = false;                ///< nothing comes any more
};

/// Where samples come from while they are made: a pipe, a socket, a receiver. Used by one thread.
class SampleSource
{
public:
    virtual ~SampleSource() = default;

    virtual const StreamFormat &format() const = 0;

    /// What came, after at most `patience`; may be nothing. A source that goes away is no error: it says so, and what
    /// was missed when it is back. Throws Error where it cannot be used at all.
    virtual Heard hear(std::chrono::milliseconds patience) = 0;

    /// Whether it waits until it is heard, as a pipe does; a receiver's samples are lost instead.
    virtual bool isPatient() const { return false; }
};

} // namespace faintline

#pragma once

#include "recording/FileBytes.h"
#include "recording/Recording.h"
#include "recording/Stretches.h"

#include <vector>

namespace faintline {

/// A WAV file as KiwiSDR receivers write it: many short data chunks, each behind a "kiwi" chunk with the GNSS time of
/// its first sample.
///
///   "RIFF" size "WAVE",  "fmt " …,  then again and again
///   "kiwi" 10: age of the last fix (s, 255: none), 0, GPS second of the week, nanosecond
///   "data" n: 16-bit samples
///
/// Two channels are I and Q. The sample rate is that of the time stamps over the longest stretch without a gap, where
/// they tell one, for the header holds but whole hertz. Where stamps lie farther apart than the samples between them
/// last, samples are missing: they keep their place in time, read as 0, and isWhole tells. Stamps do not tell the week;
/// it is that of the time in the file's name (timeInName), which kiwirecorder writes. A file that was cut short is read
/// as far as it goes. Memory: of chunks of equal size none, however many. Source: kiwiclient, kiwirecorder.py.
/// Thread-safe.
class KiwiRecording final : public Recording
{
public:
    /// Throws Error where the chunks make no recording.
    explicit KiwiRecording(const std::string &path);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    bool isWhole(Index first, Index count) const override { return m_stretches.isWhole(first, count); }

    /// Whether a "kiwi" chunk follows the format of a WAV file.
    static bool recognises(const std::string &path);

private:
    /// Data chunks of one size, evenly spaced in the file.
    struct Run {
        Index firstSample;
        Index offset;  ///< of the first one's samples in the file
        Index samples; ///< of each chunk
        Index stride;  ///< from one to the next, bytes
        Index count;
    };

    void add(Index offset, Index samples);
    Index stored() const; ///< samples in all chunks
    void readStored(Index sample, std::span<float> out) const;
    void readWithin(const Run &run, Index sample, std::span<float> out) const;

    FileBytes m_file;
    Index m_bytesPerSample = 4; ///< of all channels
    std::vector<Run> m_runs;
    Stretches m_stretches; ///< of the stored samples in time
};

} // namespace faintline

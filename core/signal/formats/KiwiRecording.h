#pragma once

#include "signal/FileBytes.h"
#include "signal/Recording.h"
#include "signal/Stretches.h"

#include <vector>

namespace faintline {

/// A WAV file as written by KiwiSDR receivers: many short data chunks, each after a "kiwi" chunk with the GNSS time of
/// its first sample.
///
///   "RIFF" size "WAVE",  "fmt " …,  then repeatedly
///   "kiwi" 10: age of the last fix (s, 255: none), 0, GPS second of the week, nanosecond
///   "data" n: 16-bit samples
///
/// Two channels are I and Q. The sample rate is computed from the time stamps over the longest stretch without a gap,
/// if possible, because the header holds whole hertz only. Where stamps are farther apart than the samples between them
/// last, samples are missing: they keep their place in time and read as 0, and isWhole reports them. Stamps do not give
/// the week, which is taken from the time in the file's name (timeInName), as kiwirecorder writes it. A truncated file
/// is read as far as it goes. Chunks of equal size take no memory, however many there are. Source: kiwiclient,
/// kiwirecorder.py. Thread-safe.
class KiwiRecording final : public Recording
{
public:
    /// Throws Error if the chunks do not form a recording.
    explicit KiwiRecording(const std::string &path);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    bool isWhole(Index first, Index count) const override { return m_info.places.isWhole(first, count); }

    /// Whether a "kiwi" chunk follows the format chunk of a WAV file.
    static bool recognises(const std::string &path);

private:
    /// Data chunks of one size, evenly spaced in the file.
    struct ChunkRun {
        Index firstSample;
        Index offset;  ///< position in the file of the first chunk's samples
        Index samples; ///< of each chunk
        Index stride;  ///< between consecutive chunks, bytes
        Index count;
    };

    void add(Index offset, Index samples);
    Index stored() const; ///< samples in all chunks
    void readStored(Index sample, std::span<float> out) const;
    void readWithin(const ChunkRun &run, Index sample, std::span<float> out) const;

    FileBytes m_file;
    Index m_bytesPerSample = 4; ///< of all channels
    std::vector<ChunkRun> m_runs;
};

} // namespace faintline

#pragma once

#include "live/SampleSource.h"
#include "recording/FileBytes.h"
#include "recording/Recording.h"
#include "recording/Stretches.h"

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// Where a recorder has put the samples that it has written so far: in which files, and where in time. Thread-safe.
class WrittenSamples
{
public:
    WrittenSamples(StreamFormat format, double startUnixSeconds)
        : m_format(std::move(format)), m_startUnixSeconds(startUnixSeconds)
    {
    }

    // Of the recorder:
    void beginFile(std::string dataPath);
    /// So many samples, from one place in time on, are in the file.
    void add(Index inTime, Index count);

    const StreamFormat &format() const { return m_format; }
    double startUnixSeconds() const { return m_startUnixSeconds; }
    /// Behind the last sample, in time.
    Index end() const;
    /// One channel's samples as floats: 0 in gaps and where nothing is yet. Throws Error where a file fails.
    void read(int channel, Index first, std::span<float> out) const;
    /// Whether none of these samples, of those that are there, lies in a gap.
    bool isWhole(Index first, Index count) const;

private:
    struct File {
        std::string path;
        Index firstStored; ///< of all files' samples
    };
    struct Piece {
        Index stored;
        std::span<float> out;
    };

    void readStored(int channel, const Piece &piece) const;
    std::pair<std::shared_ptr<const FileBytes>, File> fileOf(Index stored, Index &count) const;

    StreamFormat m_format;
    double m_startUnixSeconds;
    mutable std::mutex m_mutex;
    Stretches m_stretches;
    Index m_stored = 0;
    std::vector<File> m_files;
    mutable std::shared_ptr<const FileBytes> m_open; ///< the one that was read last
};

/// A recording that is being written, read from its files: the window looks back at it, and plays it, meanwhile.
///
/// The same samples and gaps as the file has in the end, as far as they are written. Thread-safe.
class HeardRecording final : public Recording
{
public:
    /// So many samples of it, or, without a number, `endlessSamples`, of which those to come read as 0.
    explicit HeardRecording(std::shared_ptr<const WrittenSamples> written, std::optional<Index> samples = {});

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    bool isWhole(Index first, Index count) const override { return m_written->isWhole(first, count); }

private:
    std::shared_ptr<const WrittenSamples> m_written;
};

} // namespace faintline

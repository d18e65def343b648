#pragma once

#include "live/sources/SampleSource.h"
#include "signal/FileBytes.h"
#include "signal/Recording.h"
#include "signal/Stretches.h"

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// Maps the samples that a recorder has written so far to files and to positions in time. Thread-safe.
class WrittenSamples
{
public:
    WrittenSamples(StreamFormat format, double startUnixSeconds)
        : m_format(std::move(format)), m_startUnixSeconds(startUnixSeconds)
    {
    }

    // Called by the recorder:
    void beginFile(std::string dataPath);
    /// Adds `count` samples, written to the current file, that start at position `inTime`.
    void add(Index inTime, Index count);

    const StreamFormat &format() const { return m_format; }
    double startUnixSeconds() const { return m_startUnixSeconds; }
    /// Position in time after the last sample.
    Index end() const;
    /// One channel's samples as floats; 0 in gaps and where not yet written. Throws Error if reading fails.
    void read(int channel, Index first, std::span<float> out) const;
    /// Whether no sample in this range, as far as it is written, lies in a gap.
    bool isWhole(Index first, Index count) const;

private:
    struct File {
        std::string path;
        Index firstStored; ///< counted over all files
    };
    struct StoredPart {
        Index stored;
        std::span<float> out;
    };

    void readStored(int channel, const StoredPart &part) const;
    std::pair<std::shared_ptr<const FileBytes>, File> fileOf(Index stored, Index &count) const;

    StreamFormat m_format;
    double m_startUnixSeconds;
    mutable std::mutex m_mutex;
    Stretches m_stretches;
    Index m_stored = 0;
    std::vector<File> m_files;
    mutable std::shared_ptr<const FileBytes> m_open; ///< file read last
};

/// A recording that is still being written, read from its files so that the window can display and play it.
///
/// Has the same samples and gaps as the finished file, as far as written. Thread-safe.
class HeardRecording final : public Recording
{
public:
    /// Spans `samples` samples. By default it spans `endlessSamples`; samples not yet written read as 0.
    explicit HeardRecording(std::shared_ptr<const WrittenSamples> written, std::optional<Index> samples = {});

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    bool isWhole(Index first, Index count) const override { return m_written->isWhole(first, count); }

private:
    std::shared_ptr<const WrittenSamples> m_written;
};

} // namespace faintline

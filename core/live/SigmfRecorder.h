#pragma once

#include "live/HeardRecording.h"

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// When a recorder begins another file; 0: never.
struct RotationSettings {
    double largestBytes = 0.0;
    double longestSeconds = 0.0;
};

/// Writes what is heard to a SigMF recording while it is heard, so that a program that is killed leaves all that was
/// written.
///
/// The samples go to NAME.sigmf-data as they came, at once. NAME.sigmf-meta is there from the beginning and complete at
/// any time: its captures say where samples are missing, one entry for each stretch that was heard without a gap, with
/// core:sample_start (in the file), core:global_index (in time, gaps included) and core:datetime. Rotation begins
/// NAME-2, NAME-3 … at the next gap or delivery, and NAME.timeline lists them all. Reading it again, SigmfRecording puts the
/// gaps back where they were.
class SigmfRecorder
{
public:
    /// `path` ends in .sigmf-meta or .sigmf-data; neither may exist yet. Throws Error.
    SigmfRecorder(const std::string &path, const StreamFormat &format, const RotationSettings &rotation,
                  double startUnixSeconds);
    ~SigmfRecorder();
    SigmfRecorder(const SigmfRecorder &) = delete;
    SigmfRecorder &operator=(const SigmfRecorder &) = delete;

    /// Whole samples that come next. Throws Error where they cannot be written: what was written before is sound.
    void write(std::span<const std::byte> bytes);
    /// So many samples that were not heard.
    void skip(Index samples);

    /// How long the disk still takes what comes, s.
    double secondsLeft() const;

    const std::vector<std::string> &files() const { return m_files; } ///< the metadata of each
    /// What to open all of it by: the metadata, or of several files their list.
    std::string whole() const;
    /// The same while it is being written.
    std::shared_ptr<const WrittenSamples> written() const { return m_writtenSamples; }

private:
    struct Capture {
        Index sampleStart;
        Index globalIndex;
    };

    void begin();
    void rotateIfDue();
    void writeMeta() const;
    void writeList() const;
    void checkIsNew(const std::string &path) const;

    std::string m_stem;
    StreamFormat m_format;
    RotationSettings m_rotation;
    double m_startUnixSeconds;
    int m_descriptor = -1;
    Index m_position = 0;  ///< in time, of the next sample
    Index m_fileStart = 0; ///< position of the file's first sample
    Index m_written = 0;   ///< samples in the file
    bool m_isAfterGap = true;
    std::vector<Capture> m_captures;
    std::vector<std::string> m_files;
    std::shared_ptr<WrittenSamples> m_writtenSamples;
};

} // namespace faintline

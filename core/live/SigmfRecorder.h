#pragma once

#include "live/HeardRecording.h"

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// When a recorder starts a new file; 0: never.
struct RotationSettings {
    double largestBytes = 0.0;
    double longestSeconds = 0.0;
};

/// Writes a live stream to a SigMF recording. If the program is killed, everything written so far remains readable.
///
/// Samples are written unchanged and at once to NAME.sigmf-data. NAME.sigmf-meta exists from the start and is valid at
/// any time: its captures mark missing samples, with one entry per gapless stretch: core:sample_start (in the file),
/// core:global_index (in time, gaps included) and core:datetime. Rotation starts NAME-2, NAME-3 … at the next gap or
/// delivery; NAME.timeline lists all files. SigmfRecording restores the gaps on reading.
class SigmfRecorder
{
public:
    /// `path` ends in .sigmf-meta or .sigmf-data; neither file may exist. Throws Error.
    SigmfRecorder(const std::string &path, const StreamFormat &format, const RotationSettings &rotation,
                  double startUnixSeconds);
    ~SigmfRecorder();
    SigmfRecorder(const SigmfRecorder &) = delete;
    SigmfRecorder &operator=(const SigmfRecorder &) = delete;

    /// Appends whole samples. Throws Error if they cannot be written; samples written earlier remain valid.
    void write(std::span<const std::byte> bytes);
    /// Leaves a gap of `samples` samples.
    void skip(Index samples);

    /// Time until the disk is full, s.
    double secondsLeft() const;

    const std::vector<std::string> &files() const { return m_files; } ///< metadata of each file
    /// File that opens the whole recording: the metadata, or the list if there are several.
    std::string whole() const;
    /// The recording so far, readable during writing.
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
    Index m_position = 0;  ///< position in time of the next sample
    Index m_fileStart = 0; ///< position of the file's first sample
    Index m_written = 0;   ///< samples in the file
    bool m_isAfterGap = true;
    std::vector<Capture> m_captures;
    std::vector<std::string> m_files;
    std::shared_ptr<WrittenSamples> m_writtenSamples;
};

} // namespace faintline

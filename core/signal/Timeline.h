#pragma once

#include "base/Error.h"
#include "signal/Recording.h"
#include "signal/Stretches.h"
#include "signal/alignFiles.h"

#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace faintline {

/// Many files as one recording, such as a recorder's hourly files, in the order of their time stamps.
///
/// A file's stamp is the one it contains (RecordingInfo::startUnixSeconds), else the one in its name (timeInName).
/// alignFiles places the files on one timeline; time between files, or in a gap of one, was not observed (isWhole).
/// Files must agree in rate, channels, I/Q and centre frequency. Files that are empty or broken are left out, with a
/// note. Construction reads headers only; at most eight files
/// are open at a time. Thread-safe.
class Timeline final : public Recording
{
public:
    using OpenFile = std::function<RecordingPointer(const std::string &path)>;

    /// The recordings of `names`: files, folders, lists. `open` opens one file; it is called repeatedly and from any
    /// thread. Throws Error naming the offending file, also if no file can be opened.
    Timeline(const std::vector<std::string> &names, OpenFile open);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    bool isWhole(Index first, Index count) const override;
    bool isFinite(int channel, Index first, Index count) const override;
    int scaleExponent(int channel) const override;

    /// Whether a path denotes many files: a folder, or a list of names (.timeline).
    static bool isNamedSo(const std::string &path);

    /// The files that `names` denote, sorted by name: those of a folder with the extension of a recording, at any
    /// depth; those of a list, one name per line, relative to the list, with # for comments; other names unchanged.
    /// Throws Error if there are none.
    static std::vector<std::string> filesOf(const std::vector<std::string> &names);

private:
    struct TimelinePart {
        std::string path;
        PlacedFile place;
        Index firstStored = 0; ///< index among all parts' used samples
        Index fileSamples = 0;
        bool hasGaps = false;
        bool isFloat = false; ///< samples may not be finite
    };

    RecordingPointer openUnlessBroken(const std::string &path, std::vector<Error> &broken) const;
    TimedFile addPart(const std::string &path, const Recording &recording);
    void checkLike(const RecordingInfo &other) const;
    RecordingPointer partAt(std::size_t number) const;
    std::size_t partOf(Index stored) const;
    void readStored(int channel, Index stored, std::span<float> out) const;

    OpenFile m_openFile;
    std::vector<TimelinePart> m_parts; ///< in the order of time
    Stretches m_stretches;             ///< places of the used samples in time
    bool m_hasGapsWithin = false;
    mutable std::mutex m_mutex;
    mutable std::vector<std::pair<std::size_t, RecordingPointer>> m_open; ///< most recent last; guarded by m_mutex
};

/// All files from which recordings of these names are read: two for SigMF, many for a timeline. With `areRaw` all names
/// are read as raw samples.
std::vector<std::string> filesBehind(const std::vector<std::string> &names, bool areRaw = false);

} // namespace faintline

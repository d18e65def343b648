#pragma once

#include "base/Error.h"
#include "signal/Recording.h"
#include "signal/Stretches.h"

#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace faintline {

/// A file of a timeline: time stamp of its first sample and number of samples.
struct TimedFile {
    std::string path;
    double startUnixSeconds = 0.0;
    double rateHz = 0.0;
    Index samples = 0;
    bool isExact = false;     ///< samples and stamp share a clock: GNSS, or the file's own count
    bool hasFraction = false; ///< the stamp tells more than whole seconds, even where that is 0
};

/// Place of a file's samples in time.
struct PlacedFile {
    std::size_t file = 0; ///< index among the given files
    Index inTime = 0;     ///< place of the first used sample
    Index skipped = 0;    ///< samples at its beginning that the previous file already has
    Index count = 0;      ///< number of used samples
};

struct Alignment {
    double startUnixSeconds = 0.0;
    double rateHz = 0.0;
    std::vector<PlacedFile> places; ///< in the order of time
    std::vector<std::string> notes; ///< findings, one sentence each
};

/// Places files on one timeline by their time stamps; sample counts are exact, stamps are not.
///
/// Files follow on without a gap if their stamps lie about a straight line over the samples, at most 200 ppm (the
/// tolerance of crystals) from their rate, within the stamps' resolution: 1 s if all are whole seconds (and none tells a
/// fraction of 0), else 10 ms, or 0.1 ms if all are exact; and within up to 0.1 s more if they are late and early by
/// turns, as a program's delays make them. Of few whole seconds, a range that uniform numbers have in one case of 100 is
/// too large. Files that do not follow on have a gap between them or an overlap, as their stamps say, or as equal
/// intervals between them do.
///
/// Files that follow one another form a run. Over all runs the clock is a straight line,
///
///   t(n) = t0(run) + n/rate,
///
/// fitted by least squares; its rate replaces that of the files if it differs by more than five standard errors (of the
/// resolution/√12, 1 ms or the residuals, whichever is largest), at most by 200 ppm, and no files have pauses about as
/// short as the resolution, which look the same. A run begins at the mean of its stamps, each minus the samples before
/// it; gaps separate the runs. Where runs overlap, the earlier one is used.
///
/// Throws Error if rates differ by more than 200 ppm, a file lies within another, or a gap is longer than 400 days.
/// Precondition: at least one file.
Alignment alignFiles(const std::vector<TimedFile> &files);

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

#pragma once

#include "base/Axis.h"

#include <string>
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

} // namespace faintline

#pragma once

#include "base/Axis.h"

#include <string>
#include <vector>

namespace faintline {

/// A file of a timeline: when its first sample was taken, by its time stamp, and how many there are.
struct TimedFile {
    std::string path;
    double startUnixSeconds = 0.0;
    double rateHz = 0.0;
    Index samples = 0;
    bool isExact = false; ///< samples are counted by the same clock as the stamp: GNSS, or a file's own count
};

/// Where a file's samples lie in time.
struct PlacedFile {
    std::size_t file = 0; ///< its number among those given
    Index inTime = 0;     ///< place of the first sample that is used
    Index skipped = 0;    ///< samples at its beginning that the file before has already
    Index count = 0;      ///< samples that are used
};

struct Alignment {
    double startUnixSeconds = 0.0;
    double rateHz = 0.0;
    std::vector<PlacedFile> places; ///< in the order of time
    std::vector<std::string> notes; ///< what was found, one sentence each
};

/// Lays files on one timeline by their time stamps, for samples are counted exactly and stamps are not.
///
/// A file follows on without a gap where its stamp lies within the stamps' resolution (1 s where all are whole seconds,
/// else 10 ms) and 200 ppm of where the one before ends: crystals are that good. Where all stamps are exact, 0.1 ms
/// decide. Files that follow on one another are a run. Over all runs the clock is a straight line,
///
///   t(n) = t0(run) + n/rate,
///
/// fitted by least squares; its rate replaces that of the files where it differs by more than five standard errors (of
/// the resolution/√12, 1 ms or the residuals, whichever is largest). A run begins at the mean of its stamps, each less
/// the samples before it; between runs lie gaps. Where a run begins before the one before ends, what is there twice is
/// taken from the earlier one.
///
/// Throws Error where rates differ by more than 200 ppm, a file lies within another, or a gap is longer than 400 days.
/// Precondition: at least one file.
Alignment alignFiles(const std::vector<TimedFile> &files);

} // namespace faintline

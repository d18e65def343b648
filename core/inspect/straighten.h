#pragma once

#include "analyse/events.h"
#include "inspect/lineHeight.h"
#include "plan/Analysis.h"
#include "signal/FrequencyCurve.h"

#include <array>
#include <optional>
#include <string_view>

namespace faintline {

/// Method that makes a line's frequency constant.
enum class Straightening {
    Shift,   ///< shift the whole band with the line (StraightenedRecording)
    Resample ///< stretch time, which keeps all multiples constant too (ResampledRecording)
};
inline constexpr std::array<std::string_view, 2> straighteningNames{"shift", "resample"};

/// Parses a name. Throws Error.
Straightening straighteningOf(std::string_view name);

/// Resample if the analysis searched for harmonics of a fundamental, else Shift.
Straightening usualStraightening(const AnalysisPlan &plan);

struct StraightenChoice {
    double smoothingSeconds = 0.0;     ///< as in smoothFrequency
    std::optional<double> targetHz;    ///< default: the track's mean frequency
    std::optional<Straightening> kind; ///< default: as the analysis suggests
};

/// A recording straightened along an event's track, and the regions in which to examine the line before and after: over
/// the event's duration, in a band of twice the range that the line crosses, or 40 cells of its spectrum on either
/// side. The line is the family's first member for resampled harmonics, otherwise the fundamental.
struct Straightened {
    RecordingPointer recording; ///< the analysis's channel
    FrequencyCurve curve;       ///< the smoothed track
    double targetHz;            ///< its frequency after straightening
    Straightening kind;
    Stretch before; ///< in the analysis's recording
    Stretch after;  ///< in `recording`, around the target
};

/// Makes the line of an event constant. Throws Error if the analysis is of ready-made frames, and as smoothFrequency,
/// StraightenedRecording and ResampledRecording do.
Straightened straightened(const Analysis &analysis, const Event &event, const StraightenChoice &choice = {});

} // namespace faintline

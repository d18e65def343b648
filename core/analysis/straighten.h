#pragma once

#include "analysis/Analysis.h"
#include "analysis/events.h"
#include "analysis/lineHeight.h"
#include "spectrum/FrequencyCurve.h"

#include <array>
#include <optional>
#include <string_view>

namespace faintline {

/// How a line is made constant.
enum class Straightening {
    Shift,   ///< the whole band moves with it (StraightenedRecording)
    Resample ///< time is stretched with it, so that all its multiples stay as well (ResampledRecording)
};
inline constexpr std::array<std::string_view, 2> straighteningNames{"shift", "resample"};

/// Of a name. Throws Error.
Straightening straighteningOf(std::string_view name);

/// Resampling where the analysis looked for harmonics of a fundamental, else a shift.
Straightening usualStraightening(const AnalysisPlan &plan);

struct StraightenChoice {
    double smoothingSeconds = 0.0;     ///< as smoothFrequency has it
    std::optional<double> targetHz;    ///< by default the track's mean frequency
    std::optional<Straightening> kind; ///< by default the usual one
};

/// A recording straightened along an event's track, and where its line is looked at before and after: over the event's
/// duration, in a band of twice what the line crosses, or 40 of its spectrum's cells to either side. Of harmonics that
/// are resampled the line is the family's first member, of others the fundamental.
struct Straightened {
    RecordingPointer recording; ///< the analysis's channel
    FrequencyCurve curve;       ///< the track's, smooth
    double targetHz;            ///< where that is now
    Straightening kind;
    Stretch before; ///< in the analysis's recording
    Stretch after;  ///< in this one, around its target
};

/// Makes the line of one of an analysis's events constant. Throws Error where the analysis is of ready-made frames, and
/// as smoothFrequency, StraightenedRecording and ResampledRecording do.
Straightened straightened(const Analysis &analysis, const Event &event, const StraightenChoice &choice = {});

} // namespace faintline

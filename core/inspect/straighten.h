#pragma once

#include "analyse/events.h"
#include "base/RunContext.h"
#include "plan/Analysis.h"
#include "signal/FrequencyCurve.h"
#include "signal/Recording.h"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace faintline {

/// A time interval of one channel, and a band around a frequency.
struct TimeBand {
    int channel = 0;
    double fromSeconds = 0.0;
    double toSeconds = 0.0;
    double hz = 0.0;
    double halfBandHz = 0.0;
};

/// The highest line of a stretch.
struct LineHeight {
    double hz = 0.0;
    double db = 0.0; ///< above the median of the band; ∞ if that is silent
};

/// Spectrum of a stretch's band.
struct LineSpectrum {
    std::vector<double> hz;
    std::vector<double> db; ///< above the median of the band; ∞ or NaN if that is silent
};

/// The band in one Hann-windowed transform of the whole stretch; lineHeight gives its highest line.
LineSpectrum lineSpectrum(const Recording &recording, const TimeBand &stretch, const RunContext &context = {});

/// The highest line in the band, in one Hann-windowed transform of the whole stretch; resolution 1.5 over its duration.
///
/// The band is mixed down and decimated to as few samples as can represent it, at most 2²², so that hours are possible;
/// of a longer stretch its middle is used. Throws Error if it holds less than 16 samples, Cancelled.
LineHeight lineHeight(const Recording &recording, const TimeBand &stretch, const RunContext &context = {});

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
    bool operator==(const StraightenChoice &) const = default;
};

/// A recording straightened along an event's track, and the regions in which to examine the line before and after: over
/// the event's duration, in a band of twice the range that the line crosses, or 40 cells of its spectrum on either
/// side. The line is the family's first member for resampled harmonics, otherwise the fundamental.
struct Straightened {
    RecordingPointer recording; ///< the analysis's channel
    FrequencyCurve curve;       ///< the smoothed track
    double targetHz;            ///< its frequency after straightening
    Straightening kind;
    TimeBand before; ///< in the analysis's recording
    TimeBand after;  ///< in `recording`, around the target
};

/// Makes the line of an event constant. Throws Error if the analysis is of ready-made frames, and as smoothFrequency,
/// StraightenedRecording and ResampledRecording do.
Straightened straightened(const Analysis &analysis, const Event &event, const StraightenChoice &choice = {});

} // namespace faintline

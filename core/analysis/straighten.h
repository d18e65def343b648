#pragma once

#include "analysis/Analysis.h"
#include "analysis/events.h"
#include "analysis/lineHeight.h"
#include "spectrum/StraightenedRecording.h"

#include <memory>
#include <optional>

namespace faintline {

/// A recording straightened along an event's track, and where its line is looked at before and after: over the event's
/// duration, in a band of twice what the line crosses, or 40 of its spectrum's cells to either side.
struct Straightened {
    std::shared_ptr<const StraightenedRecording> recording;
    Stretch before; ///< in the analysis's recording
    Stretch after;  ///< in this one, around its target
};

/// Shifts the recording of an analysis so that the line of one of its events stays at `targetHz`, by default the
/// track's mean frequency. `smoothingSeconds` as smoothFrequency has it. Throws Error where the analysis is of
/// ready-made frames, and as smoothFrequency and StraightenedRecording do.
Straightened straightened(const Analysis &analysis, const Event &event, double smoothingSeconds = 0.0,
                          std::optional<double> targetHz = {});

} // namespace faintline

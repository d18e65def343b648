#pragma once

#include "plan/AnalysisSettings.h"

namespace faintline {

/// The settings to start from for frames on a grid: the defaults for spectra, the preset "sonar" for two axes, "radar"
/// for more.
AnalysisSettings firstSettings(const Grid &grid);

/// The settings to start from for a recording: the defaults, with their order of false alarms fitted.
AnalysisSettings firstSettings(const RecordingInfo &recording);

/// Settings whose order of false alarms is the default, one per hour, with one in the length of a recording that is
/// sampled more slowly than once a second: an hour of such a recording is hardly anything. Others are unchanged. Window,
/// command line, surveys (for each recording) and the Python module begin with it, before the settings that are asked
/// for by name; of those of a survey, the default order is not told from one that was asked for.
AnalysisSettings withFittedOrder(AnalysisSettings settings, const RecordingInfo &recording);

} // namespace faintline

#pragma once

#include "plan/AnalysisSettings.h"
#include "recording/Recording.h"

namespace faintline {

/// The settings to start from for frames on a grid: the defaults for spectra, the preset "sonar" for two axes, "radar"
/// for more.
AnalysisSettings firstSettings(const Grid &grid);

/// The settings to start from for a recording: the defaults, with their order of false alarms fitted.
AnalysisSettings firstSettings(const RecordingInfo &recording);

/// Settings whose order of false alarms is the default, one per hour, with one in the length of a recording that is
/// sampled more slowly than once a second: an hour of such a recording is hardly anything. Others are unchanged.
AnalysisSettings withFittedOrder(AnalysisSettings settings, const RecordingInfo &recording);

} // namespace faintline

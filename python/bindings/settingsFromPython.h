#pragma once

#include "plan/AnalysisSettings.h"
#include "signal/Recording.h"

#include <pybind11/pybind11.h>

#include <string>

namespace faintline::python {

/// Settings in the arguments of a call.
struct AskedSettings {
    pybind11::object preset;   ///< None or a name
    pybind11::object settings; ///< None or {"stage.name": value}
    pybind11::dict keywords;   ///< name=value, the setting's short name in snake case
};

/// Applies the preset (`otherwise` if none is given), then the dict, then the keywords, each value checked by the table
/// of settings; `detector.kind` is applied first, because it determines the detector's settings. Throws Error as the
/// command line does.
AnalysisSettings settingsFromPython(const AskedSettings &asked, const AnalysisSettings &otherwise);
/// The same for a recording, to which the preset's or default order of false alarms is fitted (withFittedOrder).
AnalysisSettings settingsFromPython(const AskedSettings &asked, const RecordingInfo &recording);

/// The full name of the only setting whose short name in snake case is `keyword`: "window_seconds" →
/// "spectrogram.windowSeconds". Throws Error if there is none, or more than one.
std::string settingOfKeyword(const std::string &keyword);

/// "windowSeconds" → "window_seconds".
std::string snakeCase(const std::string &name);

} // namespace faintline::python

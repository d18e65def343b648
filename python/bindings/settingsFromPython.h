#pragma once

#include "analysis/AnalysisSettings.h"

#include <pybind11/pybind11.h>

#include <string>

namespace faintline::python {

/// What a call says of the settings.
struct AskedSettings {
    pybind11::object preset;   ///< None or a name
    pybind11::object settings; ///< None or {"stage.name": value}
    pybind11::dict keywords;   ///< name=value, the setting's own name in snake case
};

/// The preset (of those who name none: `otherwise`), then the dict, then the keywords, each value checked by the table
/// of settings; of them `detector.kind` first, because it brings a detector's own settings. Throws Error as the command
/// line does.
AnalysisSettings settingsFromPython(const AskedSettings &asked, const AnalysisSettings &otherwise = {});

/// The full name of the only setting whose own name in snake case is `keyword`: "window_seconds" →
/// "spectrogram.windowSeconds". Throws Error where there is none, or more than one.
std::string settingOfKeyword(const std::string &keyword);

/// "windowSeconds" → "window_seconds".
std::string snakeCase(const std::string &name);

} // namespace faintline::python

#pragma once

#include "app/cli/PartOptions.h"
#include "base/json.h"
#include "signal/openRecording.h"

#include <QSize>

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// Options of `faintline render`.
struct RenderOptions {
    std::string source; ///< recording, scenario, session or experiment
    std::string out;    ///< PNG; with several views, their names are inserted before the extension
    std::vector<std::string> views{"window"};
    QSize size{1600, 1000};
    double scale = 1.0;            ///< device pixels per pixel: factor of the picture's size in pixels
    std::optional<double> seconds; ///< cursor position
    std::optional<double> hz;
    std::optional<double> range; ///< of pings
    std::optional<double> bearing;
    std::vector<double> position;  ///< of the cursor in pings or scans, on every axis; empty: as range and bearing say
    std::vector<std::string> axes; ///< names of the two shown, of frames on more than two
    bool isSliced = false;         ///< the other axes are cut at the cursor; otherwise their maxima are shown
    std::string layer = "statistic"; ///< of the output (outputLayerNames)
    bool isLayerOver = false;        ///< over the statistic
    std::string theme = "light";
    std::string preset;
    std::vector<std::string> settings;  ///< "name=value"
    std::string presetA;                ///< "compare" only: the preset of A
    std::vector<std::string> settingsA; ///< "compare" only: settings of A alone
    OpenOptions opening;
    std::optional<int> channel;
    PartOptions part;
    std::optional<int> step; ///< step of a lesson, counted from 1
    bool isFocused = true;   ///< the view has the keyboard focus and therefore a frame
};

/// Path of the picture of one view: its name precedes the extension if there is more than one view.
std::string pictureName(const RenderOptions &options, const std::string &view);

/// Options as they are stored in the picture next to the description of its source, and read back from there.
Json toJson(const RenderOptions &options, const std::string &view);
RenderOptions renderOptionsFromJson(const Json &json);

} // namespace faintline

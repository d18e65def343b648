#pragma once

#include "app/cli/PartOptions.h"
#include "base/json.h"
#include "recording/openRecording.h"

#include <QSize>

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// What `faintline render` is asked for.
struct RenderOptions {
    std::string source; ///< recording, scenario or session
    std::string out;    ///< PNG; with several views, their names go before the extension
    std::vector<std::string> views{"window"};
    QSize size{1600, 1000};
    double scale = 1.0;            ///< device pixels per pixel: the picture has so many times the size
    std::optional<double> seconds; ///< where the cursor goes
    std::optional<double> hz;
    std::optional<double> range; ///< of pings
    std::optional<double> bearing;
    std::string layer = "statistic"; ///< of the output (outputLayerNames)
    bool isLayerOver = false;        ///< over the statistic
    std::string theme = "light";
    std::string preset;
    std::vector<std::string> settings;  ///< "name=value"
    std::string presetA;                ///< of "compare": what A starts from
    std::vector<std::string> settingsA; ///< of "compare": those of A alone
    OpenOptions opening;
    std::optional<int> channel;
    PartOptions part;
    std::optional<int> step; ///< of a lesson, counted from 1
    bool isFocused = true;   ///< the keys are the view's, which has a frame then
};

/// Where the picture of one view goes: its name before the extension where there is more than one.
std::string pictureName(const RenderOptions &options, const std::string &view);

/// What a picture was asked for, as it stands in the picture beside what it was made from, and read from there again.
Json toJson(const RenderOptions &options, const std::string &view);
RenderOptions renderOptionsFromJson(const Json &json);

} // namespace faintline

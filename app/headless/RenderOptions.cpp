#include "app/headless/RenderOptions.h"

#include "app/base/filePath.h"
#include "base/wholeNumber.h"

#include <QFileInfo>

namespace faintline {

std::string pictureName(const RenderOptions &options, const std::string &view)
{
    if (options.views.size() == 1)
        return options.out;
    const QFileInfo out(pathText(options.out));
    return pathBytes(out.path() + QLatin1Char('/') + out.completeBaseName() + QLatin1Char('-')
                     + QString::fromStdString(view) + QLatin1Char('.') + out.suffix());
}

Json toJson(const RenderOptions &options, const std::string &view)
{
    Json json = {{"view", view}, {"size", {options.size.width(), options.size.height()}}, {"theme", options.theme}};
    const auto tell = [&json](const char *name, const auto &value) {
        if (value)
            json[name] = *value;
    };
    if (options.views.size() > 1) // one after the other in the same window, where automatic ranges may remember
        json["views"] = options.views;
    tell("time", options.seconds);
    tell("frequency", options.hz);
    tell("range", options.range);
    tell("bearing", options.bearing);
    tell("step", options.step);
    if (!options.position.empty())
        json["position"] = options.position;
    if (!options.axes.empty())
        json["axes"] = options.axes;
    if (options.isSliced)
        json["sliced"] = true;
    if (options.scale != 1.0)
        json["scale"] = options.scale;
    if (options.layer != "statistic")
        json["layer"] = options.layer;
    if (options.isLayerOver)
        json["overlay"] = true;
    if (!options.presetA.empty()) {
        json["presetA"] = options.presetA;
        json["set"] = options.settings; // A's as well, on top of its own preset
    }
    if (!options.settingsA.empty())
        json["setA"] = options.settingsA;
    return json;
}

RenderOptions renderOptionsFromJson(const Json &json)
{
    RenderOptions options;
    options.views = json.value("views", std::vector{json.at("view").get<std::string>()});
    options.size = {wholeNumber<int>(json.at("size").at(0), "render.size"),
                    wholeNumber<int>(json.at("size").at(1), "render.size")};
    options.theme = json.at("theme").get<std::string>();
    options.scale = json.value("scale", 1.0);
    const auto take = [&json](const char *name, std::optional<double> &value) {
        if (json.contains(name))
            value = json[name].get<double>();
    };
    take("time", options.seconds);
    take("frequency", options.hz);
    take("range", options.range);
    take("bearing", options.bearing);
    options.position = json.value("position", std::vector<double>());
    options.axes = json.value("axes", std::vector<std::string>());
    options.isSliced = json.value("sliced", false);
    options.layer = json.value("layer", options.layer);
    options.isLayerOver = json.value("overlay", false);
    options.isFocused = json.value("focused", true);
    options.presetA = json.value("presetA", std::string());
    options.settings = json.value("set", std::vector<std::string>());
    options.settingsA = json.value("setA", std::vector<std::string>());
    return options;
}

} // namespace faintline

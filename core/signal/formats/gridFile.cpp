#include "signal/formats/gridFile.h"

#include "base/json.h"
#include "signal/formats/jsonFields.h"

#include <array>

namespace faintline {

using namespace jsonFields;

namespace {

    /// What the numbers are, and how they are stored.
    void readMeaning(GridFile &file, const Json &json, const std::string &path)
    {
        constexpr std::array<std::string_view, 5> names{"normalised", "power", "magnitude", "decibels", "iq"};
        constexpr std::array<PingValues, 5> kinds{PingValues::Normalised, PingValues::Power, PingValues::Magnitude,
                                                  PingValues::Decibels, PingValues::Automatic};
        const std::size_t chosen = std::size_t(choice(json, path, "values", names, 0));
        file.isPower = names[chosen] == "power";
        file.isIq = names[chosen] == "iq";
        file.values = json.contains("values") ? kinds[chosen] : PingValues::Automatic;
        file.scale = number(json, path, "scale", 1.0);
        file.offset = number(json, path, "offset", 0.0);
        if (!(file.scale > 0.0))
            throw Error(path + ": scale", "must be above 0");
        const bool isScaled = file.scale != 1.0 || file.offset != 0.0;
        if (isScaled && !file.isIq && (file.values == PingValues::Automatic || file.values == PingValues::Normalised))
            throw Error(path + ": scale, offset", "require \"values\": power, magnitude, decibels or iq");
    }

    /// What is not for a spectrogram.
    void checkSpectrum(const GridFile &file, const std::string &path)
    {
        if (file.isIq || file.values == PingValues::Magnitude || file.values == PingValues::Decibels)
            throw Error(path + ": values", "must be normalised or power for frames on one axis");
        if (file.scale != 1.0 || file.offset != 0.0)
            throw Error(path + ": scale, offset", "require frames on several axes");
    }

} // namespace

GridFile readGridFile(const std::string &path, const std::vector<Index> &stackShape)
{
    const Json json = readJsonFile(path);
    checkKeys(json, path, {"axes", "time", "values", "scale", "offset"});
    GridFile file;
    readMeaning(file, json, path);
    std::vector<Index> shape = stackShape;
    if (file.isIq && (shape.size() < 3 || shape.back() != 2))
        throw Error(path + ": values", "\"iq\" requires frames whose last axis has two numbers, I and Q");
    if (file.isIq)
        shape.pop_back();
    if (!json.contains("axes") || !json["axes"].is_array() || json["axes"].size() + 1 != shape.size())
        throw Error(path,
                    "needs \"axes\", one for each of the frames' " + std::to_string(shape.size() - 1) + " cell axes");
    for (std::size_t i = 0; i < json["axes"].size(); ++i) {
        const Json &axis = json["axes"][i];
        const std::string where = path + ": axes[" + std::to_string(i) + "]";
        checkKeys(axis, where, {"name", "unit", "first", "step", "count", "cells", "cyclic"});
        const double count = number(axis, where, "count", number(axis, where, "cells", double(shape[i + 1])));
        if (count != double(shape[i + 1]))
            throw Error(where + ".count", "is " + formatNumber(count) + ", but the frames have "
                                              + std::to_string(shape[i + 1]) + " cells there");
        file.grid.axes.push_back({text(axis, where, "name", "axis " + std::to_string(i + 1)),
                                  text(axis, where, "unit", ""), number(axis, where, "first", 0.0),
                                  number(axis, where, "step", 1.0), shape[i + 1], flag(axis, where, "cyclic"),
                                  axis.contains("name")});
        if (!(file.grid.axes.back().step > 0.0))
            throw Error(where + ".step", "must be above 0");
    }
    if (file.grid.isSpectrum())
        checkSpectrum(file, path);
    file.time = {"time", "s", 0.0, 1.0, shape[0], false};
    if (json.contains("time")) {
        const std::string where = path + ": time";
        checkKeys(json["time"], where, {"first", "step", "name", "unit"});
        file.time.first = number(json["time"], where, "first", 0.0);
        file.time.step = number(json["time"], where, "step", 1.0);
        if (file.time.step <= 0.0)
            throw Error(where + ".step", "must be above 0");
    }
    return file;
}

std::string gridFileText(const GridFile &file)
{
    Json json;
    json["axes"] = Json::array();
    for (const Axis &axis : file.grid.axes) {
        Json one = {{"unit", axis.unit},
                    {"first", axis.first},
                    {"step", axis.step},
                    {"count", axis.count},
                    {"cyclic", axis.cyclic}};
        if (axis.isNamed)
            one["name"] = axis.name;
        json["axes"].push_back(std::move(one));
    }
    json["time"] = {{"first", file.time.first}, {"step", file.time.step}};
    if (file.isPower)
        json["values"] = "power";
    else if (file.values != PingValues::Automatic)
        json["values"] = std::string(pingValuesNames[std::size_t(file.values)]);
    return json.dump(2) + "\n";
}

GridFile plainGrid(const std::vector<Index> &shape)
{
    GridFile file;
    file.time = {"time", "s", 0.0, 1.0, shape[0], false};
    for (std::size_t i = 1; i < shape.size(); ++i)
        file.grid.axes.push_back(Axis::unnamed(i, shape[i]));
    return file;
}

} // namespace faintline

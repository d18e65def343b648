#include "scene/truthBeside.h"

#include "base/Error.h"

#include <algorithm>
#include <filesystem>

namespace faintline {

namespace {

    template <class T>
    T readBeside(const std::string &path, T (*fromJson)(const Json &))
    {
        const std::string file = truthPathOf(path);
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(file, ignored))
            return {};
        const Json json = readJsonFile(file);
        try {
            return fromJson(json);
        } catch (const Error &error) {
            throw error.in(file);
        }
    }

} // namespace

std::string truthPathOf(const std::string &path)
{
    return std::filesystem::path(path).replace_extension(".truth.json").string();
}

Truth truthBeside(const std::string &path)
{
    return readBeside(path, truthFromJson);
}

PingTruth pingTruthBeside(const std::string &path, const Grid &grid)
{
    if (!grid.isSurface())
        return {};
    PingTruth truth = readBeside(path, pingTruthFromJson);
    const auto isOutside = [&](double cell) { return cell >= double(grid.size()); };
    for (const TruthTarget &target : truth.targets)
        if (std::any_of(target.cell.begin(), target.cell.end(), isOutside))
            throw Error(truthPathOf(path), "has a target beyond the " + std::to_string(grid.size())
                                               + " cells of the pings; it belongs to pings on another grid");
    return truth;
}

} // namespace faintline

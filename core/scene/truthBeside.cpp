#include "scene/truthBeside.h"

#include "base/Error.h"
#include "base/files/fileName.h"
#include "signal/fileFormats.h"

#include <algorithm>

namespace faintline {

namespace {

    template <class T>
    T readBeside(const std::string &path, T (*fromJson)(const Json &))
    {
        const std::string file = truthPathOf(path);
        if (!isFile(file))
            return {};
        const Json json = readJsonFile(file);
        return inFile(file, [&] { return fromJson(json); });
    }

} // namespace

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

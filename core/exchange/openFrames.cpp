#include "exchange/openFrames.h"

#include "exchange/ModelFile.h"

#include <filesystem>

namespace faintline {

std::string gridPathOf(const std::string &stackPath)
{
    return stackPath.substr(0, stackPath.size() - 4) + ".grid.json";
}

NormalisedFramesPointer openFrames(const std::string &path)
{
    if (!path.ends_with(".npy"))
        return nullptr;
    const std::string grid = gridPathOf(path);
    std::error_code ignored;
    return readFrames(path, std::filesystem::exists(grid, ignored) ? grid : std::string());
}

} // namespace faintline

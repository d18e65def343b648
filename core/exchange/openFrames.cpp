#include "exchange/openFrames.h"

#include "base/fileName.h"
#include "exchange/Hdf5Filterbank.h"
#include "exchange/Hdf5Pings.h"
#include "exchange/ModelFile.h"
#include "exchange/NumPyPower.h"
#include "exchange/SigprocFile.h"
#include "exchange/openPings.h"
#include "spectrum/NormalisedPower.h"

namespace faintline {

namespace {

    bool isStack(const std::string &path)
    {
        return hasEnding(path, ".npy");
    }

} // namespace

std::string gridPathOf(const std::string &stackPath)
{
    return stackPath.substr(0, stackPath.rfind('.')) + ".grid.json";
}

bool holdsFrames(const std::string &path)
{
    return isStack(path)
           || (isFile(path)
               && (SigprocFile::recognises(path) || Hdf5Filterbank::recognises(path) || Hdf5Pings::recognises(path)));
}

std::shared_ptr<const PowerFrames> openPower(const std::string &path)
{
    if (isStack(path) && NumPyPower::recognises(path, gridPathOf(path)))
        return std::make_shared<NumPyPower>(path, gridPathOf(path));
    if (isFile(path) && SigprocFile::recognises(path))
        return std::make_shared<SigprocFile>(path);
    if (isFile(path) && Hdf5Filterbank::recognises(path))
        return std::make_shared<Hdf5Filterbank>(path);
    return nullptr;
}

NormalisedFramesPointer openFrames(const std::string &path, const FramesOptions &options, const RunContext &context)
{
    const std::string grid = isFile(gridPathOf(path)) ? gridPathOf(path) : std::string();
    if (auto pings = openPings(path, grid, options.pings, UnstatedPings::Guess, context))
        return pings;
    const std::shared_ptr<const PowerFrames> power = openPower(path);
    if (!power && isStack(path))
        return readFrames(path, grid);
    if (!power)
        return nullptr;
    return std::make_shared<NormalisedPower>(power, partOf(power->info(), options.selection), options.noise, context);
}

NormalisedFramesPointer openStack(const std::string &path, const std::string &gridPath, const PingNoiseSettings &pings,
                                  const RunContext &context)
{
    if (auto normalised = openPings(path, gridPath, pings, UnstatedPings::Normalised, context))
        return normalised;
    return readFrames(path, gridPath);
}

} // namespace faintline

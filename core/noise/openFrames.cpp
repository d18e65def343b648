#include "noise/openFrames.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/files/fileName.h"
#include "noise/NormalisedPower.h"
#include "noise/pings/openPings.h"
#include "signal/formats/NumPy.h"
#include "signal/formats/gridFile.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    template <class Real>
    void checkValues(std::span<Real> values, const std::string &where)
    {
        const auto bad = std::find_if(values.begin(), values.end(), [](auto y) { return y < 0 || std::isinf(y); });
        if (bad != values.end())
            throw Error(where, "holds " + formatNumber(double(*bad)) + " at position "
                                   + std::to_string(bad - values.begin())
                                   + "; normalised power must be finite and not negative, or NaN for unobserved cells");
    }

    template <class Array>
    void checkFrames(const Array &array, const std::string &path)
    {
        if (array.shape.size() < 2 || array.values.empty())
            throw Error(path, "must have the shape (frames, cells…) with at least one of each");
        checkValues(std::span(array.values), path);
    }

} // namespace

void checkFrameValues(std::span<const float> values, const std::string &where)
{
    checkValues(values, where);
}

DoubleFrames readDoubleFrames(const std::string &path)
{
    NumPyDoubles array = readNumPyDoubles(path);
    checkFrames(array, path);
    return {std::move(array.shape), std::move(array.values)};
}

NormalisedFramesPointer readFrames(const std::string &path, const std::string &gridPath)
{
    NumPyArray array = readNumPy(path);
    checkFrames(array, path);
    const GridFile file = gridPath.empty() ? plainGrid(array.shape) : readGridFile(gridPath, array.shape);
    return std::make_shared<FrameArray>(file.time, file.grid, std::move(array.values));
}

NormalisedFramesPointer openFrames(const std::string &path, const FramesOptions &options, const RunContext &context)
{
    const std::string grid = gridBeside(path);
    if (auto pings = openPings(path, grid, options.pings, UnstatedPings::Guess, context))
        return pings;
    const std::shared_ptr<const PowerFrames> power = openPower(path);
    if (!power && hasEnding(path, ".npy"))
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

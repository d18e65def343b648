#include "noise/openFrames.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/files/fileName.h"
#include "noise/NormalisedPower.h"
#include "noise/pings/NormalisedPings.h"
#include "noise/pings/guessPingValues.h"
#include "signal/fileFormats.h"
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

NormalisedFramesPointer openPings(const std::string &path, const std::string &gridPath,
                                  const PingNoiseSettings &settings, UnstatedPings unstated, const RunContext &context)
{
    const std::shared_ptr<const RawPings> pings = openRawPings(path, gridPath);
    if (!pings)
        return nullptr;
    const PingsInfo &info = pings->info();
    PingValues values = settings.values != PingValues::Automatic ? settings.values : info.stated;
    const bool isOpen = values == PingValues::Automatic && !info.isComplex;
    if (isOpen)
        values = unstated == UnstatedPings::Normalised && info.quantum == 0.0 ? PingValues::Normalised
                                                                              : guessPingValues(*pings);
    if (values != PingValues::Normalised)
        return std::make_shared<NormalisedPings>(pings, values, isOpen, settings, context);
    if (!hasEnding(path, ".npy") || info.quantum > 0.0 || info.isComplex)
        throw Error(path, "holds " + info.sampleType
                              + ", which cannot be taken as normalised; only .npy of float32 or float64 can");
    return nullptr;
}

} // namespace faintline

#include "noise/pings/openPings.h"

#include "base/Error.h"
#include "base/files/fileName.h"
#include "noise/pings/NormalisedPings.h"
#include "noise/pings/guessPingValues.h"
#include "signal/formats/Hdf5Pings.h"
#include "signal/formats/NumPyPings.h"
#include "signal/formats/gridFile.h"

#include <vector>

namespace faintline {

namespace {

    /// The shape of a NumPy file; empty if it cannot be read, of which the next reader reports why.
    std::vector<Index> shapeOf(const std::string &path)
    {
        try {
            return readNumPyHeader(path).shape;
        } catch (const Error &) {
            return {};
        }
    }

    bool hasSeveralAxes(const std::string &path, const std::string &gridPath)
    {
        const std::vector<Index> shape = shapeOf(path);
        constexpr std::size_t pingDimensionMinimum = 3;
        return shape.size() >= pingDimensionMinimum
               && (gridPath.empty() || !readGridFile(gridPath, shape).grid.isSpectrum());
    }

} // namespace

std::shared_ptr<const RawPings> openRawPings(const std::string &path, const std::string &gridPath)
{
    if (hasEnding(path, ".npy"))
        return hasSeveralAxes(path, gridPath) ? std::make_shared<NumPyPings>(path, gridPath) : nullptr;
    if (isFile(path) && Hdf5Pings::recognises(path))
        return std::make_shared<Hdf5Pings>(path, gridPath);
    return nullptr;
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

#include "noise/pings/openPings.h"

#include "base/Error.h"
#include "base/files/fileName.h"
#include "noise/pings/NormalisedPings.h"
#include "noise/pings/guessPingValues.h"
#include "signal/fileFormats.h"

namespace faintline {

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

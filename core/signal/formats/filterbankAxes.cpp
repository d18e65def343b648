#include "signal/formats/filterbankAxes.h"

#include "base/Error.h"
#include "base/Field.h"

#include <cmath>
#include <limits>

namespace faintline {

namespace {

    constexpr Index coarseChannel = Index(1) << 20; ///< channels

    void checkWithin(double value, double least, double most, const char *name, const std::string &path)
    {
        if (!(value >= least && value <= most))
            throw Error(path + ": " + name + " = " + formatNumber(value),
                        "must lie in " + formatNumber(least) + " … " + formatNumber(most));
    }

} // namespace

void setFilterbankAxes(PowerInfo &info, const FilterbankHeader &header, const std::string &path)
{
    constexpr double frequencyLimitMHz = 1e9; // MHz
    constexpr double megahertz = 1e6;
    constexpr double unixDay = 40587.0; // MJD of 1970-01-01
    constexpr double daySeconds = 86400.0;
    checkWithin(header.tsamp, 1e-12, 1e7, "tsamp", path);
    checkWithin(header.fch1, -frequencyLimitMHz, frequencyLimitMHz, "fch1", path);
    checkWithin(header.foff, -frequencyLimitMHz, frequencyLimitMHz, "foff", path);
    if (!(std::abs(header.foff) > 0.0))
        throw Error(path + ": foff = 0", "must be the channel spacing, MHz");
    const double lowest = header.foff < 0.0 ? header.fch1 + double(header.channels - 1) * header.foff : header.fch1;
    info.frequency = {"frequency", "Hz", lowest * megahertz, std::abs(header.foff) * megahertz, header.channels, false};
    info.time = {"time", "s", 0.5 * header.tsamp, header.tsamp, header.frames, false};
    if (header.tstart > unixDay && header.tstart < 1e6)
        info.startUnixSeconds = (header.tstart - unixDay) * daySeconds;
    if (header.channels > 0 && header.channels % coarseChannel == 0)
        info.notes.push_back("The middle channel of each of its " + std::to_string(header.channels / coarseChannel)
                             + " coarse channels holds the receiver's DC offset and is not observed "
                               "(noise.blankDc=false observes it).");
}

void excludeDc(const PowerInfo &info, const PowerPart &part, bool descends, std::span<float> out)
{
    const Index all = info.frequency.count;
    if (part.hasDc || all % coarseChannel != 0)
        return;
    for (Index middle = coarseChannel / 2; middle < all; middle += coarseChannel) {
        const Index cell = (descends ? all - 1 - middle : middle) - part.firstCell;
        for (Index frame = 0; cell >= 0 && cell < part.cells && frame < part.frames; ++frame)
            out[std::size_t(frame * part.cells + cell)] = std::numeric_limits<float>::quiet_NaN();
    }
}

} // namespace faintline

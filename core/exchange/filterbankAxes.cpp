#include "exchange/filterbankAxes.h"

#include "base/Error.h"
#include "base/Field.h"

#include <cmath>
#include <limits>

namespace faintline {

namespace {

    void check(double value, double least, double most, const char *name, const std::string &path)
    {
        if (!(value >= least && value <= most))
            throw Error(path + ": " + name + " = " + formatNumber(value),
                        "must lie in " + formatNumber(least) + " … " + formatNumber(most));
    }

} // namespace

void setFilterbankAxes(PowerInfo &info, const FilterbankHeader &header, const std::string &path)
{
    constexpr double farthest = 1e9; // MHz
    constexpr double megahertz = 1e6;
    constexpr double unixDay = 40587.0; // MJD of 1970-01-01
    constexpr double daySeconds = 86400.0;
    check(header.tsamp, 1e-12, 1e7, "tsamp", path);
    check(header.fch1, -farthest, farthest, "fch1", path);
    check(header.foff, -farthest, farthest, "foff", path);
    if (!(std::abs(header.foff) > 0.0))
        throw Error(path + ": foff = 0", "must be the channel spacing, MHz");
    const double lowest = header.foff < 0.0 ? header.fch1 + double(header.channels - 1) * header.foff : header.fch1;
    info.frequency = {"frequency", "Hz", lowest * megahertz, std::abs(header.foff) * megahertz, header.channels, false};
    info.time = {"time", "s", 0.5 * header.tsamp, header.tsamp, header.frames, false};
    if (header.tstart > unixDay && header.tstart < 1e6)
        info.startUnixSeconds = (header.tstart - unixDay) * daySeconds;
}

void excludeDc(const PowerInfo &info, const PowerPart &part, bool descends, std::span<float> out)
{
    constexpr Index coarse = Index(1) << 20;
    constexpr Index fewest = Index(1) << 16;
    const Index all = info.frequency.count;
    if (all < fewest)
        return;
    const Index spacing = all % coarse == 0 ? coarse : all;
    for (Index middle = spacing / 2; middle < all; middle += spacing) {
        const Index cell = (descends ? all - 1 - middle : middle) - part.firstCell;
        for (Index frame = 0; cell >= 0 && cell < part.cells && frame < part.frames; ++frame)
            out[std::size_t(frame * part.cells + cell)] = std::numeric_limits<float>::quiet_NaN();
    }
}

} // namespace faintline

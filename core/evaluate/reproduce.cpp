#include "evaluate/reproduce.h"

#include "base/Error.h"
#include "evaluate/reproduceBillon.h"
#include "evaluate/reproduceGrossi.h"
#include "evaluate/reproduceParsons.h"

#include <algorithm>
#include <cmath>

namespace faintline {

bool ReproducedCell::isInside() const
{
    return !reference || std::abs(ours - *reference) <= tolerance;
}

std::optional<double> ReproducedCell::z() const
{
    constexpr double errorsPerInterval = 2.0 * 1.959963984540054;
    const double standardError = std::hypot((interval.high - interval.low) / errorsPerInterval, paperError);
    if (!paper || !(standardError > 0.0))
        return std::nullopt;
    return (ours - *paper) / standardError;
}

bool Reproduction::isInside() const
{
    return std::all_of(cells.begin(), cells.end(), [](const ReproducedCell &cell) { return cell.isInside(); });
}

const std::vector<Reproducible> &reproducibles()
{
    static const std::vector<Reproducible> list = [] {
        std::vector<Reproducible> all;
        for (const auto &paper : {billonReproducibles(), grossiReproducibles(), parsonsReproducibles()})
            all.insert(all.end(), paper.begin(), paper.end());
        return all;
    }();
    return list;
}

const Reproducible &reproducible(std::string_view name)
{
    std::string known;
    for (const Reproducible &entry : reproducibles()) {
        if (entry.name == name)
            return entry;
        known += (known.empty() ? "" : ", ") + entry.name;
    }
    throw Error("reproduce " + std::string(name), "is not known; there are " + known);
}

} // namespace faintline

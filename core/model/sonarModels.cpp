#include "model/sonarModels.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/oneLine.h"

namespace faintline {

SonarMotion nonManoeuvring()
{
    return {};
}

SonarMotion manoeuvring(int reach)
{
    SonarMotion motion;
    motion.rangeRateChange.assign(std::size_t(reach) + 1, 1.0 / (2.0 * reach + 1.0));
    motion.bearingRateChange = {0.5, 0.25};
    return motion;
}

MarkovModel sonarModel(const Grid &grid, const SonarMotion &motion)
{
    if (!grid.isSurface())
        throw Error("model.motion", "requires frames on range and bearing; the frames have " + grid.axisCountWords());
    const Axis &range = grid.axes[0];
    const Axis &bearing = grid.axes[1];
    const auto kinematic = [](const Axis &axis, int fastest, const std::vector<double> &rateChange) {
        return KinematicAxis{axis.name,       axis.count, axis.cyclic, -fastest,
                             2 * fastest + 1, rateChange, {},          Rounding::Trunc};
    };
    return {StateSpace({kinematic(range, motion.fastestRange, motion.rangeRateChange),
                        kinematic(bearing, motion.fastestBearing, motion.bearingRateChange)}),
            Likelihood(LikelihoodKind::Linear), 1.0};
}

const std::vector<NamedMotion> &sonarMotions()
{
    static const std::vector<NamedMotion> list{
        {"nonManoeuvring", "Targets that keep their rates of range and bearing.", nonManoeuvring()},
        {"manoeuvring",
         "Targets whose range rate changes by up to four cells per ping, and whose bearing rate by one beam.",
         manoeuvring()},
        {"gentle",
         "Targets whose range rate changes by one cell per ping at the most, and whose bearing rate by one beam.",
         manoeuvring(1)},
    };
    return list;
}

const SonarMotion &sonarMotion(std::string_view name)
{
    const auto found = std::ranges::find(sonarMotions(), name, &NamedMotion::name);
    if (found == sonarMotions().end())
        throw fieldError("model.motion", std::string(name),
                         "must be one of " + listed(sonarMotions(), &NamedMotion::name));
    return found->motion;
}

} // namespace faintline

#include "scene/editTargets.h"

#include "scene/PingTruth.h"
#include "scene/legRates.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double finestCells = 0.1; ///< to which a dragged place is rounded

    TruthTarget pathOf(const PingScene &scene, const PingTarget &target)
    {
        PingScene alone; // a copy would also take all other targets
        alone.pings = scene.pings;
        alone.priSeconds = scene.priSeconds;
        alone.rangeCells = scene.rangeCells;
        alone.firstRangeMetres = scene.firstRangeMetres;
        alone.rangeStepMetres = scene.rangeStepMetres;
        alone.beams = scene.beams;
        alone.firstBearingDegrees = scene.firstBearingDegrees;
        alone.beamStepDegrees = scene.beamStepDegrees;
        alone.targets = {target};
        return pingTruth(alone).targets.front();
    }

    /// Rounds to the largest power of ten up to `finest`, so that few digits remain.
    double rounded(double value, double finest)
    {
        const double digits = std::ceil(-std::log10(finest));
        const double scale = std::pow(10.0, std::abs(digits));
        return (digits > 0.0 ? std::round(value * scale) / scale : std::round(value / scale) * scale) + 0.0; // no -0
    }

    double clamped(const Axis &axis, double value)
    {
        if (!axis.cyclic)
            return std::clamp(value, axis.first, axis.last());
        const double turn = axis.step * double(axis.count);
        return value - turn * std::floor((value - axis.value(-0.5)) / turn);
    }

    /// Cells from one value to another, the shorter way on a cyclic axis.
    double cellsBetween(const Axis &axis, double from, double to)
    {
        const double cells = (to - from) / axis.step;
        return axis.cyclic ? cells - double(axis.count) * std::round(cells / double(axis.count)) : cells;
    }

    /// Cells by which a place k pings after the start moves if the leg's rate grows by one cell per ping.
    double leverOf(const PingScene &scene, const PingTarget &target, std::size_t leg, int k)
    {
        PingTarget probe = target;
        probe.weaveCellsPerPing = 0.0;
        for (PingLeg &other : probe.legs) {
            setRangeRate(other, 0.0, RateUnit::PerPing);
            setBearingRate(other, 0.0, RateUnit::PerPing);
        }
        probe.legs[leg].rangeCellsPerPing = 1.0;
        const TruthTarget path = pathOf(scene, probe);
        return (path.rangeMetres[std::size_t(k)] - path.rangeMetres.front()) / scene.rangeStepMetres;
    }

    /// The last ping with the target.
    int lastPing(const PingScene &scene, const PingTarget &target)
    {
        return (target.vanishPing == 0 ? scene.pings : std::min(target.vanishPing, scene.pings)) - 1;
    }

} // namespace

std::vector<TargetCorner> cornersOf(const PingScene &scene, const PingTarget &target)
{
    const int last = lastPing(scene, target);
    if (target.appearPing > last)
        return {};
    const TruthTarget path = pathOf(scene, target);
    std::vector<TargetCorner> corners;
    const auto add = [&](int ping) {
        const auto k = std::size_t(ping - target.appearPing);
        corners.push_back({ping, {path.rangeMetres[k], path.bearingDegrees[k]}});
    };
    int ping = target.appearPing;
    add(ping);
    for (const PingLeg &leg : target.legs) {
        if (ping >= last)
            break;
        ping = leg.pings == 0 ? last : std::min(ping + leg.pings, last);
        add(ping);
    }
    return corners;
}

PingTarget withCornerAt(const PingScene &scene, const PingTarget &target, std::size_t corner, const ScenePlace &place,
                        RateUnit unit)
{
    const std::vector<TargetCorner> corners = cornersOf(scene, target);
    PingTarget result = target;
    if (corner >= corners.size())
        return result;
    const Grid grid = pingGrid(scene);
    const Axis &range = grid.axes[0];
    const Axis &bearing = grid.axes[1];
    const ScenePlace to{clamped(range, place.rangeMetres), clamped(bearing, place.bearingDegrees)};
    if (corner == 0) {
        result.rangeMetres = rounded(to.rangeMetres, finestCells * range.step);
        result.bearingDegrees = rounded(to.bearingDegrees, finestCells * bearing.step);
        return result;
    }
    const ScenePlace &from = corners[corner].place;
    PingLeg &leg = result.legs[corner - 1];
    const double lever = leverOf(scene, target, corner - 1, corners[corner].ping - target.appearPing);
    const double finest = finestCells / lever;
    const LegRates before = ratesOf(leg, scene.priSeconds, grid);
    const double rangeRate = before.range + cellsBetween(range, from.rangeMetres, to.rangeMetres) / lever;
    const double bearingRate = before.bearing + cellsBetween(bearing, from.bearingDegrees, to.bearingDegrees) / lever;
    const bool isPerPing = unit == RateUnit::PerPing;
    const double metres = isPerPing ? 1.0 : range.step / scene.priSeconds;
    const double degrees = isPerPing ? 1.0 : bearing.step / scene.priSeconds;
    setRangeRate(leg, rounded(rangeRate * metres, finest * metres), unit);
    setBearingRate(leg, rounded(bearingRate * degrees, finest * degrees), unit);
    return result;
}

PingTarget withLegTo(const PingScene &scene, const PingTarget &target, const ScenePlace &place, RateUnit unit)
{
    if (!target.legs.empty() && target.legs.back().pings == 0)
        throw Error("leg " + std::to_string(target.legs.size()),
                    "lasts to the end; give it a number of pings, then add a leg");
    const std::vector<TargetCorner> corners = cornersOf(scene, target);
    const int last = lastPing(scene, target);
    if (corners.size() <= target.legs.size() || corners.back().ping >= last)
        throw Error("leg " + std::to_string(target.legs.size() + 1),
                    "has no ping left before ping " + std::to_string(last + 1)
                        + ", the target's last; shorten a leg or let the target appear earlier");
    PingTarget result = target;
    result.legs.push_back({.pings = std::min(usualLegPings, last - corners.back().ping)});
    return withCornerAt(scene, result, result.legs.size(), place, unit);
}

RateUnit rateUnitOf(const PingScene &scene)
{
    for (const PingTarget &target : scene.targets)
        for (const PingLeg &leg : target.legs)
            if (leg.rangeCellsPerPing != 0.0 || leg.beamsPerPing != 0.0)
                return RateUnit::PerPing;
    return RateUnit::PerSecond;
}

double rangeRateOf(const PingLeg &leg, const PingScene &scene, RateUnit unit)
{
    const double metresPerSecond = scene.rangeStepMetres / scene.priSeconds;
    return unit == RateUnit::PerPing ? leg.rangeCellsPerPing + leg.rangeRateMetresPerSecond / metresPerSecond
                                     : leg.rangeRateMetresPerSecond + leg.rangeCellsPerPing * metresPerSecond;
}

double bearingRateOf(const PingLeg &leg, const PingScene &scene, RateUnit unit)
{
    const double degreesPerSecond = pingGrid(scene).axes[1].step / scene.priSeconds;
    return unit == RateUnit::PerPing ? leg.beamsPerPing + leg.bearingRateDegreesPerSecond / degreesPerSecond
                                     : leg.bearingRateDegreesPerSecond + leg.beamsPerPing * degreesPerSecond;
}

void setRangeRate(PingLeg &leg, double rate, RateUnit unit)
{
    leg.rangeCellsPerPing = unit == RateUnit::PerPing ? rate : 0.0;
    leg.rangeRateMetresPerSecond = unit == RateUnit::PerPing ? 0.0 : rate;
}

void setBearingRate(PingLeg &leg, double rate, RateUnit unit)
{
    leg.beamsPerPing = unit == RateUnit::PerPing ? rate : 0.0;
    leg.bearingRateDegreesPerSecond = unit == RateUnit::PerPing ? 0.0 : rate;
}

} // namespace faintline

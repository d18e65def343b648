#include "scene/PingTruth.h"

#include "scene/legRates.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace faintline {

namespace {

    const std::vector<Field<TruthTarget>> &targetFields()
    {
        using S = TruthTarget;
        static const std::vector<Field<S>> table{
            field(&S::snrDb, "snrDb", "dB", -1e3, 1e3, "Power of the echo over the noise in a cell."),
            field(&S::firstPing, "firstPing", "ping", 0.0, 1e9, "First ping of the lists."),
            field(&S::rangeMetres, "rangeMetres", "m", -1e15, 1e15, "Range, one value per ping."),
            field(&S::bearingDegrees, "bearingDegrees", "°", -1e15, 1e15, "Bearing, one value per ping."),
            field(&S::elevationDegrees, "elevationDegrees", "°", -1e15, 1e15,
                  "Elevation, one value per ping; empty without such an axis."),
            field(&S::dopplerMetresPerSecond, "dopplerMetresPerSecond", "m/s", -1e15, 1e15,
                  "Range rate, one value per ping; empty without such an axis."),
            field(&S::cell, "cell", "", -1.0, 1e15, "Cell of the grid that the target occupies; -1 outside the grid."),
        };
        return table;
    }

    /// Rates k pings after the target appeared.
    LegRates ratesAt(int k, const PingTarget &target, const PingScene &scene, const Grid &grid)
    {
        LegRates rates;
        LegRates before;
        int begin = 0;
        for (std::size_t i = 0; i < target.legs.size(); ++i) {
            const PingLeg &leg = target.legs[i];
            const LegRates own = ratesOf(leg, scene.priSeconds, grid);
            const double share = i == 0 ? 1.0 : std::min(1.0, double(k - begin + 1) / leg.turnPings);
            rates = {std::lerp(before.range, own.range, share), std::lerp(before.bearing, own.bearing, share),
                     std::lerp(before.elevationDegrees, own.elevationDegrees, share)};
            if (leg.pings == 0 || k < begin + leg.pings)
                break;
            before = own;
            begin += leg.pings;
        }
        rates.range += target.weaveCellsPerPing * std::sin(2.0 * std::numbers::pi * k / target.weavePings);
        return rates;
    }

    /// The cell of a position on one axis, given in cells.
    Index cellOf(double position)
    {
        return Index(std::floor(position + 0.5));
    }

    TruthTarget truthOf(const PingTarget &target, const PingScene &scene, const Grid &grid)
    {
        const Axis &range = grid.axes[0];
        const Axis &bearing = grid.axes[1];
        TruthTarget truth;
        truth.snrDb = target.snrDb;
        truth.firstPing = target.appearPing;
        double r = range.position(target.rangeMetres);
        double b = bearing.position(target.bearingDegrees);
        double elevation = target.elevationDegrees;
        const int end = target.vanishPing == 0 ? scene.pings : std::min(target.vanishPing, scene.pings);
        LegRates rates = ratesAt(0, target, scene, grid);
        for (int ping = target.appearPing; ping < end; ++ping) {
            if (bearing.cyclic)
                b -= double(bearing.count) * std::floor((b + 0.5) / double(bearing.count));
            truth.rangeMetres.push_back(range.value(r));
            truth.bearingDegrees.push_back(bearing.value(b));
            std::vector<Index> cell{cellOf(r), cellOf(b)};
            if (scene.elevationCells > 1) {
                truth.elevationDegrees.push_back(elevation);
                cell.push_back(cellOf(grid.axes[cell.size()].position(elevation)));
            }
            if (scene.dopplerCells > 1) {
                truth.dopplerMetresPerSecond.push_back(rates.range * range.step / scene.priSeconds);
                cell.push_back(cellOf(grid.axes[cell.size()].position(truth.dopplerMetresPerSecond.back())));
            }
            truth.cell.push_back(double(grid.cell(cell)));
            const LegRates next = ratesAt(ping + 1 - target.appearPing, target, scene, grid);
            r += 0.5 * (rates.range + next.range);
            b += 0.5 * (rates.bearing + next.bearing);
            elevation += 0.5 * (rates.elevationDegrees + next.elevationDegrees);
            rates = next;
        }
        return truth;
    }

} // namespace

Index TruthTarget::cellAt(Index ping) const
{
    const Index k = ping - firstPing;
    return k >= 0 && k < std::ssize(cell) ? Index(cell[std::size_t(k)]) : -1;
}

double TruthTarget::positionOn(std::size_t axis, const Grid &grid, std::size_t i) const
{
    std::vector<double> known;
    for (const auto *values : {&rangeMetres, &bearingDegrees, &elevationDegrees, &dopplerMetresPerSecond})
        if (!values->empty())
            known.push_back((*values)[i]);
    return grid.fits(known) ? known[axis] : grid.position(Index(cell[i]))[axis];
}

PingTruth pingTruth(const PingScene &scene)
{
    const Grid grid = pingGrid(scene);
    PingTruth truth;
    for (const PingTarget &target : scene.targets)
        truth.targets.push_back(truthOf(target, scene, grid));
    return truth;
}

Json toJson(const PingTruth &truth)
{
    Json json;
    json["targets"] = Json::array();
    for (const TruthTarget &target : truth.targets) {
        Json &entry = json["targets"].emplace_back(writeFields(target, targetFields()));
        for (const char *name : {"elevationDegrees", "dopplerMetresPerSecond"})
            if (entry[name].empty())
                entry.erase(name);
    }
    return json;
}

PingTruth pingTruthFromJson(const Json &json)
{
    checkKeys(json, "truth", {"targets"});
    const auto targets = json.find("targets");
    if (targets == json.end() || !targets->is_array())
        throw Error("truth.targets", "must be a list, [ … ]");
    PingTruth truth;
    for (const Json &entry : *targets) {
        const std::string name = "targets[" + std::to_string(truth.targets.size()) + "]";
        TruthTarget &target = truth.targets.emplace_back();
        readFields(entry, targetFields(), target, name);
        const auto fits = [&](const std::vector<double> &values) { return values.size() == target.cell.size(); };
        const auto mayBeMissing = [&](const std::vector<double> &values) { return values.empty() || fits(values); };
        if (!fits(target.rangeMetres) || !fits(target.bearingDegrees) || !mayBeMissing(target.elevationDegrees)
            || !mayBeMissing(target.dopplerMetresPerSecond))
            throw Error(
                name,
                "must have equally many values of rangeMetres, bearingDegrees and cell, and of elevationDegrees and "
                "dopplerMetresPerSecond if given");
    }
    return truth;
}

} // namespace faintline

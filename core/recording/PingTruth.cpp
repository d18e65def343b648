#include "recording/PingTruth.h"

#include "recording/legRates.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace faintline {

namespace {

    const std::vector<Field<TruthTarget>> &fields()
    {
        using S = TruthTarget;
        static const std::vector<Field<S>> table{
            field(&S::snrDb, "snrDb", "dB", -1e3, 1e3, "Power of the echo over the noise in a cell."),
            field(&S::firstPing, "firstPing", "ping", 0.0, 1e9, "First ping of the lists."),
            field(&S::rangeMetres, "rangeMetres", "m", -1e15, 1e15, "Range, one value per ping."),
            field(&S::bearingDegrees, "bearingDegrees", "°", -1e15, 1e15, "Bearing, one value per ping."),
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
            rates = {std::lerp(before.range, own.range, share), std::lerp(before.bearing, own.bearing, share)};
            if (leg.pings == 0 || k < begin + leg.pings)
                break;
            before = own;
            begin += leg.pings;
        }
        rates.range += target.weaveCellsPerPing * std::sin(2.0 * std::numbers::pi * k / target.weavePings);
        return rates;
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
        const int end = target.vanishPing == 0 ? scene.pings : std::min(target.vanishPing, scene.pings);
        LegRates rates = ratesAt(0, target, scene, grid);
        for (int ping = target.appearPing; ping < end; ++ping) {
            if (bearing.cyclic)
                b -= double(bearing.count) * std::floor((b + 0.5) / double(bearing.count));
            truth.rangeMetres.push_back(range.value(r));
            truth.bearingDegrees.push_back(bearing.value(b));
            truth.cell.push_back(double(grid.cell({Index(std::floor(r + 0.5)), Index(std::floor(b + 0.5))})));
            const LegRates next = ratesAt(ping + 1 - target.appearPing, target, scene, grid);
            r += 0.5 * (rates.range + next.range);
            b += 0.5 * (rates.bearing + next.bearing);
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
    for (const TruthTarget &target : truth.targets)
        json["targets"].push_back(writeFields(target, fields()));
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
        readFields(entry, fields(), target, name);
        if (target.rangeMetres.size() != target.cell.size() || target.bearingDegrees.size() != target.cell.size())
            throw Error(name, "must have equally many values of rangeMetres, bearingDegrees and cell");
    }
    return truth;
}

} // namespace faintline

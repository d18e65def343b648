#include "scene/PingScene.h"

#include "base/logmath.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    std::string targetName(std::size_t i)
    {
        return "targets[" + std::to_string(i) + "]";
    }

    std::string legName(std::size_t target, std::size_t leg)
    {
        return targetName(target) + ".legs[" + std::to_string(leg) + "]";
    }

    void checkTarget(const PingScene &scene, const PingTarget &target, std::size_t i)
    {
        const std::string name = targetName(i);
        checkFields(target, PingTarget::fields(), name);
        for (std::size_t leg = 0; leg < target.legs.size(); ++leg) {
            checkFields(target.legs[leg], PingLeg::fields(), legName(i, leg));
            if (target.legs[leg].pings == 0 && leg + 1 < target.legs.size())
                throw Error(legName(i, leg) + ".pings = 0",
                            "lasts to the end, but another leg follows; give its length");
        }
        if (target.fluctuation != Fluctuation::None && target.echo == Echo::Fluctuating)
            throw Error(name + ".fluctuation = " + std::string(fluctuationNames[std::size_t(target.fluctuation)]),
                        "is not possible with echo = fluctuating, which is Swerling 2 already; use echo = complex");
        if (target.vanishPing != 0 && target.vanishPing <= target.appearPing)
            throw Error(name + ".vanishPing = " + std::to_string(target.vanishPing),
                        "must be greater than appearPing = " + std::to_string(target.appearPing)
                            + ", or 0 if the "
                              "target stays");
        if (target.appearPing >= scene.pings)
            throw Error(name + ".appearPing = " + std::to_string(target.appearPing),
                        "must be one of the pings, 0 … " + std::to_string(scene.pings - 1));
        const Axis range = pingGrid(scene).axes[0];
        const double cell = range.position(target.rangeMetres);
        if (cell < -0.5 || cell >= double(range.count) - 0.5)
            throw Error(name + ".rangeMetres = " + formatNumber(target.rangeMetres),
                        "must lie within the range cells, " + formatNumber(range.first) + " … "
                            + formatNumber(range.last()) + " m");
    }

} // namespace

const std::vector<Field<PingLeg>> &PingLeg::fields()
{
    using S = PingLeg;
    static const std::vector<Field<S>> table{
        field(&S::pings, "pings", "pings", 0.0, 1e6, "Number of pings in the leg; 0 extends it to the end."),
        field(&S::rangeRateMetresPerSecond, "rangeRateMetresPerSecond", "m/s", -1e6, 1e6,
              "Rate of range, outward positive."),
        field(&S::bearingRateDegreesPerSecond, "bearingRateDegreesPerSecond", "°/s", -360.0, 360.0, "Rate of bearing."),
        field(&S::elevationRateDegreesPerSecond, "elevationRateDegreesPerSecond", "°/s", -360.0, 360.0,
              "Rate of elevation, if the scene has elevations."),
        field(&S::rangeCellsPerPing, "rangeCellsPerPing", "cells/ping", -1e4, 1e4,
              "Rate of range in cells; adds to the one in m/s."),
        field(&S::beamsPerPing, "beamsPerPing", "beams/ping", -1e3, 1e3,
              "Rate of bearing in beams; adds to the one in °/s."),
        field(&S::turnPings, "turnPings", "pings", 1.0, 1e6,
              "Pings over which the rates change from those of the "
              "previous leg to these."),
    };
    return table;
}

const std::vector<Field<PingTarget>> &PingTarget::fields()
{
    using S = PingTarget;
    static const std::vector<Field<S>> table{
        field(&S::snrDb, "snrDb", "dB", -60.0, 80.0,
              "Power of the echo over the noise power in a cell, without "
              "reverberation."),
        field(&S::echo, "echo", echoNames,
              "Constant added power, a power drawn independently in every ping, or a "
              "constant amplitude."),
        field(&S::fluctuation, "fluctuation", fluctuationNames,
              "Fluctuation of the echo's power about its mean: one power for the whole track (Swerling 1 and 3), or "
              "one in every ping (2 and 4)."),
        field(&S::rangeMetres, "rangeMetres", "m", 0.0, 1e9, "Range at which the target appears."),
        field(&S::bearingDegrees, "bearingDegrees", "°", -360.0, 720.0, "Bearing at which the target appears."),
        field(&S::elevationDegrees, "elevationDegrees", "°", -90.0, 90.0,
              "Elevation at which the target appears, if the scene has elevations."),
        field(&S::appearPing, "appearPing", "ping", 0.0, 1e6, "First ping with the target, counted from 0."),
        field(&S::vanishPing, "vanishPing", "ping", 0.0, 1e6, "First ping without the target; 0: it stays to the end."),
        field(&S::weaveCellsPerPing, "weaveCellsPerPing", "cells/ping", 0.0, 1e4,
              "Amplitude of a sinusoid added to "
              "the range rate."),
        field(&S::weavePings, "weavePings", "pings", 1.0, 1e6, "Period of that sinusoid."),
    };
    return table;
}

const std::vector<Field<Reverberation>> &Reverberation::fields()
{
    using S = Reverberation;
    static const std::vector<Field<S>> table{
        field(&S::levelDb, "levelDb", "dB", -60.0, 80.0,
              "Power of the reverberation over the noise in the first range "
              "cell."),
        field(&S::decayPower, "decayPower", "", 0.0, 10.0, "Exponent with which the reverberation falls with range."),
        field(&S::normalisation, "normalisation", pingNormalisationNames,
              "Whether the mean used for normalisation is "
              "known or estimated."),
    };
    return table;
}

const std::vector<Field<PingScene>> &PingScene::fields()
{
    using S = PingScene;
    static const std::vector<Field<S>> table{
        field(&S::pings, "pings", "pings", 1.0, 1e6, "Number of pings."),
        field(&S::priSeconds, "priSeconds", "s", 1e-6, 1e6, "Time from ping to ping."),
        field(&S::rangeCells, "rangeCells", "cells", 1.0, 1e6, "Number of range cells in a ping."),
        field(&S::firstRangeMetres, "firstRangeMetres", "m", 0.0, 1e9, "Range of the first cell's centre."),
        field(&S::rangeStepMetres, "rangeStepMetres", "m", 1e-6, 1e6, "Length of a range cell."),
        field(&S::beams, "beams", "beams", 1.0, 1e4, "Number of beams in a ping."),
        field(&S::firstBearingDegrees, "firstBearingDegrees", "°", -360.0, 360.0, "Bearing of the first beam."),
        field(&S::beamStepDegrees, "beamStepDegrees", "°", 0.0, 360.0,
              "Bearing step between beams; 0: full circle, "
              "360°/beams."),
        field(&S::elevationCells, "elevationCells", "cells", 1.0, 1e3,
              "Number of elevations in a ping; 1: no axis of elevation."),
        field(&S::firstElevationDegrees, "firstElevationDegrees", "°", -90.0, 90.0, "Elevation of the first cell."),
        field(&S::elevationStepDegrees, "elevationStepDegrees", "°", 1e-3, 90.0, "Step between elevations."),
        field(&S::dopplerCells, "dopplerCells", "cells", 1.0, 1e4,
              "Number of Doppler cells in a ping; 1: no axis of range rates."),
        field(&S::firstDopplerMetresPerSecond, "firstDopplerMetresPerSecond", "m/s", -1e6, 1e6,
              "Range rate of the first Doppler cell, outward positive."),
        field(&S::dopplerStepMetresPerSecond, "dopplerStepMetresPerSecond", "m/s", 1e-6, 1e6,
              "Range rate between Doppler cells."),
        field(&S::looks, "looks", "", 1.0, 1000.0, "Number of powers averaged in a cell."),
        field(&S::seed, "seed", "", 0.0, 2147483647.0,
              "Seed of the random numbers; the same seed gives the same pings."),
    };
    return table;
}

Grid pingGrid(const PingScene &scene)
{
    const double step = scene.beamStepDegrees > 0.0 ? scene.beamStepDegrees : 360.0 / scene.beams;
    const bool isAllRound = std::abs(step * scene.beams - 360.0) < 1e-9 * 360.0;
    Grid grid{{{"range", "m", scene.firstRangeMetres, scene.rangeStepMetres, scene.rangeCells, false},
               {"bearing", "°", scene.firstBearingDegrees, step, scene.beams, isAllRound}}};
    if (scene.elevationCells > 1)
        grid.axes.push_back(
            {"elevation", "°", scene.firstElevationDegrees, scene.elevationStepDegrees, scene.elevationCells, false});
    if (scene.dopplerCells > 1)
        grid.axes.push_back({"Doppler", "m/s", scene.firstDopplerMetresPerSecond, scene.dopplerStepMetresPerSecond,
                             scene.dopplerCells, false});
    return grid;
}

Axis pingTime(const PingScene &scene)
{
    return {"time", "s", 0.0, scene.priSeconds, scene.pings, false};
}

double backgroundPower(const PingScene &scene, Index rangeCell)
{
    if (!scene.reverberation)
        return 1.0;
    const Axis range = pingGrid(scene).axes[0];
    const double ratio = range.value(double(rangeCell)) / range.first;
    return 1.0 + ratioFromDb(scene.reverberation->levelDb) * std::pow(ratio, -scene.reverberation->decayPower);
}

void checkScene(const PingScene &scene)
{
    checkFields(scene, PingScene::fields());
    const double cells = double(scene.rangeCells) * scene.beams * scene.elevationCells * scene.dopplerCells;
    if (cells > 1e7)
        throw fieldError("rangeCells", std::to_string(scene.rangeCells),
                         "times the cells of the other axes gives " + formatNumber(cells)
                             + " cells; at most 1e7 are possible");
    if (scene.beamStepDegrees * scene.beams > 360.0 * (1.0 + 1e-9))
        throw fieldError("beamStepDegrees", formatNumber(scene.beamStepDegrees),
                         "times beams is more than 360°; at most " + formatNumber(360.0 / scene.beams) + "°");
    if (scene.reverberation) {
        checkFields(*scene.reverberation, Reverberation::fields(), "reverberation");
        if (scene.firstRangeMetres <= 0.0)
            throw Error("firstRangeMetres = 0", "must be above 0 with reverberation, whose level refers to it");
        if (scene.reverberation->normalisation == PingNormalisation::Estimated
            && scene.elevationCells * scene.dopplerCells > 1)
            throw fieldError("reverberation.normalisation", "estimated", "requires pings on range and bearing only");
        constexpr int fewestCells = 32;
        if (scene.reverberation->normalisation == PingNormalisation::Estimated && cells < fewestCells)
            throw fieldError("reverberation.normalisation", "estimated",
                             "needs at least " + std::to_string(fewestCells) + " cells in a ping");
    }
    constexpr std::size_t mostTargets = 1000;
    constexpr double mostPlaces = 3e6; // 24 bytes each
    constexpr double mostSteps = 1e8;  // each leg is evaluated for each ping
    if (scene.targets.size() > mostTargets)
        throw Error("targets", "must be at most " + std::to_string(mostTargets));
    double places = 0.0;
    double steps = 0.0;
    for (std::size_t i = 0; i < scene.targets.size(); ++i) {
        const PingTarget &target = scene.targets[i];
        checkTarget(scene, target, i);
        const int end = target.vanishPing == 0 ? scene.pings : std::min(target.vanishPing, scene.pings);
        places += end - target.appearPing;
        steps += double(end - target.appearPing) * double(target.legs.size());
        if (places > mostPlaces)
            throw Error(targetName(i), "exceeds the limit of 3e6 pings in total, counting the targets before it");
        if (steps > mostSteps)
            throw Error(targetName(i) + ".legs", "are too many for this number of pings, counting those of the targets "
                                                 "before it");
    }
}

bool isPingScene(const Json &json)
{
    const auto kind = json.is_object() ? json.find("kind") : json.end();
    return kind != json.end() && *kind == "pings";
}

PingScene pingSceneFromJson(const Json &json)
{
    PingScene scene;
    readFields(json, PingScene::fields(), scene, {}, {"kind", "reverberation", "targets"});
    if (!isPingScene(json))
        throw Error("kind", "must be \"pings\" for a scene of sonar pings");
    if (const auto found = json.find("reverberation"); found != json.end())
        readFields(*found, Reverberation::fields(), scene.reverberation.emplace(), "reverberation");
    for (const Json &entry : listOf(json, "targets")) {
        const std::size_t i = scene.targets.size();
        PingTarget &target = scene.targets.emplace_back();
        readFields(entry, PingTarget::fields(), target, targetName(i), {"legs"});
        for (const Json &leg : listOf(entry, "legs", targetName(i))) {
            const std::size_t number = target.legs.size();
            readFields(leg, PingLeg::fields(), target.legs.emplace_back(), legName(i, number));
        }
    }
    checkScene(scene);
    return scene;
}

Json toJson(const PingScene &scene)
{
    Json json;
    json["kind"] = "pings";
    json.update(writeFields(scene, PingScene::fields()));
    if (scene.reverberation)
        json["reverberation"] = writeFields(*scene.reverberation, Reverberation::fields());
    json["targets"] = Json::array();
    for (const PingTarget &target : scene.targets) {
        Json entry = writeFields(target, PingTarget::fields());
        entry["legs"] = Json::array();
        for (const PingLeg &leg : target.legs)
            entry["legs"].push_back(writeFields(leg, PingLeg::fields()));
        json["targets"].push_back(std::move(entry));
    }
    return json;
}

} // namespace faintline

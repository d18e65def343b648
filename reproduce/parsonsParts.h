#pragma once

#include "base/Interval.h"
#include "reproduce/papers.h"
#include "scene/PingScene.h"

#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace faintline {

// Shared by the parts of the reproduction of Parsons, one file per part.

constexpr int settlingPings = 200; ///< before counting starts

/// Parsons' simulated sonar without targets, `pings` pings long.
inline PingScene noiseScene(std::uint64_t seed, int pings)
{
    PingScene scene;
    scene.pings = pings;
    scene.seed = int(seed & 0x7fffffff);
    return scene;
}

/// Our number; `judged` adds its reference, `printed` the published number.
inline ReproducedCell cellOf(std::string row, std::string column, double ours, Interval interval = {})
{
    ReproducedCell cell;
    cell.row = std::move(row);
    cell.column = std::move(column);
    cell.ours = ours;
    cell.interval = interval;
    return cell;
}

inline ReproducedCell judged(ReproducedCell cell, double reference, double tolerance)
{
    cell.reference = reference;
    cell.tolerance = tolerance;
    return cell;
}

inline ReproducedCell printed(ReproducedCell cell, double paper)
{
    cell.paper = paper;
    return cell;
}

/// Tolerance for the difference of two runs of equal length: 4·√2 standard errors.
inline double fourErrors(const Interval &interval)
{
    return 4.0 * std::numbers::sqrt2 * (interval.high - interval.low) / (2.0 * 1.959963984540054);
}

} // namespace faintline

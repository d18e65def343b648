#pragma once

#include "base/json.h"
#include "scene/PingScene.h"

#include <vector>

namespace faintline {

/// Position of a simulated target in each ping from its appearance on.
struct TruthTarget {
    double snrDb = 0.0;
    int firstPing = 0;
    std::vector<double> rangeMetres;
    std::vector<double> bearingDegrees;           ///< wrapped into the grid's turn if the beams cover 360°
    std::vector<double> cell;                     ///< flat index of the cell it fills; -1 if beyond the grid
    std::vector<double> elevationDegrees{};       ///< empty if the grid has no elevations
    std::vector<double> dopplerMetresPerSecond{}; ///< its range rate; empty if the grid has no Doppler axis

    /// The cell it fills in a ping, or -1 if it is absent.
    Index cellAt(Index ping) const;

    /// Its position on an axis in its i-th ping, in which it fills a cell: as precisely as known, at least the cell's.
    double positionOn(std::size_t axis, const Grid &grid, std::size_t i) const;

    bool operator==(const TruthTarget &) const = default;
};

/// The targets of a scene, in the scene's order.
struct PingTruth {
    std::vector<TruthTarget> targets;

    bool operator==(const PingTruth &) const = default;
};

PingTruth pingTruth(const PingScene &scene);

/// {"targets": [{"snrDb": …, "firstPing": …, "rangeMetres": […], "bearingDegrees": […], "cell": […]}]}, and
/// "elevationDegrees" and "dopplerMetresPerSecond" on grids with these axes.
Json toJson(const PingTruth &truth);

/// Throws Error naming the key.
PingTruth pingTruthFromJson(const Json &json);

} // namespace faintline

#pragma once

#include "base/json.h"
#include "recording/PingScene.h"

#include <vector>

namespace faintline {

/// Position of a simulated target in each ping from its appearance on.
struct TruthTarget {
    double snrDb = 0.0;
    int firstPing = 0;
    std::vector<double> rangeMetres;
    std::vector<double> bearingDegrees; ///< wrapped into the grid's turn if the beams cover 360°
    std::vector<double> cell;           ///< flat index of the cell it fills; -1 if beyond the grid

    /// The cell it fills in a ping, or -1 if it is absent.
    Index cellAt(Index ping) const;

    bool operator==(const TruthTarget &) const = default;
};

/// The targets of a scene, in the scene's order.
struct PingTruth {
    std::vector<TruthTarget> targets;

    bool operator==(const PingTruth &) const = default;
};

PingTruth pingTruth(const PingScene &scene);

/// {"targets": [{"snrDb": …, "firstPing": …, "rangeMetres": […], "bearingDegrees": […], "cell": […]}]}
Json toJson(const PingTruth &truth);

/// Throws Error naming the key.
PingTruth pingTruthFromJson(const Json &json);

} // namespace faintline

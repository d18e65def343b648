#pragma once

#include "base/json.h"
#include "recording/PingScene.h"

#include <vector>

namespace faintline {

/// Where a simulated target was, ping by ping from the one in which it appeared.
struct TruthTarget {
    double snrDb = 0.0;
    int firstPing = 0;
    std::vector<double> rangeMetres;
    std::vector<double> bearingDegrees; ///< brought into the grid's turn where the beams go all round
    std::vector<double> cell;           ///< flat index on the grid of the cell it fills, -1 where it is beyond the grid

    /// The cell it fills in a ping, -1 where it is not there.
    Index cellAt(Index ping) const;

    bool operator==(const TruthTarget &) const = default;
};

/// The targets of a scene, in its order.
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

#pragma once

#include <QString>

#include <vector>

namespace faintline {

/// A bundled simulated recording.
struct Scenario {
    QString title;
    QString sentence;       ///< what it shows
    QString path;           ///< path of its JSON in the program's resources
    bool isWelcome = false; ///< whether the welcome page demonstrates it
};

/// The bundled scenarios, the most instructive one first.
const std::vector<Scenario> &scenarios();

/// Path of the bundled scene of sonar pings without targets.
QString openSeaPath();

} // namespace faintline

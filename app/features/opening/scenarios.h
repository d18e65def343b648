#pragma once

#include <QString>

#include <vector>

namespace faintline {

/// A recording, or a scene to simulate, that comes with the program.
struct Scenario {
    QString title;
    QString sentence;  ///< what it shows
    QString path;      ///< of the file; of a scene, in the program's resources
    QString picture{}; ///< for the start page, in the resources; empty: not shown there
    QString credit{};  ///< of a recording
};

/// The bundled scenes, the most instructive one first.
const std::vector<Scenario> &scenarios();

/// The recordings that lie beside the program, installed or built; none if it was copied alone.
const std::vector<Scenario> &exampleRecordings();

/// Path of the bundled scene of sonar pings without targets.
QString openSeaPath();

} // namespace faintline

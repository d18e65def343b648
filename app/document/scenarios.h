#pragma once

#include <QString>

#include <vector>

namespace faintline {

/// A recording that is simulated: something to look at before one has a file of one's own.
struct Scenario {
    QString title;
    QString sentence;       ///< what is to be seen
    QString path;           ///< of its JSON among the program's resources
    bool isWelcome = false; ///< whether the welcome page shows it at work
};

/// The scenarios that come with the program, the most telling one first.
const std::vector<Scenario> &scenarios();

} // namespace faintline

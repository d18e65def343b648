#include "analysis/WindowChoice.h"

#include <cmath>
#include <cstdio>

namespace faintline {

std::string windowChoiceWords(const WindowChoice &choice)
{
    const auto share = [&](std::size_t trial) {
        return std::to_string(std::lround(100.0 * choice.trials[trial].kept)) + " % of the energy along ";
    };
    const auto seconds = [&](std::size_t trial) {
        char text[32];
        std::snprintf(text, sizeof text, "%.4g s", choice.trials[trial].windowSeconds);
        return std::string(text);
    };
    const std::size_t chosen = choice.chosen;
    const std::string words = "window " + seconds(chosen);
    if (chosen < choice.automatic)
        return words + " chosen; one of " + seconds(chosen + 1) + " would follow " + share(chosen) + "its tracks";
    if (chosen > choice.automatic)
        return words + " chosen; it follows " + share(chosen - 1) + "the tracks of " + seconds(chosen - 1);
    return words + " (automatic)";
}

} // namespace faintline

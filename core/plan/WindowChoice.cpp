#include "plan/WindowChoice.h"

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
    std::string words = "window " + seconds(chosen);
    if (chosen < choice.automatic)
        words += " chosen; one of " + seconds(chosen + 1) + " would follow " + share(chosen) + "its tracks";
    else if (chosen > choice.automatic)
        words += " chosen; it follows " + share(chosen - 1) + "the tracks of " + seconds(chosen - 1);
    else
        words += " (automatic)";
    if (choice.fromOthers > 0)
        words += "; " + std::to_string(choice.fromOthers) + " signal" + (choice.fromOthers == 1 ? "" : "s")
                 + " from other windows";
    return words;
}

} // namespace faintline

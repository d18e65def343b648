#pragma once

#include "base/Field.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// The part of a recording that is looked at, as both programs' options name it: --from, --to, --low and --high. What
/// is left out is where the recording begins or ends.
struct PartOptions {
    std::optional<double> from; ///< s
    std::optional<double> to;   ///< s
    std::optional<double> low;  ///< Hz
    std::optional<double> high; ///< Hz

    void addTo(CLI::App &command)
    {
        command.add_option("--from", from, "Start of the part analysed, s");
        command.add_option("--to", to, "End of the part analysed, s");
        command.add_option("--low", low, "Lower edge of the band, Hz; without --high, up to the end of the spectrum");
        command.add_option("--high", high, "Upper edge of the band, Hz; without --low, from the start of the spectrum");
    }

    /// As settings, name=value.
    std::vector<std::string> assignments() const
    {
        constexpr double beyondHz = 1e12; // what any band ends before
        std::vector<std::string> result;
        if (from)
            result.push_back("selection.fromSeconds=" + formatNumber(*from));
        if (to)
            result.push_back("selection.toSeconds=" + formatNumber(*to));
        if (!low && !high)
            return result;
        result.push_back("selection.lowHz=" + formatNumber(low.value_or(-beyondHz)));
        result.push_back("selection.highHz=" + formatNumber(high.value_or(beyondHz)));
        return result;
    }
};

} // namespace faintline

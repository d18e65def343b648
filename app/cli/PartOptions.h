#pragma once

#include "base/Field.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// The analysed part of a recording, as options of both programs: --from, --to, --low and --high. By default it extends
/// to the limits of the recording.
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
        constexpr double beyondHz = 1e12; // beyond any band
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

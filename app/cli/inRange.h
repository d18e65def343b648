#pragma once

#include "base/Field.h"

#include <CLI/CLI.hpp>

#include <string>

namespace faintline {

/// Checks an option's number, in both programs: from `least` to `most`. NaN, which CLI::Range takes, is in no range.
inline CLI::Validator inRange(double least, double most)
{
    const std::string range = formatNumber(least) + " to " + formatNumber(most);
    const auto refusal = [=](const std::string &text) {
        const std::optional<double> value = parseNumber(text);
        return value && *value >= least && *value <= most ? std::string() : "must be a number from " + range;
    };
    return {refusal, range};
}

} // namespace faintline

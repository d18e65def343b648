#pragma once

#include "evaluate/sequential/simulate.h"
#include "reproduce/papers.h"

#include <array>
#include <limits>
#include <string>

namespace faintline {

// Shared by the parts of the reproduction of Grossi and Lops, one file per figure.

/// Standard deviations of the walks' steps, in cells; the last is the uniform law.
constexpr std::array<double, 5> walkDeviations{0.5, 1.0, 2.0, 5.0, std::numeric_limits<double>::infinity()};

std::string deviationName(double deviation);

/// A published number of stages with its standard error.
struct PublishedAsn {
    double value;
    double error;
};

/// A published number.
struct Published {
    double value;
    double error;    ///< standard error
    double rounding; ///< step of the last digit
};

/// Successes among independent trials.
struct TrialCount {
    Index successes;
    Index trials;
};

struct PublishedFrequency {
    double value;
    double trials;
    double rounding;
};

/// Standard error of a frequency; if none or all succeeded, as if one had not.
double frequencyError(double p, double trials);

/// Four standard errors of the difference, plus the rounding error.
double toleranceOf(double referenceError, double ourError, double rounding);

ReproducedCell measuredCell(std::string row, std::string column, const Estimate &ours, const Published &reference);
ReproducedCell exactCell(std::string row, std::string column, double ours, double reference, double tolerance);
ReproducedCell frequencyCell(std::string row, std::string column, const TrialCount &ours,
                             const PublishedFrequency &reference);

Index reducedTrials(Index full, const ReproduceOptions &options);

/// Formats a number in printf style, for a sentence.
std::string inFormat(const char *format, double value);

} // namespace faintline

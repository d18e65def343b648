#pragma once

#include "evaluate/reproduce/Reproduction.h"
#include "evaluate/sequential/simulate.h"

#include <array>
#include <limits>
#include <string>

namespace faintline {

// What the parts of Grossi's and Lops' reproduction (reproduceGrossi.h) share, one figure a file.

Reproducible grossiStages();       ///< Figure 2
Reproducible grossiTrajectories(); ///< Figure 3
Reproducible grossiRadar();        ///< Figure 4

/// Deviations of the walks' steps, in cells; the last is the uniform law.
constexpr std::array<double, 5> walkDeviations{0.5, 1.0, 2.0, 5.0, std::numeric_limits<double>::infinity()};

std::string deviationName(double deviation);

/// A number of stages as published, with its standard error.
struct PublishedAsn {
    double value;
    double error;
};

/// A number as published.
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

/// Standard error of a frequency; where none or all succeeded, that of one that did not.
double frequencyError(double p, double trials);

/// Four standard errors of the difference, and what rounding hides.
double toleranceOf(double referenceError, double ourError, double rounding);

ReproducedCell measuredCell(std::string row, std::string column, const Estimate &ours, const Published &reference);
ReproducedCell exactCell(std::string row, std::string column, double ours, double reference, double tolerance);
ReproducedCell frequencyCell(std::string row, std::string column, const TrialCount &ours,
                             const PublishedFrequency &reference);

Index reducedTrials(Index full, const ReproduceOptions &options);

/// A number in a sentence, by a format of printf.
std::string inFormat(const char *format, double value);

} // namespace faintline

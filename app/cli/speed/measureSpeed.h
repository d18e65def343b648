#pragma once

#include "app/cli/speed/SpeedKernel.h"
#include "base/RunContext.h"

#include <string>
#include <vector>

namespace faintline {

struct SpeedOptions {
    int rounds = 9;
    double secondsPerForm = 0.03; ///< per form and round, at least one run
};

/// Result for one kernel.
struct SpeedResult {
    std::string name;
    std::string title;
    std::string unit;

    struct Rate {
        std::string form;
        double perSecond = 0.0; ///< items
    };
    std::vector<Rate> rates;

    struct Ratio {
        SpeedGoal goal;
        double measured = 0.0;
        double low = 0.0; ///< quartiles of the rounds
        double high = 0.0;
    };
    std::vector<Ratio> ratios;

    struct Checked {
        std::string what;
        double largest = 0.0;
        double measured = 0.0;
    };
    std::vector<Checked> checks;
};

/// Runs a kernel's forms alternately, round by round, so that other load on the machine affects all of them, and takes
/// medians of the ratios within rounds. A single thread is timed in processor time, so that waiting does not count; two
/// threads compared with one are timed by the clock.
SpeedResult measureSpeed(const SpeedKernel &kernel, const SpeedOptions &options, const RunContext &context = {});

/// The widest vector instructions that both the processor and the program support.
std::string instructionSet();

std::string speedText(const SpeedResult &result);
std::string speedJson(const std::vector<SpeedResult> &results, const SpeedOptions &options);

} // namespace faintline

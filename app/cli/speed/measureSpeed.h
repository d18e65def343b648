#pragma once

#include "app/cli/speed/SpeedKernel.h"
#include "base/RunContext.h"

#include <string>
#include <vector>

namespace faintline {

struct SpeedOptions {
    int rounds = 9;
    double secondsPerForm = 0.03; ///< of each form in each round, at least one run
};

/// What came out for one kernel.
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

    bool meetsGoals() const;
};

/// Runs a kernel's forms in turns, round after round, so that whatever else the machine does meets all of them, and
/// takes medians of the ratios within rounds. Times are the processor's own for a single thread, so that waiting for it
/// does not count, and the clock's where two threads are compared with one.
SpeedResult measureSpeed(const SpeedKernel &kernel, const SpeedOptions &options, const RunContext &context = {});

/// The widest vector instructions that this processor has and the program was made for.
std::string instructionSet();

std::string speedText(const SpeedResult &result);
std::string speedJson(const std::vector<SpeedResult> &results, const SpeedOptions &options);

} // namespace faintline

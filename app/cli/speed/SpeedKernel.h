#pragma once

#include <functional>
#include <string>
#include <vector>

namespace faintline {

/// One way to do a kernel's work.
struct SpeedForm {
    std::string name;
    double items = 1.0; ///< of the kernel's unit, in one run
    int threads = 1;
    std::function<void()> run;
};

/// One time to be compared with another: time per item of `slower` over time per item of `faster`.
struct SpeedGoal {
    std::string faster;
    std::string slower;
    double ratio = 1.0; ///< at least this
};

/// A number that says whether the fast form may be compared at all, such as its largest error.
struct SpeedCheck {
    std::string what;
    double largest = 0.0;
    std::function<double()> measure;
};

/// An inner loop of the program and what it is compared with: the plain formula, array expressions, a sweep over the
/// same memory, a bare library call. The first form is the program's own, through the interface its callers use.
///
/// `make` allocates what the forms work on; they live as long as the answer and take it in turns, each going on where
/// it stopped.
struct SpeedKernel {
    std::string name;
    std::string title;
    std::string unit;
    std::vector<SpeedGoal> goals;
    std::function<std::vector<SpeedForm>()> make;
    std::vector<SpeedCheck> checks{};
};

/// All of them, in the order they are printed in. Goals are ratios on one machine in one run, so they say something on
/// any.
const std::vector<SpeedKernel> &speedKernels();

/// The kernels of a name, or of all names that begin with it and a hyphen; all for "all". Throws Error naming what
/// there is.
std::vector<SpeedKernel> speedKernels(const std::string &name);

} // namespace faintline

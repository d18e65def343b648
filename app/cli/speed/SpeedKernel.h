#pragma once

#include <functional>
#include <string>
#include <vector>

namespace faintline {

/// One implementation of a kernel.
struct SpeedForm {
    std::string name;
    double items = 1.0; ///< items per run, in the kernel's unit
    int threads = 1;
    std::function<void()> run;
};

/// A ratio of two times: time per item of `slower` over time per item of `faster`.
struct SpeedGoal {
    std::string faster;
    std::string slower;
    double ratio = 1.0; ///< required minimum
};

/// A precondition of the comparison, such as the largest error of the fast form.
struct SpeedCheck {
    std::string what;
    double largest = 0.0;
    std::function<double()> measure;
};

/// An inner loop of the program and its references: the plain formula, array expressions, a sweep over the same memory,
/// a bare library call. The first form is the program's own, called through its usual interface.
///
/// `make` allocates the data of the forms; they live as long as its result and run alternately, each continuing from
/// its last state.
struct SpeedKernel {
    std::string name;
    std::string title;
    std::string unit;
    std::vector<SpeedGoal> goals;
    std::function<std::vector<SpeedForm>()> make;
    std::vector<SpeedCheck> checks{};
};

/// All kernels, in the order of output. Goals are ratios within one run on one machine, so they are meaningful on any.
const std::vector<SpeedKernel> &speedKernels();

/// The kernels with a name, or whose names begin with it and a hyphen; all for "all". Throws Error listing the names.
std::vector<SpeedKernel> speedKernels(const std::string &name);

} // namespace faintline

#include "app/cli/speed/SpeedKernel.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <set>
#include <string>

using namespace faintline;

namespace {

/// A kernel's forms share what they work on: it is made when the first of them is wanted and goes when another kernel's
/// turn has come.
const SpeedForm &formOf(const SpeedKernel &kernel, const std::string &name)
{
    static const SpeedKernel *current = nullptr;
    static std::vector<SpeedForm> forms;
    if (current != &kernel) {
        forms.clear();
        forms = kernel.make();
        current = &kernel;
    }
    return *std::find_if(forms.begin(), forms.end(), [&](const SpeedForm &form) { return form.name == name; });
}

} // namespace

/// Every form that a goal names under Google Benchmark: `faintline-bench --benchmark_filter=recursion`.
int main(int argc, char **argv)
{
    for (const SpeedKernel &kernel : speedKernels()) {
        std::set<std::string> names;
        for (const SpeedGoal &goal : kernel.goals)
            names.insert({goal.faster, goal.slower});
        for (const std::string &name : names)
            benchmark::RegisterBenchmark((kernel.name + "/" + name).c_str(), [&kernel, name](benchmark::State &state) {
                const SpeedForm &form = formOf(kernel, name);
                for ([[maybe_unused]] auto turn : state)
                    form.run();
                state.SetItemsProcessed(state.iterations() * std::int64_t(form.items));
            })->UseRealTime();
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}

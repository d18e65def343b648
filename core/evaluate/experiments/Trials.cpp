#include "evaluate/experiments/Trials.h"

#include "base/parallel.h"

#include <iterator>
#include <mutex>

namespace faintline {

std::vector<RunOutcome> Trials::run(const std::vector<int> &runs, const RunContext &context, const RunSink &sink) const
{
    std::vector<RunOutcome> outcomes(runs.size());
    RunContext quiet;
    quiet.stop = context.stop;
    std::mutex guard;
    parallelFor(std::ssize(runs), context, "trying lines", [&] {
        return [&](Index i) {
            RunOutcome &outcome = outcomes[std::size_t(i)];
            outcome = outcomeOf(runs[std::size_t(i)], quiet);
            if (sink) {
                const std::lock_guard lock(guard);
                sink(outcome);
            }
        };
    });
    return outcomes;
}

} // namespace faintline

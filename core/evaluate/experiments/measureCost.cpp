#include "evaluate/experiments/measureCost.h"

#include "plan/chain.h"

#include <algorithm>
#include <ctime>

namespace faintline {

namespace {

    constexpr double enoughSeconds = 0.25;
    constexpr Index blockFrames = 32;

    double threadSeconds()
    {
        std::timespec now{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
    }

} // namespace

double measureCost(const Analysis &analysis, const RunContext &context)
{
    const Index cells = analysis.grid().size();
    const Index frames = analysis.time().count;
    const auto chain = makeChain(analysis, makePathDetector(analysis));
    std::vector<float> block;
    std::vector<float> scores(static_cast<std::size_t>(cells));
    Index done = 0;
    const double start = threadSeconds();
    double spent = 0.0;
    while (done < frames && spent < enoughSeconds) {
        context.checkpoint(spent / enoughSeconds, "measuring the cost");
        const Index count = std::min(blockFrames, frames - done);
        block.resize(std::size_t(count * cells));
        analysis.frames->read(done, count, block);
        for (Index i = 0; i < count; ++i)
            chain->update(done + i, std::span(block).subspan(std::size_t(i * cells), std::size_t(cells)), scores);
        done += count;
        spent = threadSeconds() - start;
    }
    return done == 0 ? 0.0 : spent / (double(done) * analysis.time().step) * 3600.0;
}

} // namespace faintline

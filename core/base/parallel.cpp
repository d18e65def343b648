#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace faintline {

void parallelFor(Index count, const RunContext &context, std::string_view what,
                 const std::function<std::function<void(Index)>()> &makeWorker)
{
    std::atomic<Index> next = 0;
    std::atomic<Index> done = 0;
    std::mutex guard;
    std::exception_ptr failure;
    const auto work = [&](bool reports) {
        try {
            const std::function<void(Index)> worker = makeWorker();
            for (Index item = next++; item < count; item = next++) {
                if (context.stop.stop_requested())
                    throw Cancelled();
                worker(item);
                ++done;
                if (reports)
                    context.checkpoint(static_cast<double>(done) / static_cast<double>(count), what);
            }
        } catch (...) {
            next = count;
            const std::lock_guard lock(guard);
            if (!failure)
                failure = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> others;
        for (Index i = 1; i < std::min<Index>(context.threads, count); ++i)
            others.emplace_back(work, false);
        work(true);
    }
    if (failure)
        std::rethrow_exception(failure);
}

} // namespace faintline

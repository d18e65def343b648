#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <list>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace faintline {

namespace {

    /// Polls a condition for about the time that waking a thread takes, before the caller goes to sleep.
    template <class Condition>
    void lookFor(Condition isSo)
    {
        const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(50);
        while (!isSo() && std::chrono::steady_clock::now() < end)
            std::this_thread::yield();
    }

    /// Threads that are reused between loops, because a short loop takes less time than starting a thread.
    class Helpers
    {
    public:
        /// Work that up to `wanted` helpers may join while its loop runs.
        struct Job {
            std::function<void()> work;
            Index wanted;
            std::atomic<Index> working = 0;
        };

        static Helpers &all()
        {
            static Helpers helpers;
            return helpers;
        }

        void offer(Job &job)
        {
            const std::lock_guard lock(m_guard);
            m_jobs.push_back(&job);
            m_wanted += job.wanted;
            try {
                while (std::ssize(m_threads) < job.wanted)
                    m_threads.emplace_back([this](const std::stop_token &stop) { help(stop); });
            } catch (const std::system_error &) {
                // Use the threads that exist; the caller can also work alone.
            }
            m_offered.notify_all();
        }

        /// Closes the job to further helpers and waits for those that joined.
        void end(Job &job)
        {
            {
                const std::lock_guard lock(m_guard);
                m_jobs.remove(&job);
                m_wanted -= job.wanted;
            }
            lookFor([&] { return job.working == 0; });
            std::unique_lock lock(m_guard);
            m_left.wait(lock, [&] { return job.working == 0; });
        }

    private:
        void help(const std::stop_token &stop)
        {
            std::unique_lock lock(m_guard);
            while (m_offered.wait(lock, stop, [this] { return m_wanted > 0; })) {
                Job &job = **std::find_if(m_jobs.begin(), m_jobs.end(), [](const Job *j) { return j->wanted > 0; });
                --job.wanted;
                --m_wanted;
                ++job.working;
                lock.unlock();
                job.work();
                lock.lock();
                --job.working;
                m_left.notify_all();
                lock.unlock();
                lookFor([this] { return m_wanted > 0; });
                lock.lock();
            }
        }

        std::mutex m_guard;
        std::condition_variable_any m_offered;
        std::condition_variable m_left;
        std::list<Job *> m_jobs;
        std::atomic<Index> m_wanted = 0;     ///< by all jobs
        std::vector<std::jthread> m_threads; // last, so that they stop before the other members are destroyed
    };

} // namespace

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
                    context.checkpoint(double(done) / double(count), what);
            }
        } catch (...) {
            next = count;
            const std::lock_guard lock(guard);
            if (!failure)
                failure = std::current_exception();
        }
    };
    Helpers::Job shared{[&] { work(false); }, std::min<Index>(context.threads, count) - 1};
    const bool isShared = shared.wanted > 0;
    if (isShared)
        Helpers::all().offer(shared);
    work(true);
    if (isShared)
        Helpers::all().end(shared);
    if (failure)
        std::rethrow_exception(failure);
}

} // namespace faintline

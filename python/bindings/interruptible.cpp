#include "bindings/interruptible.h"

#include "base/Field.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace faintline::python {

namespace py = pybind11;

namespace {

    constexpr std::chrono::milliseconds listeningInterval{100};

    /// Progress that the computing thread reports to the waiting one.
    class Line
    {
    public:
        void say(double fraction, std::string_view what)
        {
            const std::lock_guard lock(m_guard);
            m_news.emplace(fraction, what);
        }

        void hangUp()
        {
            const std::lock_guard lock(m_guard);
            m_isOver = true;
            m_ended.notify_one();
        }

        struct News {
            double fraction;
            std::string what;
            News(double f, std::string_view w) : fraction(f), what(w) {}
        };

        /// Waits for the end, but not long; answers what was said last, once.
        std::optional<News> listen(bool &isOver)
        {
            std::unique_lock lock(m_guard);
            isOver = m_ended.wait_for(lock, listeningInterval, [this] { return m_isOver; });
            return std::exchange(m_news, std::nullopt);
        }

    private:
        std::mutex m_guard;
        std::condition_variable m_ended;
        std::optional<News> m_news;
        bool m_isOver = false;
    };

    int threadsOf(int asked)
    {
        constexpr int most = 1024;
        if (asked < 0 || asked > most)
            throw Error("threads = " + std::to_string(asked),
                        "must lie in 1 … 1024, or be 0 for as many as the machine has");
        return asked > 0 ? asked : std::max(1, int(std::thread::hardware_concurrency()));
    }

    /// Tells Python what there is to tell; answers the exception that this raised.
    std::optional<py::error_already_set> tell(const py::object &progress, const std::optional<Line::News> &news)
    {
        if (PyErr_CheckSignals() != 0)
            return py::error_already_set();
        try {
            if (news && !progress.is_none())
                progress(news->fraction, news->what);
        } catch (const py::error_already_set &raised) {
            return raised;
        }
        return std::nullopt;
    }

} // namespace

void runInterruptibly(const RunOptions &options, const std::function<void(const RunContext &)> &work)
{
    Line line;
    RunContext context;
    context.threads = threadsOf(options.threads);
    context.progress = [&line](double fraction, std::string_view what) { line.say(fraction, what); };
    std::stop_source stop;
    context.stop = stop.get_token();

    std::exception_ptr failure;
    std::thread worker([&] {
        try {
            work(context);
        } catch (...) {
            failure = std::current_exception();
        }
        line.hangUp();
    });
    std::optional<py::error_already_set> raised;
    for (bool isOver = false; !isOver;) {
        std::optional<Line::News> news;
        {
            const py::gil_scoped_release released;
            news = line.listen(isOver);
        }
        if (!raised && (raised = tell(options.progress, news)))
            stop.request_stop();
    }
    worker.join();
    if (raised)
        throw py::error_already_set(*raised);
    if (failure)
        std::rethrow_exception(failure);
}

} // namespace faintline::python

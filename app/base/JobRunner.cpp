#include "app/base/JobRunner.h"

#include "base/files/keepNoHoles.h"

#include <QCoreApplication>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <new>
#include <utility>

namespace faintline {

namespace {

    constexpr std::chrono::milliseconds progressInterval(40);
    constexpr std::chrono::milliseconds longJob(500);
    constexpr std::chrono::milliseconds restAfterJob(300);

    int threadCount()
    {
        return int(std::max(1u, std::thread::hardware_concurrency()));
    }

} // namespace

JobRunner::JobRunner(QObject *parent) : QObject(parent)
{
    m_pause.setSingleShot(true);
    connect(&m_pause, &QTimer::timeout, this, &JobRunner::begin);
}

JobRunner::~JobRunner()
{
    m_thread.request_stop();
    {
        const std::lock_guard lock(m_mutex);
        m_request.job = {};
        m_request.stop.request_stop();
    }
    if (m_thread.joinable())
        m_thread.join();
}

void JobRunner::start(Job job, int pauseMs)
{
    m_next = std::move(job);
    m_pause.stop();
    pauseMs > 0 ? m_pause.start(pauseMs) : begin();
    m_isRunning = true;
    emit busyChanged(true);
}

void JobRunner::begin()
{
    discard();
    {
        const std::lock_guard lock(m_mutex);
        m_request = {m_newest, std::exchange(m_next, {}), {}};
        if (!std::exchange(m_isWorking, true))
            m_thread = std::jthread([this](const std::stop_token &quit) { work(quit); });
    }
    m_wake.notify_one();
}

void JobRunner::cancel()
{
    if (!m_isRunning)
        return;
    m_pause.stop();
    discard();
    end();
    emit cancelled();
}

void JobRunner::discard()
{
    ++m_newest;
    const std::lock_guard lock(m_mutex);
    m_request.stop.request_stop();
    m_request.job = {};
}

void JobRunner::end()
{
    m_isRunning = false;
    emit busyChanged(false);
}

void JobRunner::deliver(std::function<void()> part)
{
    post(m_current, std::move(part));
}

void JobRunner::work(const std::stop_token &quit)
{
    std::unique_lock lock(m_mutex);
    const auto isAsked = [this] { return bool(m_request.job); };
    // The C library keeps memory freed by a job's threads for those threads: 170 MiB for an hour of recording.
    bool owesMemory = false;
    for (;;) {
        if (!m_wake.wait_for(lock, quit, restAfterJob, isAsked)) {
            // Only now: freeing the replaced result would have kept its delivery waiting, and its memory is returned with
            // the rest.
            if (std::exchange(owesMemory, false) && !quit.stop_requested()) {
                lock.unlock();
                returnHoles();
                lock.lock();
                continue;
            }
            m_isWorking = false;
            return;
        }
        const auto begin = std::chrono::steady_clock::now();
        {
            const Request request = {m_request.number, std::exchange(m_request.job, {}), m_request.stop};
            lock.unlock();
            run(request);
        }
        owesMemory = owesMemory || std::chrono::steady_clock::now() - begin > longJob;
        lock.lock();
    }
}

void JobRunner::run(const Request &request)
{
    m_current = request.number;
    RunContext context;
    context.stop = request.stop.get_token();
    context.threads = threadCount();
    std::atomic<std::chrono::steady_clock::time_point> last{};
    context.progress = [this, &request, &last](double fraction, std::string_view what) {
        const auto now = std::chrono::steady_clock::now();
        if (now - last.load() < progressInterval)
            return;
        last = now;
        post(request.number, [this, fraction, text = QString::fromUtf8(what.data(), qsizetype(what.size()))] {
            emit progressed(fraction, text);
        });
    };

    const auto fail = [&](const Error &error) {
        post(request.number, [this, error] {
            if (m_pause.isActive()) // the next job is waiting
                return;
            end();
            emit failed(error);
        });
    };
    try {
        Delivery deliver = request.job(context);
        post(request.number, [this, number = request.number, deliver = std::move(deliver)] {
            m_isRunning = m_pause.isActive();
            deliver();
            if (number != m_newest || m_pause.isActive()) // a delivery may start the next job
                return;
            end();
            emit finished();
        });
    } catch (const Cancelled &) {
        post(request.number, [this] {
            if (m_pause.isActive())
                return;
            end();
            emit cancelled();
        });
    } catch (const Error &error) {
        fail(error);
    } catch (const std::bad_alloc &) {
        fail(Error("memory", "out of memory; analyse a shorter part of the recording", Error::Kind::Failure));
    } catch (const std::exception &error) {
        fail(Error("internal failure", error.what(), Error::Kind::Failure));
    }
}

void JobRunner::post(std::uint64_t number, std::function<void()> action)
{
    QMetaObject::invokeMethod(
        this,
        [this, number, action = std::move(action)] {
            if (number == m_newest)
                action();
        },
        Qt::QueuedConnection);
}

bool isBusy(const QObject &root)
{
    const QList<JobRunner *> runners = root.findChildren<JobRunner *>();
    return std::any_of(runners.begin(), runners.end(), [](const JobRunner *one) { return one->isRunning(); });
}

void settle(const QObject &root)
{
    while (isBusy(root))
        QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
}

} // namespace faintline

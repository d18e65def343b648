#pragma once

#include "base/Error.h"
#include "base/RunContext.h"

#include <QObject>
#include <QString>
#include <QTimer>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

namespace faintline {

/// Runs jobs on one worker thread, which exists while there is work; a new job replaces the previous one.
///
/// Starting a job asks the previous one to stop and discards its result. A job computes on the worker and returns its
/// delivery: a function that passes the result on in this object's thread, called only if no newer job was started and
/// none was cancelled. Exceptions of a job become a signal. The destructor stops the job and waits.
class JobRunner : public QObject
{
    Q_OBJECT

public:
    using Delivery = std::function<void()>;
    using Job = std::function<Delivery(const RunContext &context)>;

    explicit JobRunner(QObject *parent = nullptr);
    ~JobRunner() override;

    /// `pauseMs`: for so long the previous job goes on, and this one may be replaced before it begins.
    void start(Job job, int pauseMs = 0);
    void cancel();

    /// Called by a job on the worker to deliver a partial result; the job continues.
    void deliver(std::function<void()> part);

    /// From `start` until the newest job's end has been signalled.
    bool isRunning() const { return m_isRunning; }

signals:
    void busyChanged(bool isBusy); ///< true at each start, false before its end is signalled
    void progressed(double fraction, const QString &what);

    // Each started job that is not replaced by a newer one ends in exactly one of these.
    void finished();
    void cancelled();
    void failed(const faintline::Error &error);

private:
    struct Request {
        std::uint64_t number = 0;
        Job job;
        std::stop_source stop;
    };

    void begin();
    void discard();
    void work(const std::stop_token &quit);
    void run(const Request &request);
    void end();
    /// Calls `action` in this object's thread, unless a newer job was started by then.
    void post(std::uint64_t number, std::function<void()> action);

    std::uint64_t m_newest = 0;  ///< of this object's thread
    std::uint64_t m_current = 0; ///< of the worker: the job it runs
    bool m_isRunning = false;
    Job m_next; ///< begins after the pause
    QTimer m_pause;

    std::mutex m_mutex;
    std::condition_variable_any m_wake;
    Request m_request;        ///< guarded by m_mutex: the newest; its job is empty once taken
    bool m_isWorking = false; ///< guarded by m_mutex: whether the thread will look for a request once more
    std::jthread m_thread;    ///< last, so that it ends first
};

/// Whether a job runs of what `root` contains: of a runner that has it as an ancestor.
bool isBusy(const QObject &root);
/// Processes events until none does.
void settle(const QObject &root);

} // namespace faintline

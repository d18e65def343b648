#pragma once

#include "app/base/JobRunner.h"
#include "live/LiveHistory.h"

#include <QObject>
#include <QString>
#include <QTimer>

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>

namespace faintline {

/// Listens to a source on a worker thread and delivers views of the run about thirty times a second.
class LiveRun : public QObject
{
    Q_OBJECT

public:
    /// Opens the source; called on the worker. Throws Error, Cancelled.
    using OpenSource = std::function<std::unique_ptr<SampleSource>(const std::stop_token &)>;

    /// State of the run, apart from the pictures.
    struct State {
        std::optional<StreamFormat> format; ///< empty until the source has answered
        QString recording;                  ///< its metadata; at the end, the list if there are several files
        Index lostCount = 0;                ///< samples
        int gapCount = 0;
        double blockSeconds = 0.0; ///< of noise received before the first frame
        bool isStopping = false;
    };

    explicit LiveRun(QObject *parent = nullptr);
    ~LiveRun() override;

    void start(OpenSource open, const ListenSettings &settings);
    /// Stops soon, after writing and analysing what was received.
    void stop();
    /// Takes effect once calibrated.
    void change(const AnalysisSettings &settings);

    bool isRunning() const { return m_runner.isRunning(); }
    const State &state() const { return m_state; }

signals:
    void begun(); ///< the source has answered
    void grew(const faintline::LiveView &view);
    void noticed(const faintline::ListenNotice &notice);
    void failed(const faintline::Error &error);
    /// Always emitted last, even after `failed`.
    void ended();

private:
    /// State shared by the worker and the window's thread.
    struct Shared {
        std::mutex mutex;
        LiveHistory history;
        std::optional<AnalysisSettings> wish;
        bool hasGrown = false;
    };

    JobRunner::Delivery listenNow(const OpenSource &open, const ListenSettings &settings, Shared &shared,
                                  const RunContext &context);
    void deliver();
    void end();

    State m_state;
    std::stop_source m_stop;
    std::shared_ptr<Shared> m_shared;
    QTimer m_pull;
    JobRunner m_runner; ///< last, so that its job ends first
};

} // namespace faintline

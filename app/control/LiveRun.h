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

/// Listens to a source on a worker and hands over, some thirty times a second, what there is to be seen.
class LiveRun : public QObject
{
    Q_OBJECT

public:
    /// Makes the source, on the worker. Throws Error, Cancelled.
    using OpenSource = std::function<std::unique_ptr<SampleSource>(const std::stop_token &)>;

    /// What is known besides the pictures.
    struct State {
        std::optional<StreamFormat> format; ///< none: the source has not answered yet
        QString recording;                  ///< its metadata; in the end, of several files, their list
        Index lostCount = 0;                ///< samples
        int gapCount = 0;
        double blockSeconds = 0.0; ///< that are heard before the first frame
        bool isStopping = false;
    };

    explicit LiveRun(QObject *parent = nullptr);
    ~LiveRun() override;

    void start(OpenSource open, const ListenSettings &settings);
    /// Ends it soon: what was heard is written and analysed first.
    void stop();
    /// To be in force as soon as it is calibrated.
    void change(const AnalysisSettings &settings);

    bool isRunning() const { return m_runner.isRunning(); }
    const State &state() const { return m_state; }

signals:
    void begun(); ///< the source has answered
    void grew(const faintline::LiveView &view);
    void noticed(const faintline::ListenNotice &notice);
    void failed(const faintline::Error &error);
    /// Always the last one, after `failed` too.
    void ended();

private:
    /// What the worker and the window's thread share.
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

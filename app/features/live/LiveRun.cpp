#include "app/features/live/LiveRun.h"

#include "app/base/filePath.h"

namespace faintline {

namespace {

    constexpr int pullMs = 33;

    /// Whether sampleCount counts lost samples; otherwise it is a clock departure or seconds of disk space.
    bool isLoss(ListenNotice::Kind kind)
    {
        using Kind = ListenNotice::Kind;
        return kind == Kind::Lost || kind == Kind::Overflow || kind == Kind::Back;
    }

} // namespace

LiveRun::LiveRun(QObject *parent) : QObject(parent)
{
    m_pull.setInterval(pullMs);
    m_pull.setTimerType(Qt::PreciseTimer);
    connect(&m_pull, &QTimer::timeout, this, &LiveRun::deliver);
    connect(&m_runner, &JobRunner::finished, this, &LiveRun::end);
    connect(&m_runner, &JobRunner::cancelled, this, &LiveRun::end);
    connect(&m_runner, &JobRunner::failed, this, [this](const Error &error) {
        emit failed(error);
        end();
    });
}

LiveRun::~LiveRun()
{
    m_stop.request_stop();
}

void LiveRun::start(OpenSource open, const ListenSettings &settings)
{
    m_state = {};
    m_state.recording = pathText(settings.recordPath);
    m_stop = {};
    m_shared = std::make_shared<Shared>();
    m_pull.start();
    m_runner.start(
        [this, open = std::move(open), settings, shared = m_shared, stop = m_stop.get_token()](RunContext context) {
            context.stop = stop; // keep the result when stopped
            context.progress = {};
            return listenNow(open, settings, *shared, context);
        });
}

JobRunner::Delivery LiveRun::listenNow(const OpenSource &open, const ListenSettings &settings, Shared &shared,
                                       const RunContext &context)
{
    const std::unique_ptr<SampleSource> source = open(context.stop);
    const AnalysisSettings used = settingsForListening(settings.analysis, source->format());
    m_runner.deliver([this, format = source->format(), used] {
        m_state.format = format;
        m_state.blockSeconds = used.noise.blockWindows * used.spectrogram.windowSeconds;
        emit begun();
    });
    const auto tell = [&shared](const auto &what) {
        const std::lock_guard lock(shared.mutex);
        shared.history.take(what);
        shared.hasGrown = true;
    };
    ListenSinks sinks;
    sinks.event = [&](const EventChange &change, const AnalysisPlan &) { tell(change); };
    sinks.plan = [&](const AnalysisPlan &plan) { tell(plan); };
    sinks.frame = [&](const ListenFrame &frame) { tell(frame); };
    sinks.notice = [this](const ListenNotice &notice, const StreamFormat &) {
        m_runner.deliver([this, notice] {
            if (isLoss(notice.kind) && notice.sampleCount > 0) {
                m_state.lostCount += notice.sampleCount;
                ++m_state.gapCount;
            }
            emit noticed(notice);
        });
    };
    sinks.wish = [&shared] {
        const std::lock_guard lock(shared.mutex);
        return std::exchange(shared.wish, {});
    };
    sinks.recording = tell;
    const ListenResult result = listen(*source, settings, sinks, context);
    return [this, recording = result.recording] {
        if (!recording.empty())
            m_state.recording = pathText(recording);
    };
}

void LiveRun::stop()
{
    m_state.isStopping = isRunning();
    m_stop.request_stop();
}

void LiveRun::change(const AnalysisSettings &settings)
{
    if (!m_shared)
        return;
    const std::lock_guard lock(m_shared->mutex);
    m_shared->wish = settings;
}

/// Skips to the newest state, however slow the window is.
void LiveRun::deliver()
{
    LiveView view;
    {
        const std::lock_guard lock(m_shared->mutex);
        if (!std::exchange(m_shared->hasGrown, false))
            return;
        view = m_shared->history.view();
    }
    if (!view.isEmpty() && view.time.count > 0)
        emit grew(view);
}

void LiveRun::end()
{
    m_pull.stop();
    deliver();
    emit ended();
}

} // namespace faintline

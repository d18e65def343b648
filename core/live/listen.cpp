#include "live/listen.h"

#include "analysis/chain.h"
#include "analysis/plan.h"
#include "analysis/slopeUnit.h"
#include "base/Error.h"
#include "live/Hearing.h"
#include "live/StreamRecording.h"
#include "recording/endless.h"
#include "spectrum/CausalSpectrogram.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace faintline {

namespace {

    using Clock = std::chrono::steady_clock;

    constexpr std::chrono::milliseconds lastWork{250}; ///< for what was heard before a request to stop

    /// Frames that a stream of a format is cut into, before any of it is there.
    RecordingInfo endlessInfo(const StreamFormat &format)
    {
        RecordingInfo info;
        info.path = format.origin;
        info.sampleRateHz = format.sampleRateHz;
        info.sampleCount = endlessSamples;
        info.channelCount = format.channelCount;
        info.isComplex = format.type.isComplex;
        return info;
    }

    /// One run from its first block on.
    class Listening
    {
    public:
        Listening(SampleSource &source, const ListenSettings &settings, const ListenSinks &sinks,
                  const RunContext &context)
            : m_source(source), m_settings(settings), m_sinks(sinks), m_context(context), m_format(source.format()),
              m_buffer(std::make_shared<StreamBuffer>(m_format, bufferBytes())),
              m_hearing(source, *m_buffer, m_settings, context.stop, [this](ListenNotice notice) { tell(notice); })
        {
        }

        ListenResult run()
        {
            m_result.plan.settings = m_settings.analysis;
            try {
                if (makePlan())
                    analyse();
            } catch (const Cancelled &) { // before there was anything to analyse with
                m_result.isAnalysedToTheEnd = false;
            }
            m_hearing.finish();
            if (m_hearing.failure())
                std::rethrow_exception(m_hearing.failure());
            m_result.startUnixSeconds = m_hearing.startUnixSeconds();
            m_result.sampleCount = m_buffer->length();
            m_result.lostCount = m_hearing.lostCount();
            m_result.isRecordedWhole = m_hearing.isRecordedWhole();
            m_result.files = m_hearing.files();
            return std::move(m_result);
        }

    private:
        std::size_t bufferBytes() const
        {
            constexpr std::size_t blocks = 3;                    // the first is needed as a whole
            constexpr std::size_t enough = std::size_t(4) << 20; // of a source that waits
            const double samples = m_settings.analysis.spectrogram.windowSeconds * m_format.sampleRateHz
                                   * m_settings.analysis.noise.blockWindows;
            return std::max(m_source.isPatient() ? std::min(enough, m_settings.bufferBytes) : m_settings.bufferBytes,
                            blocks * std::size_t(samples) * std::size_t(m_format.frameBytes()));
        }

        void tell(const ListenNotice &notice)
        {
            const std::lock_guard lock(m_mutex);
            if (m_sinks.notice)
                m_sinks.notice(notice, m_format);
        }

        /// False where the stream ended before a window's length was there.
        bool makePlan()
        {
            AnalysisPlan &plan = m_result.plan;
            const AnalysisSettings &settings = plan.settings;
            const double window = settings.spectrogram.windowSeconds * m_format.sampleRateHz;
            if (m_buffer->isEnded() && double(m_buffer->length()) < std::floor(window))
                return false; // it was over at once: there is nothing to lay out frames over
            const auto endless = std::make_shared<StreamRecording>(m_buffer, std::nullopt);
            const Spectrogram geometry(endless, settings.spectrogram, settings.selection);
            // It takes seconds the first time: meanwhile the first block comes in.
            (void)calibrateBand(settings, geometry, m_context);
            const Index first = geometry.firstSample();
            m_buffer->waitFor(first + CausalSpectrogram::samplesOfFirstBlock(geometry, settings.noise));
            if (m_buffer->length() < first + geometry.windowSamples())
                return false;
            plan.recording = std::make_shared<StreamRecording>(m_buffer, m_hearing.startUnixSeconds());
            const auto spectrogram =
                std::make_shared<Spectrogram>(plan.recording, settings.spectrogram, settings.selection);
            normalisePlan(plan, spectrogram, m_context);
            calibratePlan(plan, m_context);
            return true;
        }

        void analyse()
        {
            const AnalysisPlan &plan = m_result.plan;
            const NormalisedFrames &frames = *plan.frames;
            const Spectrogram &spectrogram = *frames.spectrogram();
            const auto chain = makeChain(plan);
            const Index updateFrames = std::llround(m_settings.updateSeconds / frames.time().step);
            EventFollower follower(plan, *chain, updateFrames, [this](const EventChange &change) {
                const std::lock_guard lock(m_mutex);
                if (m_sinks.event)
                    m_sinks.event(change, m_result.plan);
            });
            std::vector<float> y(std::size_t(frames.grid().size()));
            std::vector<float> statistic(y.size());
            for (Index frame = 0; frame < frames.time().count; ++frame) {
                const Index first = spectrogram.firstSample() + frame * spectrogram.hopSamples();
                if (!m_buffer->waitFor(first + spectrogram.windowSamples()))
                    break;
                if (isLate()) {
                    m_result.isAnalysedToTheEnd = false;
                    break;
                }
                frames.read(frame, 1, y);
                chain->update(frame, y, statistic);
                follower.take(frame);
                m_buffer->release(first + spectrogram.hopSamples());
            }
            chain->finish();
            follower.finish();
            m_result.events = follower.finalEvents();
        }

        /// Whether a stop was asked for some time ago.
        bool isLate()
        {
            if (!m_context.stop.stop_requested())
                return false;
            if (!m_stopped)
                m_stopped = Clock::now();
            return Clock::now() - *m_stopped > lastWork;
        }

        const SampleSource &m_source;
        const ListenSettings &m_settings;
        const ListenSinks &m_sinks;
        const RunContext &m_context;
        StreamFormat m_format;
        ListenResult m_result;
        std::mutex m_mutex; ///< of the sinks
        std::optional<Clock::time_point> m_stopped;
        std::shared_ptr<StreamBuffer> m_buffer;
        Hearing m_hearing; ///< last: it begins at once
    };

} // namespace

AnalysisSettings settingsForListening(AnalysisSettings settings, const StreamFormat &format)
{
    settings.noise.causal = true;
    RecordingInfo hour = endlessInfo(format);
    hour.sampleCount = Index(std::llround(3600.0 * format.sampleRateHz));
    if (settings.spectrogram.windowSeconds == 0.0)
        settings.spectrogram.windowSeconds = Spectrogram::automaticWindowSeconds(hour);
    settings = withSlopesInBins(settings, hour);
    checkSettings(settings);
    return settings;
}

ListenResult listen(SampleSource &source, const ListenSettings &settings, const ListenSinks &sinks,
                    const RunContext &context)
{
    ListenSettings used = settings;
    used.analysis = settingsForListening(settings.analysis, source.format());
    return Listening(source, used, sinks, context).run();
}

} // namespace faintline

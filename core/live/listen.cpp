#include "live/listen.h"

#include "analyse/events.h"
#include "analyse/preparePlan.h"
#include "base/Error.h"
#include "live/Hearing.h"
#include "live/StreamBuffer.h"
#include "live/streamInfo.h"
#include "noise/CausalSpectrogram.h"
#include "plan/chain.h"
#include "plan/slopeUnit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>

namespace faintline {

namespace {

    using StopClock = std::chrono::steady_clock;

    constexpr std::chrono::milliseconds lastWork{250}; ///< for samples received before a stop request

    /// A run from its first block of noise on.
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

        ~Listening() { m_preparing.request_stop(); }
        Listening(const Listening &) = delete;
        Listening &operator=(const Listening &) = delete;

        ListenResult run()
        {
            m_result.plan.settings = m_settings.analysis;
            m_framesOf = m_settings.analysis.selection;
            try {
                if (makePlan())
                    analyse();
            } catch (const Cancelled &) { // before the analysis could start
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
            m_result.recording = m_hearing.whole();
            return std::move(m_result);
        }

    private:
        std::size_t bufferBytes() const
        {
            constexpr std::size_t patientBufferBytes = std::size_t(4) << 20; // for a source that can wait
            return std::max(m_source.isPatient() ? std::min(patientBufferBytes, m_settings.bufferBytes)
                                                 : m_settings.bufferBytes,
                            bytesFor(m_settings.analysis));
        }

        /// Settings need the whole first block.
        std::size_t bytesFor(const AnalysisSettings &settings) const
        {
            constexpr std::size_t blocks = 3;
            const double samples =
                settings.spectrogram.windowSeconds * m_format.sampleRateHz * settings.noise.blockWindows;
            return blocks * std::size_t(samples) * std::size_t(m_format.frameBytes());
        }

        void tell(const ListenNotice &notice)
        {
            const std::lock_guard lock(m_mutex);
            if (m_sinks.notice)
                m_sinks.notice(notice, m_format);
        }

        /// False if the stream ended before one window was complete.
        bool makePlan()
        {
            AnalysisPlan &plan = m_result.plan;
            const AnalysisSettings &settings = plan.settings;
            const double window = settings.spectrogram.windowSeconds * m_format.sampleRateHz;
            if (m_buffer->isEnded() && double(m_buffer->length()) < std::floor(window))
                return false; // the stream was empty, so there are no frames
            const auto endless = std::make_shared<StreamRecording>(m_buffer, std::nullopt);
            const Spectrogram geometry(endless, settings.spectrogram, settings.selection);
            // The first time this takes seconds, during which the first block arrives.
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
            tellRecording();
            return true;
        }

        void tellRecording()
        {
            const auto written = m_hearing.written();
            const std::lock_guard lock(m_mutex);
            if (written && m_sinks.recording)
                m_sinks.recording(written);
        }

        void analyse()
        {
            begin();
            for (Index frame = 0; frame < m_result.plan.time().count; ++frame) {
                if (m_sinks.wish)
                    frame = followWish(frame);
                const FrameGeometry geometry = m_result.plan.frames->geometry();
                if (!m_buffer->waitFor(geometry.endOf(frame)))
                    break;
                if (isLate()) {
                    m_result.isAnalysedToTheEnd = false;
                    break;
                }
                take(frame, geometry);
                m_buffer->release(geometry.beginOf(frame + 1));
            }
            if (m_prepared.valid() || (m_sinks.wish && m_sinks.wish()))
                tellTooLate();
            end();
            sortEvents(m_result.events);
        }

        /// Starts the plan's chain at the next frame.
        void begin()
        {
            const AnalysisPlan &plan = m_result.plan;
            m_chain = makeChain(plan);
            const Index updateFrames = std::llround(m_settings.updateSeconds / plan.time().step);
            m_follower.emplace(plan, *m_chain, updateFrames, [this](EventChange change) {
                m_lastId = std::max(m_lastId, m_idsBefore + change.event.id);
                change.event.id += m_idsBefore;
                if (change.partOf)
                    *change.partOf += m_idsBefore;
                const std::lock_guard lock(m_mutex);
                if (m_sinks.event)
                    m_sinks.event(change, m_result.plan);
            });
            tellPlan();
        }

        void end()
        {
            m_chain->finish();
            m_follower->finish();
            for (Event event : m_follower->finalEvents()) {
                event.id += m_idsBefore;
                m_result.events.push_back(std::move(event));
            }
            m_idsBefore = m_lastId;
        }

        void tellPlan()
        {
            const std::lock_guard lock(m_mutex);
            if (m_sinks.plan)
                m_sinks.plan(m_result.plan);
        }

        void take(Index frame, const FrameGeometry &geometry)
        {
            const Index end = geometry.endOf(frame);
            const NormalisedFrames &frames = *m_result.plan.frames;
            m_y.resize(std::size_t(frames.grid().size()));
            m_statistic.resize(m_y.size());
            frames.read(frame, 1, m_y);
            const bool isSilent =
                m_result.silentCount >= 0 && std::ranges::none_of(m_y, [](float y) { return y > 0.0f; });
            m_result.silentCount = isSilent ? end - geometry.firstSample : -1;
            m_chain->update(frame, m_y, m_statistic);
            m_follower->take(frame, m_y);
            const std::lock_guard lock(m_mutex);
            if (m_sinks.frame)
                m_sinks.frame(
                    {frame, m_y, m_statistic, *m_chain, m_buffer->heardAt(end), m_hearing.lostCount(), m_idsBefore});
        }

        /// Applies requested settings once calibrated. Returns the number of the next frame.
        Index followWish(Index frame)
        {
            if (const auto wish = m_sinks.wish()) {
                try {
                    prepare(settingsForListening(*wish, m_format));
                } catch (const Error &error) {
                    refuse(error);
                }
            }
            if (!m_prepared.valid() || m_prepared.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
                return frame;
            try {
                return goOnWith(m_prepared.get(), frame);
            } catch (const Error &error) {
                refuse(error);
                return frame;
            }
        }

        void refuse(const Error &error)
        {
            tell({ListenNotice::Kind::Refused, m_buffer->length(), 0,
                  std::string("Listening continues with the previous settings: ") + error.what()});
        }

        void tellTooLate()
        {
            tell({ListenNotice::Kind::Refused, m_buffer->length(), 0,
                  "Listening ended before the changed settings took effect; its events are those of the previous "
                  "settings."});
        }

        /// Calibrates new settings while the run continues; the first time this takes seconds. The newest request wins.
        void prepare(const AnalysisSettings &settings)
        {
            const auto endless = std::make_shared<StreamRecording>(m_buffer, std::nullopt);
            auto geometry = std::make_shared<Spectrogram>(endless, settings.spectrogram, settings.selection);
            m_preparing.request_stop();
            m_preparing = {};
            RunContext context = m_context;
            context.stop = m_preparing.get_token();
            m_prepared = std::async(std::launch::async, [settings, geometry, context] {
                (void)calibrateBand(settings, *geometry, context);
                return settings;
            });
        }

        Index goOnWith(const AnalysisSettings &settings, Index frame)
        {
            AnalysisPlan next = m_result.plan;
            AnalysisSettings sameFrames = settings;
            sameFrames.selection = next.settings.selection;
            if (m_framesOf == settings.selection && firstStale(next.settings, sameFrames) >= Stage::Detector) {
                next.settings = sameFrames;
                calibratePlan(next, m_context);
                changeChain(std::move(next));
                return frame;
            }
            next.settings = settings;
            // Frames start at the next sample.
            next.settings.selection.fromSeconds =
                double(next.frames->geometry().beginOf(frame)) / m_format.sampleRateHz;
            const auto spectrogram =
                std::make_shared<Spectrogram>(next.recording, settings.spectrogram, next.settings.selection);
            m_buffer->widen(bytesFor(next.settings));
            m_buffer->waitFor(spectrogram->firstSample()
                              + CausalSpectrogram::samplesOfFirstBlock(*spectrogram, settings.noise));
            if (m_buffer->length() < spectrogram->firstSample() + spectrogram->windowSamples()) {
                tellTooLate(); // the stream has ended in the meantime
                return frame;
            }
            normalisePlan(next, spectrogram, m_context);
            calibratePlan(next, m_context);
            end();
            m_framesOf = settings.selection;
            m_result.plan = std::move(next);
            begin();
            return 0;
        }

        /// A new threshold on the same chain keeps the tracks; any other change restarts the chain.
        void changeChain(AnalysisPlan next)
        {
            AnalysisSettings sameThreshold = next.settings;
            sameThreshold.decide = m_result.plan.settings.decide;
            const auto state = sameThreshold == m_result.plan.settings ? m_chain->state() : nullptr;
            if (!state) {
                end();
                m_result.plan = std::move(next);
                return begin();
            }
            m_result.plan = std::move(next);
            const auto chain = makeChain(m_result.plan);
            chain->setState(*state);
            *m_chain = std::move(*chain); // assigned in place: the follower refers to it
            tellPlan();
        }

        /// Whether a stop was requested some time ago.
        bool isLate()
        {
            if (!m_context.stop.stop_requested())
                return false;
            if (!m_stopped)
                m_stopped = StopClock::now();
            return StopClock::now() - *m_stopped > lastWork;
        }

        const SampleSource &m_source;
        const ListenSettings &m_settings;
        const ListenSinks &m_sinks;
        const RunContext &m_context;
        StreamFormat m_format;
        ListenResult m_result;
        std::mutex m_mutex; ///< guards the sinks
        std::optional<StopClock::time_point> m_stopped;
        SelectionSettings m_framesOf; ///< selection requested for the plan's frames
        std::unique_ptr<DetectionChain> m_chain;
        std::optional<EventFollower> m_follower;
        int m_lastId = 0;
        int m_idsBefore = 0; ///< event numbers used by earlier chains
        std::vector<float> m_y;
        std::vector<float> m_statistic;
        std::shared_ptr<StreamBuffer> m_buffer;
        Hearing m_hearing; ///< starts at once
        std::stop_source m_preparing;
        std::future<AnalysisSettings> m_prepared; ///< last: destroyed first
    };

} // namespace

AnalysisSettings settingsForListening(AnalysisSettings settings, const StreamFormat &format)
{
    settings.noise.causal = true;
    RecordingInfo hour = streamInfo(format);
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

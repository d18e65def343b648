#include "analysis/analyse.h"

#include "analysis/chain.h"
#include "analysis/knownCalibration.h"
#include "analysis/regulation.h"
#include "analysis/secondLook.h"
#include "analysis/usable.h"
#include "base/Checkpoints.h"
#include "base/logmath.h"
#include "base/memoryShares.h"
#include "spectrum/NoiseNormaliser.h"
#include "spectrum/glance.h"
#include "spectrum/pictureCuts.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>

namespace faintline {

namespace {

    constexpr std::size_t blockBytes = std::size_t(1) << 20;
    constexpr Index shortestInterval = 64; ///< of checkpoints, in frames

    /// Reads blocks of frames one ahead of their use, on another thread if there is one to spare.
    class FrameStream
    {
    public:
        FrameStream(const NormalisedFrames &frames, bool ahead)
            : m_frames(frames), m_ahead(ahead),
              m_blockFrames(std::max<Index>(1, static_cast<Index>(blockBytes / sizeof(float)) / std::max<Index>(1, frames.grid().size())))
        {
            if (m_ahead)
                prefetch();
        }

        Index position() const { return m_position; }

        /// The next block, empty at the end.
        std::vector<float> next()
        {
            if (m_position >= m_frames.time().count)
                return {};
            std::vector<float> block = m_ahead ? m_future.get() : read(m_position);
            m_position += std::ssize(block) / m_frames.grid().size();
            if (m_ahead && m_position < m_frames.time().count)
                prefetch();
            return block;
        }

    private:
        std::vector<float> read(Index first) const
        {
            const Index count = std::min(m_blockFrames, m_frames.time().count - first);
            std::vector<float> block(static_cast<std::size_t>(count * m_frames.grid().size()));
            m_frames.read(first, count, block);
            return block;
        }

        void prefetch()
        {
            m_future = std::async(std::launch::async, [this, first = m_position] { return read(first); });
        }

        const NormalisedFrames &m_frames;
        bool m_ahead;
        Index m_blockFrames;
        Index m_position = 0;
        std::future<std::vector<float>> m_future;
    };

    void countValues(std::span<const float> statistic, std::vector<double> &counts)
    {
        const auto last = static_cast<float>(counts.size() - 1);
        for (float value : statistic)
            counts[static_cast<std::size_t>(std::clamp(4.0f * (value + 4.0f), 0.0f, last))] += 1.0;
    }

    std::vector<std::shared_ptr<const PeakPyramid>> alongEachAxis(const PeakPyramid &picture, const Grid &grid)
    {
        std::vector<std::shared_ptr<const PeakPyramid>> result;
        for (std::size_t axis = 0; axis < grid.axes.size(); ++axis)
            result.push_back(pictureAlong(picture, grid, axis));
        return result;
    }

    /// Shows pictures of a recording that takes long, or has to wait for a calibration, and not so often that it takes longer.
    class Showing
    {
    public:
        Showing() = default;
        Showing(const PictureSink &sink, const Axis &time, const Axis &frequency, const AnalysisSettings &settings) : m_sink(sink)
        {
            constexpr double manyCells = 3e7;
            const bool isLong = static_cast<double>(time.count) * static_cast<double>(frequency.count) > manyCells;
            m_isWanted = sink && (isLong || !knownCalibration(settings));
            m_pictures.time = time;
            m_pictures.frequency = frequency;
        }

        void showGlance(std::shared_ptr<const Spectrogram> spectrogram, const NormaliserSettings &settings, const RunContext &context)
        {
            if (!m_isWanted)
                return;
            m_pictures.glance = glance(std::move(spectrogram), settings, context);
            m_sink(m_pictures);
        }

        void show(const std::shared_ptr<PeakPyramid> &input, const PeakPyramid &statistic)
        {
            const auto now = std::chrono::steady_clock::now();
            if (!m_isWanted || now - m_last < interval)
                return;
            m_last = now;
            m_pictures.input = input ? std::make_shared<const PeakPyramid>(input->soFar()) : nullptr;
            m_pictures.statistic = std::make_shared<const PeakPyramid>(statistic.soFar());
            m_sink(m_pictures);
        }

    private:
        static constexpr std::chrono::milliseconds interval{400};

        PictureSink m_sink;
        PicturesSoFar m_pictures;
        bool m_isWanted = false;
        std::chrono::steady_clock::time_point m_last{};
    };

    /// Frames between two checkpoints, at first: where tracks are followed they are larger, and lie farther apart.
    Index checkpointInterval(const Analysis &analysis)
    {
        const auto most = static_cast<Index>(memoryShares::checkpoints / bytesOfStates(analysis));
        const Index frames = analysis.time().count;
        return most > 0 ? std::max(shortestInterval, (frames + most - 1) / most) : std::max<Index>(frames, 1);
    }

    /// Streams the frames through the chain and fills in the rest of the analysis.
    void run(Analysis &analysis, const RunContext &context, const StatisticSink &sink, Showing &showing, AnalysisDepth depth = AnalysisDepth::Whole)
    {
        const NormalisedFrames &frames = *analysis.frames;
        const Index cells = frames.grid().size();
        const Index frameCount = frames.time().count;
        const bool hasSeveralAxes = frames.grid().axes.size() > 1;
        const bool isWhole = depth == AnalysisDepth::Whole;
        ConventionalTracker conventional(frames.grid(), analysis.settings.conventional);
        std::unique_ptr<Detector> detector = makeDetector(analysis);
        detector->useThreads(context.threads);
        const auto chain = makeChain(analysis, std::move(detector));

        const std::size_t pictureBytes =
            memoryShares::inTheEnd(memoryShares::picture, static_cast<std::size_t>(frameCount), static_cast<std::size_t>(cells));
        std::shared_ptr<PeakPyramid> input;
        std::shared_ptr<PeakPyramid> statistic;
        if (isWhole && !analysis.input)
            input = std::make_shared<PeakPyramid>(frames.time(), cells, ByteScale(ByteScale::Kind::PowerDb), pictureBytes);
        if (isWhole)
            statistic = std::make_shared<PeakPyramid>(frames.time(), cells, ByteScale(ByteScale::Kind::ScoreNats), pictureBytes);
        analysis.statisticCounts.assign(256, 0.0);
        Checkpoints<DetectionChain::Snapshot> checkpoints(checkpointInterval(analysis), memoryShares::checkpoints);
        std::vector<float> scores;
        FrameStream stream(frames, context.threads > 1);
        const RunContext detecting = context.part(0.0, 0.9);
        for (std::vector<float> block = stream.next(); !block.empty(); block = stream.next()) {
            const Index count = std::ssize(block) / cells;
            const Index first = stream.position() - count;
            detecting.checkpoint(static_cast<double>(first) / static_cast<double>(frameCount), "detecting");
            scores.resize(block.size());
            for (Index i = 0; i < count; ++i) {
                const auto offset = static_cast<std::size_t>(i * cells);
                if (isWhole && checkpoints.lacks(first + i))
                    if (auto state = chain->snapshot())
                        checkpoints.keep(first + i, state, DetectionChain::bytesOf(*state));
                chain->update(first + i, std::span(block).subspan(offset, static_cast<std::size_t>(cells)),
                             std::span(scores).subspan(offset, static_cast<std::size_t>(cells)));
                analysis.lnK.push_back(static_cast<float>(chain->detector().regulation().lnK));
                analysis.continuedFraction.push_back(static_cast<float>(chain->detector().regulation().continuedFraction));
                if (!hasSeveralAxes)
                    continue;
                analysis.inhibitions.push_back(chain->inhibitions());
                conventional.update(first + i, std::span(block).subspan(offset, static_cast<std::size_t>(cells)));
            }
            countValues(scores, analysis.statisticCounts);
            if (input)
                input->append(block);
            if (statistic) {
                statistic->append(scores);
                showing.show(input, *statistic);
            }
            if (sink)
                sink(first, scores);
        }
        checkpoints.forEach([&](Index frame, const auto &state) { analysis.checkpoints.push_back({frame, state}); });
        chain->finish();
        if (input) {
            input->finish();
            analysis.input = input;
        }
        if (statistic) {
            statistic->finish();
            analysis.statistic = statistic;
        }
        if (isWhole && hasSeveralAxes) {
            if (analysis.inputAlong.empty())
                analysis.inputAlong = alongEachAxis(*analysis.input, frames.grid());
            analysis.statisticAlong = alongEachAxis(*statistic, frames.grid());
        }
        analysis.tracks = looksTwice(analysis) ? lookTwice(analysis, chain->takeJoinedTracks(), context.part(0.9, 1.0)) : chain->takeJoinedTracks();
        analysis.conventional = conventional.tracks();
    }

    /// Least-squares slope of the track's position along an axis against time, per second.
    double driftOf(const Track &track, const Axis &time, const Grid &grid, std::size_t along)
    {
        const Axis &axis = grid.axes[along];
        const auto n = static_cast<double>(track.points.size());
        if (n < 2.0)
            return 0.0;
        double sumT = 0.0;
        double sumF = 0.0;
        double sumTT = 0.0;
        double sumTF = 0.0;
        double before = 0.0;
        const bool isLast = along + 1 == grid.axes.size();
        for (std::size_t i = 0; i < track.points.size(); ++i) {
            const TrackPoint &point = track.points[i];
            const double t = static_cast<double>(point.frame - track.points.front().frame) * time.step;
            double f = axis.value(isLast ? track.lastPosition(i, axis) : static_cast<double>(point.cell / grid.stride(along) % axis.count));
            if (axis.cyclic && i > 0) {
                const double turn = axis.step * static_cast<double>(axis.count);
                f += turn * std::round((before - f) / turn);
            }
            before = f;
            sumT += t;
            sumF += f;
            sumTT += t * t;
            sumTF += t * f;
        }
        return (n * sumTF - sumT * sumF) / (n * sumTT - sumT * sumT);
    }

    /// What only the look from both ends knows.
    void describe(Event &event, const Track &track, const Analysis &analysis)
    {
        const auto count = static_cast<double>(track.points.size());
        double level = 0.0;
        double band = 0.0;
        for (const SmoothedPoint &point : track.smoothed) {
            level += static_cast<double>(point.level) / count;
            band += static_cast<double>(point.high - point.low) / count;
        }
        event.snrDb = dbFromRatio(level);
        event.bandWidth = band * analysis.grid().axes.back().step;
        const double cellFrames = static_cast<double>(analysis.grid().size()) * static_cast<double>(analysis.time().count);
        event.noiseProbability = -std::expm1(-analysis.calibration->eventRateAt(event.statistic) * cellFrames);
    }

} // namespace

double statisticOf(const Track &track, const Analysis &analysis)
{
    return isScoreOfPaths(analysis.settings.detector) ? track.peakStatistic : track.detectStatistic;
}

std::vector<Event> events(const Analysis &analysis)
{
    return events(analysis, analysis.tracks);
}

std::vector<Event> events(const Analysis &analysis, const std::vector<Track> &tracks)
{
    const Axis &time = analysis.time();
    const Grid &grid = analysis.grid();
    std::vector<Event> result;
    for (const Track &track : tracks) {
        Event event;
        event.id = track.id;
        event.onsetSeconds = time.value(static_cast<double>(track.onsetFrame));
        event.detectSeconds = time.value(static_cast<double>(track.detectFrame));
        event.endSeconds = time.value(static_cast<double>(track.endFrame));
        const auto at = std::find_if(track.points.begin(), track.points.end(),
                                     [&](const TrackPoint &point) { return point.frame >= track.detectFrame; });
        const auto detection = static_cast<std::size_t>(std::min(at, track.points.end() - 1) - track.points.begin());
        event.position = track.positionOf(detection, grid);
        for (std::size_t axis = 0; axis < grid.axes.size(); ++axis)
            event.ratesPerSecond.push_back(driftOf(track, time, grid, axis));
        event.driftPerSecond = event.ratesPerSecond.back();
        event.model = track.model;
        event.statistic = statisticOf(track, analysis);
        event.isConfirmed = track.isConfirmed;
        event.isOpen = track.isOpen;
        if (!track.smoothed.empty())
            describe(event, track, analysis);
        result.push_back(std::move(event));
    }
    std::stable_sort(result.begin(), result.end(), [](const Event &a, const Event &b) {
        return a.onsetSeconds != b.onsetSeconds ? a.onsetSeconds < b.onsetSeconds : a.position < b.position;
    });
    return result;
}

std::shared_ptr<Analysis> analyse(RecordingPointer recording, const AnalysisSettings &settings, const RunContext &context,
                                  const Analysis *previous, const StatisticSink &sink, const PictureSink &pictures,
                                  CalibrationDepth calibrationDepth, AnalysisDepth depth)
{
    checkSettings(settings);
    auto analysis = std::make_shared<Analysis>();
    analysis->settings = settings;
    analysis->recording = recording;

    const bool sameRecording = previous && previous->recording == recording;
    const Stage stale = sameRecording ? firstStale(previous->settings, settings) : Stage::Spectrogram;
    Showing showing; // of what is computed anew: nobody takes away a picture for a part of the next one
    if (stale >= Stage::Detector) {
        analysis->frames = previous->frames;
        analysis->background = previous->background;
        analysis->input = previous->input;
    } else {
        const auto spectrogram = std::make_shared<Spectrogram>(recording, settings.spectrogram, settings.selection);
        showing = Showing(pictures, spectrogram->time(), spectrogram->frequency(), settings);
        showing.showGlance(spectrogram, settings.noise, context.part(0.0, 0.01));
        analysis->background = estimateBackground(*spectrogram, settings.noise, context.part(0.01, 0.2));
        checkUsable(*spectrogram, *analysis->background, context.part(0.2, 0.2));
        analysis->frames = std::make_shared<NormalisedSpectrogram>(spectrogram, analysis->background, settings.noise);
    }
    analysis->model = makeModel(settings.model, analysis->grid());
    analysis->calibration = calibrateBand(settings, analysis->grid().axes.back().count, context.part(0.2, 0.5), calibrationDepth);
    analysis->cellFramesPerHour = static_cast<double>(analysis->grid().size()) * 3600.0 / analysis->time().step;
    analysis->threshold = thresholdNats(settings.decide, *analysis->calibration, analysis->cellFramesPerHour);
    run(*analysis, context.part(0.5, 1.0), sink, showing, depth);
    return analysis;
}

namespace {

    std::shared_ptr<Analysis> analysisOf(NormalisedFramesPointer frames, const MarkovModel &model, const AnalysisSettings &settings)
    {
        checkSettings(settings);
        auto analysis = std::make_shared<Analysis>();
        analysis->settings = settings;
        analysis->frames = std::move(frames);
        analysis->model = model;
        analysis->cellFramesPerHour = static_cast<double>(analysis->grid().size()) * 3600.0 / analysis->time().step;
        return analysis;
    }

    /// Calibrates every model and shifts their statistics so that each crosses the threshold with the first one's probability.
    void calibrateBank(Analysis &analysis, const std::vector<MarkovModel> &models, const RunContext &context)
    {
        const auto count = static_cast<double>(models.size());
        for (std::size_t i = 0; i < models.size(); ++i)
            analysis.bank.push_back(
                {models[i],
                 calibrateOnIndependentCells(models[i], analysis.settings,
                                             context.part(static_cast<double>(i) / count, static_cast<double>(i + 1) / count)),
                 0.0});
        analysis.calibration = analysis.bank.front().calibration;
        analysis.threshold = thresholdNats(analysis.settings.decide, *analysis.calibration, analysis.cellFramesPerHour);
        const double pfa = analysis.calibration->exceedanceAt(analysis.threshold);
        for (BankMember &member : analysis.bank)
            member.offset = member.calibration->thresholdForPfa(pfa) - analysis.calibration->thresholdForPfa(pfa);
    }

    void regulateAndRun(Analysis &analysis, const RunContext &context, const Analysis *previous, const StatisticSink &sink)
    {
        const bool isSame = previous && previous->frames == analysis.frames;
        if (isSame) {
            analysis.input = previous->input;
            analysis.inputAlong = previous->inputAlong;
        }
        if (isSame && previous->settings.model == analysis.settings.model && previous->settings.detector == analysis.settings.detector)
            analysis.lnKBand = previous->lnKBand;
        else if (const auto *smd = std::get_if<SmdSettings>(&analysis.settings.detector))
            analysis.lnKBand = regulationBand(analysis.model, resetRule(*smd, analysis.calibration->lnK), context.part(0.0, 0.1));
        Showing nothing;
        run(analysis, context.part(0.1, 1.0), sink, nothing);
    }

    std::shared_ptr<const Analysis> analyseOneModel(NormalisedFramesPointer frames, const MarkovModel &model,
                                                    const AnalysisSettings &settings, const RunContext &context,
                                                    const Analysis *previous, const StatisticSink &sink)
    {
        const auto analysis = analysisOf(std::move(frames), model, settings);
        analysis->calibration = calibrateOnIndependentCells(model, settings, context.part(0.0, 0.5));
        analysis->threshold = thresholdNats(settings.decide, *analysis->calibration, analysis->cellFramesPerHour);
        regulateAndRun(*analysis, context.part(0.5, 1.0), previous, sink);
        return analysis;
    }

} // namespace

std::shared_ptr<const Analysis> analyse(NormalisedFramesPointer frames, const AnalysisSettings &settings, const RunContext &context,
                                        const Analysis *previous, const StatisticSink &sink)
{
    const std::vector<MarkovModel> models = makeModels(settings.model, frames->grid());
    if (models.size() == 1)
        return analyseOneModel(std::move(frames), models.front(), settings, context, previous, sink);
    if (!std::holds_alternative<SmdSettings>(settings.detector))
        throw Error("model.motion = bank", "is for the sequential Markov detector; choose detector.kind = smd");
    const auto analysis = analysisOf(std::move(frames), models.front(), settings);
    calibrateBank(*analysis, models, context.part(0.0, 0.5));
    regulateAndRun(*analysis, context.part(0.5, 1.0), previous, sink);
    return analysis;
}

std::shared_ptr<const Analysis> analyse(NormalisedFramesPointer frames, const MarkovModel &model, const AnalysisSettings &settings,
                                        const RunContext &context, const StatisticSink &sink)
{
    return analyseOneModel(std::move(frames), model, settings, context, nullptr, sink);
}

} // namespace faintline

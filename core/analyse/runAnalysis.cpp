#include "analyse/runAnalysis.h"

#include "analyse/ProgressPublisher.h"
#include "analyse/constants.h"
#include "analyse/preparePlan.h"
#include "analyse/regulation.h"
#include "base/memoryShares.h"
#include "frames/FrameStream.h"
#include "frames/pictureCuts.h"
#include "noise/NoiseNormaliser.h"
#include "plan/chain.h"
#include "refine/familyTracks.h"
#include "refine/numberByDetection.h"
#include "refine/ownNoiseLaw.h"
#include "refine/secondLook.h"
#include "refine/subtractLines.h"
#include "refine/trimEnds.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace faintline {

namespace {

    /// Counts successive values, which often are alike, in turns, so that none waits for the one before.
    void countValues(std::span<const float> statistic, std::vector<double> &counts)
    {
        constexpr std::size_t turns = 4;
        const auto last = float(counts.size() - 1);
        std::vector<std::uint32_t> own(turns * counts.size());
        for (std::size_t i = 0; i < statistic.size(); ++i)
            ++own[turns * std::size_t(int(std::clamp(4.0f * (statistic[i] + 4.0f), 0.0f, last))) + i % turns];
        for (std::size_t i = 0; i < own.size(); ++i)
            counts[i / turns] += double(own[i]);
    }

    /// Initial number of frames between checkpoints; they are larger, and farther apart, where tracks are followed.
    Index checkpointInterval(const Analysis &analysis)
    {
        const auto most = Index(memoryShares::checkpoints / bytesOfStates(analysis));
        const Index frames = analysis.time().count;
        return most > 0 ? std::max(fewestCheckpointFrames, (frames + most - 1) / most) : std::max<Index>(frames, 1);
    }

    /// Both pictures of a run, if they are wanted and do not exist yet.
    class RunPictures
    {
    public:
        RunPictures(Analysis &analysis, AnalysisDepth depth) : m_analysis(analysis)
        {
            if (depth != AnalysisDepth::Whole)
                return;
            if (!analysis.input)
                m_input = empty(ByteScale::Kind::PowerDb);
            m_statistic = empty(ByteScale::Kind::ScoreNats);
        }

        void append(std::span<const float> y, std::span<const float> statistic, ProgressPublisher &publisher)
        {
            if (m_input)
                m_input->append(y);
            if (!m_statistic)
                return;
            m_statistic->append(statistic);
            publisher.publish(m_input, *m_statistic);
        }

        void finish(ProgressPublisher &publisher)
        {
            if (m_input) {
                m_input->finish();
                m_analysis.input = m_input;
            }
            if (!m_statistic)
                return;
            m_statistic->finish();
            m_analysis.statistic = m_statistic;
            if (m_analysis.inputAlong.empty())
                m_analysis.inputAlong = alongEachAxis(m_analysis.input);
            m_analysis.statisticAlong = alongEachAxis(m_analysis.statistic);
            publisher.publishWhole(m_analysis.input, m_analysis.statistic);
        }

    private:
        std::shared_ptr<PeakPyramid> empty(ByteScale::Kind kind) const
        {
            const Index cells = m_analysis.grid().size();
            const std::size_t bytes =
                memoryShares::inTheEnd(memoryShares::picture, std::size_t(m_analysis.time().count), std::size_t(cells));
            return std::make_shared<PeakPyramid>(m_analysis.time(), cells, ByteScale(kind), bytes);
        }

        std::vector<std::shared_ptr<const PeakPyramid>>
        alongEachAxis(const std::shared_ptr<const PeakPyramid> &picture) const
        {
            const Grid &grid = m_analysis.grid();
            if (grid.isSpectrum())
                return {picture};
            std::vector<std::shared_ptr<const PeakPyramid>> result;
            for (std::size_t axis = 0; axis < grid.axes.size(); ++axis)
                result.push_back(pictureAlong(*picture, grid, axis));
            return result;
        }

        Analysis &m_analysis;
        std::shared_ptr<PeakPyramid> m_input;
        std::shared_ptr<PeakPyramid> m_statistic;
    };

    /// Reference results for sonar: each frame thresholded separately. Nothing is kept for frames on one axis.
    class PingProducts
    {
    public:
        explicit PingProducts(Analysis &analysis)
            : m_analysis(analysis), m_isWanted(!analysis.grid().isSpectrum()),
              m_conventional(analysis.grid(), analysis.settings.conventional)
        {
        }

        void take(Index frame, std::span<const float> y, const DetectionChain &chain)
        {
            if (!m_isWanted)
                return;
            m_analysis.inhibitions.push_back(chain.inhibitions());
            m_conventional.update(frame, y);
        }

        void finish() { m_analysis.conventional = m_conventional.tracks(); }

    private:
        Analysis &m_analysis;
        bool m_isWanted;
        ConventionalTracker m_conventional;
    };

    /// Replaces the chain's tracks by what remains once all of them are known, and adds the lines that were subtracted.
    void settleTracks(Analysis &analysis, const RunRequest &request, const std::vector<Track> &subtracted,
                      const RunContext &context)
    {
        if (looksTwice(analysis)) {
            SecondView view = analysis.firstView
                                  ? *std::exchange(analysis.firstView, {})
                                  : lookTwice(analysis, std::move(analysis.tracks), subtracted, context.part(0.0, 0.2));
            if (request.isTrial)
                analysis.firstView = std::make_shared<const SecondView>(view);
            else
                view = lookBehind(analysis, std::move(view), context.part(0.2, 0.5));
            analysis.tracks = std::move(view.tracks);
            analysis.tracks.insert(analysis.tracks.end(), subtracted.begin(), subtracted.end());
            if (analysis.settings.noise.causal)
                std::ranges::sort(analysis.tracks, {}, &Track::id);
            else
                numberByDetection(analysis.tracks);
            analysis.areas = joinAreas(std::move(view.areas));
            analysis.explainedByNoise = std::move(view.explainedByNoise);
        } else if (cutsOnly(analysis) && !request.isTrial) {
            analysis.tracks = cutToSignals(analysis, std::move(analysis.tracks), context.part(0.0, 0.5));
        }
        analysis.tracks = familiesOfTheirOwn(analysis, std::move(analysis.tracks), context.part(0.5, 0.6));
        if (!request.isTrial)
            holdAgainstOwnNoise(analysis, context.part(0.6, 1.0));
    }

    /// Streams the frames through the chain, and sets all of the analysis that does not need the tracks. Returns these.
    std::vector<Track> detectedTracks(Analysis &analysis, const RunContext &context, const RunRequest &request,
                                      ProgressPublisher &publisher)
    {
        const NormalisedFrames &frames = *analysis.frames;
        const auto cells = std::size_t(frames.grid().size());
        const auto frameCount = double(frames.time().count);
        std::unique_ptr<PathDetector> detector = makePathDetector(analysis, true);
        detector->useThreads(context.threads);
        const auto chain = makeChain(analysis, std::move(detector));

        RunPictures pictures(analysis, request.depth);
        PingProducts pings(analysis);
        const bool isWhole = request.depth == AnalysisDepth::Whole;
        if (isWhole) {
            analysis.statisticCounts.assign(256, 0.0);
            analysis.checkpoints = {checkpointInterval(analysis), memoryShares::checkpoints};
        }
        if (request.statisticBegins)
            request.statisticBegins(frames);
        FrameStream stream(frames, context.threads > 1);
        std::vector<float> statistic;
        for (std::vector<float> block = stream.next(); !block.empty(); block = stream.next()) {
            const Index first = stream.position() - Index(block.size() / cells);
            context.checkpoint(double(first) / frameCount, "detecting");
            statistic.resize(block.size());
            for (std::size_t at = 0; at < block.size();) {
                const Index frame = first + Index(at / cells);
                if (isWhole && analysis.checkpoints.lacks(frame))
                    if (auto state = chain->state())
                        analysis.checkpoints.keep(frame, state, state->bytes());
                std::size_t end = at + cells; // of the frames before the next checkpoint
                while (end < block.size() && !(isWhole && analysis.checkpoints.lacks(first + Index(end / cells))))
                    end += cells;
                const auto y = std::span<const float>(block).subspan(at, end - at);
                const Index taken = chain->updateSome(frame, y, std::span(statistic).subspan(at, y.size()));
                for (const PathDetector::Regulation &regulation : chain->regulations()) {
                    analysis.lnK.push_back(float(regulation.lnK));
                    analysis.continuedFraction.push_back(float(regulation.continuedFraction));
                }
                pings.take(frame, y.first(cells), *chain);
                at += std::size_t(taken) * cells;
            }
            if (isWhole)
                countValues(statistic, analysis.statisticCounts);
            pictures.append(block, statistic, publisher);
            if (request.statistic)
                request.statistic(first, statistic);
        }
        chain->finish();
        pictures.finish(publisher);
        pings.finish();
        return chain->takeJoinedTracks();
    }

    /// Over a causal background tracks keep the numbers of the chain, of which a listener may have told.
    void trim(Analysis &analysis)
    {
        if (analysis.settings.noise.causal)
            std::ranges::for_each(analysis.tracks, trimEnds);
        else
            analysis.tracks = withEndsTrimmed(std::move(analysis.tracks));
    }

    /// Sets the rest of the analysis. `subtracted`: lines that were removed before the frames were made.
    void run(Analysis &analysis, const RunContext &context, const RunRequest &request, ProgressPublisher &publisher,
             const std::vector<Track> &subtracted = {})
    {
        // The chain, which may be as large as all else, is gone when others search for more.
        analysis.tracks = detectedTracks(analysis, context.part(0.0, 0.9), request, publisher);
        settleTracks(analysis, request, subtracted, context.part(0.9, 1.0));
    }

    /// An unfinished recording has no length from which to choose a window.
    void checkWindow(const AnalysisSettings &settings)
    {
        if (settings.noise.causal && settings.spectrogram.windowSeconds == 0.0)
            throw fieldError("spectrogram.windowSeconds", "0",
                             "is chosen from the whole recording; with noise.causal=true, give the window in seconds");
    }

    /// The previous analysis if its frames of the recording (not of a remainder) can be reused.
    const Analysis *lender(const Analysis *previous, const RecordingPointer &recording)
    {
        if (!previous || previous->recording != recording)
            return nullptr;
        const Analysis &whole = previous->ofUnchanged();
        const Spectrogram *spectrogram = whole.frames->spectrogram();
        return spectrogram && spectrogram->recordingPointer() == recording ? &whole : nullptr;
    }

    /// Sends the frames of a recording through the chain, once.
    std::shared_ptr<Analysis> analyseAsItIs(const RecordingPointer &recording, const AnalysisSettings &settings,
                                            const RunContext &context, const Analysis *previous,
                                            const RunRequest &request)
    {
        const bool isTried =
            previous && previous->settings == settings && previous->firstView
            && (!previous->calibration->isFirstEstimate || request.calibration == CalibrationDepth::FirstEstimate);
        const bool hasPictures = request.depth != AnalysisDepth::Whole || (previous && previous->statistic);
        if (isTried && hasPictures && !request.statistic) { // the trial is completed
            auto completed = std::make_shared<Analysis>(*previous);
            settleTracks(*completed, request, {}, context);
            return completed;
        }
        auto analysis = std::make_shared<Analysis>();
        analysis->settings = settings;
        analysis->recording = recording;

        const Stage stale = previous ? firstStale(previous->settings, settings) : Stage::Spectrogram;
        ProgressPublisher publisher; // for new results: a picture is never replaced by part of the next one
        if (stale >= Stage::Detector) {
            analysis->lines = previous->lines;
            analysis->frames = previous->frames;
            analysis->background = previous->background;
            analysis->input = previous->input;
            analysis->inputAlong = previous->inputAlong;
        } else {
            const auto spectrogram = std::make_shared<Spectrogram>(recording, settings.spectrogram, settings.selection);
            publisher = ProgressPublisher(request.pictures, spectrogram->time(),
                                          familyAxis(settings.family, spectrogram->frequency()));
            if (settings.family.isNone())
                publisher.publishQuickLook(spectrogram, settings.noise, context.part(0.0, 0.01));
            normalisePlan(*analysis, spectrogram, context.part(0.01, 0.2));
        }
        if (isTried)
            analysis->firstView = previous->firstView;
        calibratePlan(*analysis, context.part(0.2, 0.5), request.calibration);
        run(*analysis, context.part(0.5, 1.0), request, publisher);
        return analysis;
    }

    /// The same for the remainder of the recording without the strong lines of a first run.
    std::shared_ptr<Analysis> analyseRest(std::shared_ptr<const Analysis> first, const std::vector<Track> &subtracted,
                                          const RunContext &context, const RunRequest &request)
    {
        const AnalysisSettings &settings = first->settings;
        auto analysis = std::make_shared<Analysis>();
        analysis->settings = settings;
        analysis->recording = first->recording;
        const RecordingPointer rest = restOf(*first, subtracted, context.part(0.0, 0.2));
        const auto spectrogram = std::make_shared<Spectrogram>(rest, settings.spectrogram, settings.selection);
        ProgressPublisher publisher(request.pictures, spectrogram->time(), spectrogram->frequency());
        normalisePlan(*analysis, spectrogram, context.part(0.2, 0.4));
        analysis->model = first->model; // for the same grid
        analysis->calibration = first->calibration;
        analysis->threshold = first->threshold;
        analysis->cellFramesPerHour = first->cellFramesPerHour;
        analysis->unsubtracted = std::move(first);
        run(*analysis, context.part(0.4, 1.0), request, publisher, subtracted);
        return analysis;
    }

    /// Subtracts lines and analyses the rest, if that is requested and there are any; otherwise the recording as it is.
    std::shared_ptr<Analysis> analyseWithRest(const RecordingPointer &recording, const AnalysisSettings &settings,
                                              const RunContext &context, const Analysis *lent,
                                              const RunRequest &request)
    {
        if (!settings.subtract.lines)
            return analyseAsItIs(recording, settings, context, lent, request);
        const bool isWhole = request.depth == AnalysisDepth::Whole;
        AnalysisRequest ofTracks{.calibration = request.calibration};
        ofTracks.depth = isWhole ? AnalysisDepth::Tracks : request.depth;
        std::shared_ptr<Analysis> first =
            analyseAsItIs(recording, settings, context.part(0.0, 0.4), lent, std::move(ofTracks));
        const std::vector<Track> strong = tracksToSubtract(*first);
        if (!strong.empty())
            return analyseRest(first, strong, context.part(0.4, 1.0), request);
        if (!isWhole && !request.statistic)
            return first;
        return analyseAsItIs(recording, settings, context.part(0.4, 1.0), first.get(), request);
    }

    std::shared_ptr<Analysis> analysisOf(NormalisedFramesPointer frames, const MarkovModel &model,
                                         const AnalysisSettings &settings)
    {
        checkSettings(settings);
        checkHasNoFamily(settings, "requires a recording; these are ready-made frames");
        checkHasOneChannel(settings, "requires a recording; these are ready-made frames");
        checkSubtractsNothing(settings, "requires a recording; these are ready-made frames");
        auto analysis = std::make_shared<Analysis>();
        analysis->settings = settings;
        analysis->frames = std::move(frames);
        analysis->model = model;
        analysis->cellFramesPerHour = double(analysis->grid().size()) * 3600.0 / analysis->time().step;
        return analysis;
    }

    void calibrateModel(Analysis &analysis, const RunContext &context)
    {
        analysis.calibration = calibrateOnIndependentCells(analysis.model, analysis.settings, context);
        analysis.threshold = thresholdNats(analysis.settings.decide, *analysis.calibration, analysis.cellFramesPerHour);
    }

    /// Calibrates each model and shifts their statistics so that all cross the threshold with the first one's
    /// probability.
    void calibrateBank(Analysis &analysis, const std::vector<MarkovModel> &models, const RunContext &context)
    {
        const auto count = double(models.size());
        for (std::size_t i = 0; i < models.size(); ++i)
            analysis.bank.push_back(
                {models[i],
                 calibrateOnIndependentCells(models[i], analysis.settings,
                                             context.part(double(i) / count, double(i + 1) / count)),
                 0.0});
        analysis.calibration = analysis.bank.front().calibration;
        analysis.threshold = thresholdNats(analysis.settings.decide, *analysis.calibration, analysis.cellFramesPerHour);
        const double pfa = analysis.calibration->exceedanceAt(analysis.threshold);
        for (BankMember &member : analysis.bank)
            member.offset = member.calibration->thresholdForPfa(pfa) - analysis.calibration->thresholdForPfa(pfa);
    }

    void regulateAndRun(Analysis &analysis, const RunRequest &request, const RunContext &context)
    {
        const Analysis *previous = request.previous;
        const bool isSame = previous && previous->frames == analysis.frames;
        if (isSame) {
            analysis.input = previous->input;
            analysis.inputAlong = previous->inputAlong;
        }
        if (isSame && previous->settings.model == analysis.settings.model
            && previous->settings.detector == analysis.settings.detector)
            analysis.lnKBand = previous->lnKBand;
        else if (const auto *smd = std::get_if<SmdSettings>(&analysis.settings.detector))
            analysis.lnKBand =
                regulationBand(analysis.model, resetRule(*smd, analysis.calibration->lnK), context.part(0.0, 0.1));
        ProgressPublisher publisher;
        if (analysis.grid().isSpectrum())
            publisher = ProgressPublisher(request.pictures, analysis.time(), analysis.grid().axes.back());
        run(analysis, context.part(0.1, 1.0), request, publisher);
        if (!request.isTrial)
            trim(analysis);
    }

} // namespace

std::shared_ptr<Analysis> runOnRecording(const RecordingPointer &recording, const AnalysisSettings &settings,
                                         const RunRequest &request, const RunContext &context)
{
    checkSettings(settings);
    checkWindow(settings);
    std::shared_ptr<Analysis> analysis =
        analyseWithRest(recording, settings, context, lender(request.previous, recording), request);
    if (!request.isTrial)
        trim(*analysis);
    return analysis;
}

std::shared_ptr<const Analysis> runOnFrames(NormalisedFramesPointer frames, const AnalysisSettings &settings,
                                            const RunRequest &request, const RunContext &context)
{
    const std::vector<MarkovModel> models =
        request.model ? std::vector{*request.model} : makeModels(settings.model, frames->grid());
    const bool isBank = models.size() > 1;
    if (isBank && !std::holds_alternative<SmdSettings>(settings.detector))
        throw fieldError("model.motion", "bank", "requires the sequential Markov detector; choose detector.kind = smd");
    const auto analysis = analysisOf(std::move(frames), models.front(), settings);
    if (isBank)
        calibrateBank(*analysis, models, context.part(0.0, 0.5));
    else
        calibrateModel(*analysis, context.part(0.0, 0.5));
    regulateAndRun(*analysis, request, context.part(0.5, 1.0));
    return analysis;
}

} // namespace faintline

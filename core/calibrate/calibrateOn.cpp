#include "calibrate/calibrateOn.h"

#include "calibrate/eventTail.h"
#include "calibrate/fitReset.h"
#include "calibrate/followTail.h"
#include "calibrate/noiseCounts.h"
#include "plan/chain.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <mutex>
#include <numeric>

namespace faintline {

namespace {

    constexpr int regulationFrames = 1500;
    constexpr int crowdedEverySegments = 10; ///< segments

    /// Number of segments for the first rough pass.
    int roughCountOf(int segmentCount)
    {
        return std::max(2, segmentCount / 10);
    }

    /// Calls work(number) for 0 … count-1, `threads` at a time, and take(result) in the order of the numbers, until it
    /// returns that it has enough.
    template <class Work, class Take>
    void inRounds(int count, const RunContext &context, Work work, Take take)
    {
        for (int done = 0; done < count;) {
            context.checkpoint(double(done) / count, "calibrating the threshold on noise");
            const int round = std::min(std::max(1, context.threads), count - done);
            std::vector<std::future<decltype(work(0))>> futures;
            futures.reserve(std::size_t(round));
            for (int i = 0; i < round; ++i)
                futures.push_back(std::async(round > 1 ? std::launch::async : std::launch::deferred,
                                             [&work, number = done + i] { return work(number); }));
            for (auto &future : futures)
                if (take(future.get()))
                    return;
            done += round;
        }
    }

    void fillExceedance(const std::vector<double> &counts, const StatisticLevels &levels, Calibration &result)
    {
        result.lowestLevel = double(levels.lowest);
        result.levelStep = double(levels.step);
        result.cells = std::accumulate(counts.begin(), counts.end(), 0.0);
        double above = result.cells;
        for (std::size_t i = 0; i < counts.size() && above > 0.0; ++i) {
            result.above.push_back(above);
            above -= counts[i];
        }
    }

    /// A chain for each threshold, null for the first one if it is left out: most events cross it, which costs most.
    std::vector<std::unique_ptr<DetectionChain>> chainsAt(const std::vector<double> &thresholds, AnalysisPlan plan,
                                                          bool isWithoutFirst)
    {
        std::vector<std::unique_ptr<DetectionChain>> chains;
        for (const double threshold : thresholds) {
            plan.threshold = threshold;
            const bool isLeftOut = isWithoutFirst && chains.empty();
            chains.push_back(isLeftOut ? nullptr : makeChain(plan, makePathDetector(plan), false));
        }
        return chains;
    }

} // namespace

NoiseSegments rememberedSegments(NoiseSegments noise)
{
    struct Made {
        std::once_flag once;
        NormalisedFramesPointer frames;
    };
    const auto made = std::make_shared<std::vector<Made>>(std::size_t(roughCountOf(noise.count)));
    const auto remembered = [segment = std::move(noise.segment), made](int number) {
        if (number >= std::ssize(*made))
            return segment(number);
        Made &own = (*made)[std::size_t(number)];
        std::call_once(own.once, [&] { own.frames = segment(number); });
        return own.frames;
    };
    return {remembered, noise.count};
}

std::shared_ptr<const Calibration> calibrateOn(const NoiseSegments &noise, const MarkovModel &model,
                                               const AnalysisSettings &settings, const CalibrationEffort &effort,
                                               const RunContext &context)
{
    // Plan of the chain, with thresholds still to be determined.
    AnalysisPlan trial;
    trial.settings = settings;
    trial.model = model;
    auto result = std::make_shared<Calibration>();
    result->isFirstEstimate = effort.isFirstEstimate;
    trial.calibration = result;
    context.checkpoint(0.0, "calibrating K on noise");
    const NormalisedFramesPointer firstSegment = noise.segment(0);
    const auto first = beginningOf(*firstSegment, settlingFrames + regulationFrames);
    const auto *chosen = std::get_if<SmdSettings>(&settings.detector);
    const SmdSettings smd = chosen ? *chosen : SmdSettings{};
    const ResetFit fit = fitReset({first}, model, smd);
    result->lnK = fit.lnK;
    result->continuedFraction = fit.continuedFraction;
    trial.frames = firstSegment;
    const StatisticLevels levels = statisticLevelsOf(*first, *makeDetector(trial));

    const int roughCount = roughCountOf(noise.count);
    NoiseTail rough;
    inRounds(
        roughCount, context.part(0.1, 0.2),
        [&](int number) { return measureTail(*noise.segment(number), *makeDetector(trial), levels); },
        [&](const NoiseTail &part) {
            add(part, rough);
            return false;
        });
    fillExceedance(rough.counts, levels, *result);
    const double cells = double(first->grid().size());
    const double columns = std::max(1.0, std::floor(cells / double(noiseBlockCells)));
    const RareRates rare = followTail(trial, effort, context.part(0.2, 0.4));
    if (effort.isFirstEstimate && rare.isEmpty())
        return nullptr; // a line through a fifth of the counts is too inaccurate
    const bool isInBlocks = framesPerDecision(settings.detector, frameGeometry(settings.spectrogram)) > 1;
    const TailShape shape = rare.isEmpty() ? TailShape::Line : isInBlocks ? TailShape::Blocks : TailShape::Followed;
    const std::vector<double> thresholds =
        thresholdsForEvents(std::move(rough.blockMaxima), double(noiseBlockFrames) * cells / columns,
                            rough.cellFrames / roughCount * noise.count, shape);
    EventCounts counts;
    inRounds(
        noise.count, context.part(0.4, 1.0),
        [&](int number) {
            AnalysisPlan own = trial;
            own.frames = noise.segment(number);
            const bool isWithoutFirst =
                !rare.isEmpty() && (effort.isFirstEstimate || number % crowdedEverySegments != 0);
            return countEvents(*own.frames, chainsAt(thresholds, own, isWithoutFirst));
        },
        [&](const EventCounts &part) {
            add(part, counts);
            return !rare.isEmpty() && counts.events.back() >= effort.enoughEvents;
        });
    result->excursions = rare;
    if (rare.isEmpty())
        fitEventRate(thresholds, counts.events, counts.cellFrames.front(), *result);
    else
        anchorTail(rare, thresholds, counts, *result);
    return result;
}

} // namespace faintline

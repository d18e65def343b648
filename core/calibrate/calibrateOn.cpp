#include "calibrate/calibrateOn.h"

#include "base/Error.h"
#include "calibrate/constants.h"
#include "calibrate/fitReset.h"
#include "calibrate/followTail.h"
#include "calibrate/noiseCounts.h"
#include "plan/Calibration.h"
#include "plan/chain.h"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <mutex>
#include <numeric>
#include <span>
#include <vector>

namespace faintline {

namespace {

    // Event rate as a function of the threshold, from counts at a few thresholds and from splitting.

    /// How the tail beyond the counted thresholds is known.
    enum class TailShape {
        Line,     ///< extrapolated
        Followed, ///< by splitting
        Blocks    ///< followed, of a detector that decides at the ends of blocks
    };

    /// Of block maxima, per cell and frame, from frequent ones on.
    std::span<const double> countedRates(TailShape shape)
    {
        switch (shape) {
        case TailShape::Line:
            return ratesOfLine;
        case TailShape::Blocks:
            return ratesOfBlocks;
        case TailShape::Followed:
            break;
        }
        return ratesBeforeSplitting;
    }

    /// Thresholds at which chains are expected to find events at about the wanted rates, from a rough analysis of the
    /// maxima of space-time blocks: P(max ≤ T) = exp(-Λ e^{-θ(T-u)}), with Λ and θ from two quantiles.
    std::vector<double> thresholdsForEvents(std::vector<float> maxima, double cellFramesPerBlock, double cellFrames,
                                            TailShape shape)
    {
        // A detector that decides in its own blocks leaves some of ours without a decision.
        const auto blocks = double(maxima.size());
        std::erase_if(maxima, [](float maximum) { return !std::isfinite(maximum); });
        if (maxima.size() < fewestTailMaxima)
            throw Error("detector", "decides too rarely to be calibrated on noise; choose a shorter window");
        std::sort(maxima.begin(), maxima.end());
        const double perMaximum = cellFramesPerBlock * blocks / double(maxima.size());
        const auto quantile = [&](double p) { return double(maxima[std::size_t(p * double(maxima.size()))]); };
        const double theta = std::log(std::log(lowerMaximaQuantile) / std::log(upperMaximaQuantile))
                             / std::max(1e-6, quantile(upperMaximaQuantile) - quantile(lowerMaximaQuantile));
        std::vector<double> thresholds;
        const bool isLine = shape == TailShape::Line;
        const double expected = isLine ? expectedTailMaxima / 3.0 : expectedTailMaxima;
        const double scale = std::max(1.0, expected / (ratesOfLine.front() * cellFrames));
        for (const double rate : countedRates(shape))
            thresholds.push_back(quantile(upperMaximaQuantile)
                                 + std::log(-std::log(upperMaximaQuantile) / perMaximum / (rate * scale)) / theta);
        return thresholds;
    }

    /// Fits ln(rate) = ln(rate at the anchor) - θ(T - anchor) to Poisson counts of events at several thresholds, by
    /// maximum likelihood.
    void fitEventRate(std::span<const double> thresholds, std::span<const double> events, double cellFrames,
                      Calibration &result)
    {
        const double total = std::accumulate(events.begin(), events.end(), 0.0);
        if (total < fewestTailEvents)
            throw Error("detector", "exceeds thresholds on noise too rarely to be calibrated");
        double anchor = 0.0; // where both parameters' errors are independent
        for (std::size_t i = 0; i < thresholds.size(); ++i)
            anchor += thresholds[i] * events[i] / total;
        const auto weights = [&](double theta) {
            std::vector<double> w;
            for (const double threshold : thresholds)
                w.push_back(std::exp(-theta * (threshold - anchor)));
            return w;
        };
        // With the rate at its best for each θ, the likelihood is that of a multinomial: Σ nᵢ ln(wᵢ/Σw), Σ nᵢ(Tᵢ -
        // anchor) = 0.
        const auto minusLogLikelihood = [&](double theta) {
            const std::vector<double> w = weights(theta);
            return total * std::log(std::accumulate(w.begin(), w.end(), 0.0));
        };
        const double range = *std::max_element(thresholds.begin(), thresholds.end())
                             - *std::min_element(thresholds.begin(), thresholds.end());
        const double theta = boost::math::tools::brent_find_minima(minusLogLikelihood, 0.0, 40.0 / range, 40).first;
        const std::vector<double> w = weights(theta);
        const double sum = std::accumulate(w.begin(), w.end(), 0.0);
        double variance = 0.0;
        for (std::size_t i = 0; i < thresholds.size(); ++i)
            variance += w[i] / sum * (thresholds[i] - anchor) * (thresholds[i] - anchor);
        result.anchorNats = anchor;
        result.tailSlope = theta;
        result.slopeError = 1.0 / std::sqrt(total * variance);
        result.relativeError = 1.0 / std::sqrt(total);
        result.eventRate = total / sum / cellFrames;
    }

    /// The tail of the chain's events: excursions, ln S(T), give the shape, the counts the height,
    ///
    ///   ln rate(T) = ln S(T) + δ(T)
    ///   δ = ln(events/noise) - ln S at the thresholds, linear between them, constant beyond
    void anchorTail(const RareRates &rare, std::span<const double> thresholds, const EventCounts &counts,
                    Calibration &result)
    {
        std::vector<double> levels; // with enough events, ascending
        std::vector<double> offsets;
        double events = 0.0;
        for (std::size_t i = 0; i < thresholds.size(); ++i) {
            if (counts.events[i] < fewestTailEvents)
                continue;
            events = counts.events[i];
            levels.push_back(thresholds[i]);
            offsets.push_back(std::log(events / counts.cellFrames[i]) - rare.lnRateAt(thresholds[i]));
        }
        if (levels.empty())
            throw Error("detector", "exceeds thresholds on noise too rarely to be calibrated");
        const auto offset = [&](double level) {
            const auto above = std::ranges::upper_bound(levels, level) - levels.begin();
            if (above == 0 || above == std::ssize(levels))
                return above == 0 ? offsets.front() : offsets.back();
            const auto i = std::size_t(above - 1);
            return std::lerp(offsets[i], offsets[i + 1], (level - levels[i]) / (levels[i + 1] - levels[i]));
        };
        const double anchor = levels.back();
        const double own = 1.0 / std::sqrt(events);
        const double known = rare.relativeErrorAt(anchor);
        std::vector<double> knots = rare.levels;
        knots.insert(knots.end(), levels.begin(), levels.end());
        std::sort(knots.begin(), knots.end());
        knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
        for (const double level : knots) {
            const double error = rare.relativeErrorAt(level);
            result.rates.levels.push_back(level);
            result.rates.lnRates.push_back(rare.lnRateAt(level) + offset(level));
            result.rates.relativeErrors.push_back(
                std::hypot(own, std::sqrt(std::max(0.0, error * error - known * known))));
        }
        const RareRates &rates = result.rates;
        const std::size_t before = knots.size() - std::min<std::size_t>(4, knots.size());
        result.anchorNats = anchor;
        result.eventRate = std::exp(rates.lnRateAt(anchor));
        result.relativeError = own;
        result.tailSlope = (rates.lnRates[before] - rates.lnRates.back()) / (knots.back() - knots[before]);
        result.slopeError = rates.relativeErrors.back() / std::max(1.0, knots.back() - anchor);
    }

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

} // namespace

NoiseSegments rememberedSegments(NoiseSegments noise)
{
    struct MadeSegment {
        std::once_flag once;
        NormalisedFramesPointer frames;
    };
    const auto made = std::make_shared<std::vector<MadeSegment>>(std::size_t(roughCountOf(noise.count)));
    const auto remembered = [segment = std::move(noise.segment), made](int number) {
        if (number >= std::ssize(*made))
            return segment(number);
        MadeSegment &own = (*made)[std::size_t(number)];
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
            const bool onlyAtLast = !rare.isEmpty() && (effort.isFirstEstimate || number % crowdedEverySegments != 0);
            return countEvents(own, thresholds, onlyAtLast);
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

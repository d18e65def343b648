#include "refine/calls.h"

#include "refine/constants.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <ranges>
#include <utility>

namespace faintline {

namespace {

    /// The ratios above 1 of two numbers up to the highest overtone.
    std::vector<double> overtoneRatios()
    {
        std::vector<double> ratios;
        for (int lower = 1; lower <= highestOvertone; ++lower)
            for (int upper = lower + 1; upper <= highestOvertone; ++upper)
                if (std::gcd(lower, upper) == 1)
                    ratios.push_back(double(upper) / lower);
        return ratios;
    }

    class Overtones
    {
    public:
        explicit Overtones(const AnalysisPlan &plan)
            : m_axis(plan.grid().axes.back()), m_ratios(overtoneRatios()), m_sure(plan.sureStatistic())
        {
        }

        bool areOfOneVoice(const Track &one, const Track &other) const
        {
            const Index first = std::max(one.onsetFrame, other.onsetFrame);
            if (first > std::min(one.endFrame, other.endFrame))
                return false;
            const bool isLower = one.positionAt(first) < other.positionAt(first);
            const std::vector<Together> frames = isLower ? framesOf(one, other) : framesOf(other, one);
            return !frames.empty() && evidence(frames) >= m_sure;
        }

    private:
        /// Two tracks in a frame in which both are present, Hz.
        struct Together {
            double frame = 0.0;
            double lower = 0.0;
            double upper = 0.0;
            double lowerVariance = 0.0;
            double upperVariance = 0.0;
        };

        std::vector<Together> framesOf(const Track &lower, const Track &upper) const
        {
            std::vector<Together> frames;
            const Index end = std::min(lower.endFrame, upper.endFrame);
            const auto variance = [&](const SmoothedPoint &point) {
                return std::pow(point.deviation() * m_axis.step, 2.0);
            };
            for (Index frame = std::max(lower.onsetFrame, upper.onsetFrame); frame <= end; ++frame)
                if (lower.isPresent(lower.pointIndex(frame)) && upper.isPresent(upper.pointIndex(frame)))
                    frames.push_back({double(frame), m_axis.value(lower.positionAt(frame)),
                                      m_axis.value(upper.positionAt(frame)), variance(lower.smoothedAt(frame)),
                                      variance(upper.smoothedAt(frame))});
            return frames;
        }

        double nearestRatio(const std::vector<Together> &frames) const
        {
            double product = 0.0;
            double square = 0.0;
            for (const Together &frame : frames) {
                product += frame.lower * frame.upper;
                square += frame.lower * frame.lower;
            }
            return *std::ranges::min_element(m_ratios, {}, [ratio = product / std::max(square, 1e-300)](double each) {
                return std::abs(std::log(each / ratio));
            });
        }

        /// The logarithm of the Bayes factor in callsOf.
        double evidence(const std::vector<Together> &frames) const
        {
            const double ratio = nearestRatio(frames);
            double sum = 0.0; // of weights, from here on
            double sumT = 0.0;
            double sumTT = 0.0;
            double sumF = 0.0;
            double sumTF = 0.0;
            double sumFF = 0.0;
            double apart = 0.0;
            const Together &first = frames.front();
            for (const Together &at : frames) {
                const double weight = 1.0 / (at.upperVariance + ratio * ratio * at.lowerVariance);
                const double t = at.frame - first.frame;
                const double f = at.upper - first.upper;
                sum += weight;
                sumT += weight * t;
                sumTT += weight * t * t;
                sumF += weight * f;
                sumTF += weight * t * f;
                sumFF += weight * f * f;
                apart += weight * std::pow(at.upper - ratio * at.lower, 2.0);
            }
            const double spread = sumTT - sumT * sumT / sum;
            const double slope = spread > 0.0 ? (sumTF - sumT * sumF / sum) / spread : 0.0;
            const double moved = std::max(0.0, sumFF - sumF * sumF / sum - slope * slope * spread);
            const double count = double(frames.size());
            const double band = m_axis.step * double(m_axis.count);
            const double error = std::sqrt(correlatedFrames / sum);
            return std::log(band / (error * std::sqrt(2.0 * std::numbers::pi)))
                   + std::max(0.0, 0.5 * count / correlatedFrames - 1.0) * std::log1p(moved / count)
                   - 0.5 * apart / correlatedFrames - std::log(double(m_ratios.size()));
        }

        const Axis &m_axis;
        std::vector<double> m_ratios;
        double m_sure; ///< nat
    };

} // namespace

std::vector<int> callsOf(const std::vector<Track> &tracks, const AnalysisPlan &plan)
{
    std::vector<int> calls(tracks.size(), 0);
    const AnalysisSettings &settings = plan.settings;
    if (!plan.grid().isSpectrum() || plan.grid().axes.back().value(0.0) < 0.0 || !settings.family.isNone()
        || settings.noise.causal || !std::ranges::all_of(tracks, &Track::hasSecondPass))
        return calls;
    const Overtones overtones(plan);
    std::vector<std::size_t> strongestFirst(tracks.size());
    std::iota(strongestFirst.begin(), strongestFirst.end(), std::size_t(0));
    std::ranges::stable_sort(strongestFirst, std::greater<>(), [&](std::size_t i) { return tracks[i].peakStatistic; });
    for (auto leader = strongestFirst.begin(); leader != strongestFirst.end(); ++leader) {
        if (calls[*leader] != 0)
            continue;
        for (const std::size_t other : std::ranges::subrange(leader + 1, strongestFirst.end()))
            if (calls[other] == 0 && overtones.areOfOneVoice(tracks[*leader], tracks[other]))
                calls[*leader] = calls[other] = tracks[*leader].id;
    }
    return calls;
}

} // namespace faintline

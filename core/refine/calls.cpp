#include "refine/calls.h"

#include "refine/constants.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <ranges>
#include <utility>

namespace faintline {

namespace {

    constexpr Index mostComparedFrames = 512; ///< of two tracks, at even intervals: the time for a pair is bounded

    /// A ratio of two overtones, and ln P of it.
    struct OvertoneRatio {
        double value;
        double lnShare;
    };

    std::vector<OvertoneRatio> overtoneRatios()
    {
        std::vector<OvertoneRatio> ratios;
        double sum = 0.0;
        for (int lower = 1; lower <= highestOvertone; ++lower)
            for (int upper = lower + 1; upper <= highestOvertone; ++upper)
                if (std::gcd(lower, upper) == 1) {
                    ratios.push_back({double(upper) / lower, -std::log(double(lower * upper))});
                    sum += 1.0 / double(lower * upper);
                }
        for (OvertoneRatio &ratio : ratios)
            ratio.lnShare -= std::log(sum);
        return ratios;
    }

    class Overtones
    {
    public:
        explicit Overtones(const Axis &axis) : m_axis(axis), m_ratios(overtoneRatios()) {}

        /// E of callsOf; nothing if the two are never present together.
        std::optional<double> evidence(const Track &one, const Track &other) const
        {
            const Index first = std::max(one.onsetFrame, other.onsetFrame);
            if (first > std::min(one.endFrame, other.endFrame))
                return {};
            const bool isLower = one.positionAt(first) < other.positionAt(first);
            Together both = isLower ? framesOf(one, other) : framesOf(other, one);
            return both.time.empty() ? std::nullopt : std::optional(evidence(std::move(both)));
        }

    private:
        /// Two tracks in frames in which both are present, Hz.
        struct Together {
            std::vector<double> time; ///< frames
            std::vector<double> lower;
            std::vector<double> upper;
            double lowerVariance = 0.0; ///< of one position
            double upperVariance = 0.0;
            double independent = 0.0; ///< frames with errors each their own
        };

        /// A straight line through values over time, and the deviations from it.
        struct StraightLine {
            double mean = 0.0;
            double slope = 0.0;
            std::vector<double> rest;
        };

        Together framesOf(const Track &lower, const Track &upper) const
        {
            Together both;
            const auto variance = [&](const SmoothedPoint &point) {
                return std::pow(point.deviation() * m_axis.step, 2.0);
            };
            const Index first = std::max(lower.onsetFrame, upper.onsetFrame);
            const Index end = std::min(lower.endFrame, upper.endFrame);
            const Index step = 1 + (end - first) / mostComparedFrames;
            for (Index frame = first; frame <= end; frame += step)
                if (lower.isPresent(lower.pointIndex(frame)) && upper.isPresent(upper.pointIndex(frame))) {
                    both.time.push_back(double(frame));
                    both.lower.push_back(m_axis.value(lower.positionAt(frame)));
                    both.upper.push_back(m_axis.value(upper.positionAt(frame)));
                    both.lowerVariance += variance(lower.smoothedAt(frame));
                    both.upperVariance += variance(upper.smoothedAt(frame));
                }
            both.lowerVariance /= double(both.time.size());
            both.upperVariance /= double(both.time.size());
            both.independent = double(both.time.size()) * std::min(1.0, double(step) / correlatedFrames);
            return both;
        }

        const OvertoneRatio &nearestRatio(double ratio) const
        {
            return *std::ranges::min_element(
                m_ratios, {}, [ratio](const OvertoneRatio &each) { return std::abs(std::log(each.value / ratio)); });
        }

        static double meanProduct(const std::vector<double> &a, const std::vector<double> &b)
        {
            return std::inner_product(a.begin(), a.end(), b.begin(), 0.0) / double(a.size());
        }

        /// `time`: of mean 0; `spread`: its mean square.
        static StraightLine lineThrough(const std::vector<double> &time, double spread,
                                        const std::vector<double> &values)
        {
            StraightLine line;
            line.mean = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
            line.slope = spread > 0.0 ? meanProduct(time, values) / spread : 0.0;
            for (std::size_t i = 0; i < values.size(); ++i)
                line.rest.push_back(values[i] - line.mean - line.slope * time[i]);
            return line;
        }

        /// Twice ln p of deviations of mean square `found`, for the most likely variance of at least `least`.
        static double ownFit(double found, double least)
        {
            const double variance = std::max(found, least);
            return -std::log(variance) - found / variance;
        }

        double evidence(Together both) const
        {
            const auto count = double(both.time.size());
            const double middle = std::accumulate(both.time.begin(), both.time.end(), 0.0) / count;
            for (double &time : both.time)
                time -= middle;
            const double spread = meanProduct(both.time, both.time);
            const StraightLine f = lineThrough(both.time, spread, both.lower);
            const StraightLine g = lineThrough(both.time, spread, both.upper);
            if (f.mean <= 0.0)
                return -std::numeric_limits<double>::infinity();
            const auto [ratio, lnShare] = nearestRatio(g.mean / f.mean);
            const double variance =
                (both.upperVariance + ratio * ratio * both.lowerVariance) / both.independent; // of g - ρ·f
            const auto square = [](double value) { return value * value; };
            const double place =
                std::log(m_axis.step * double(m_axis.count) / std::sqrt(2.0 * std::numbers::pi * variance))
                - 0.5 * square(g.mean - ratio * f.mean) / variance;
            const double slope = 0.5 * std::log1p(square(g.slope) * spread / variance)
                                 - 0.5 * square(g.slope - ratio * f.slope) * spread / variance;
            const double ff = meanProduct(f.rest, f.rest);
            const double fg = meanProduct(f.rest, g.rest);
            const double gg = meanProduct(g.rest, g.rest);
            const auto together = [&](double common) { // twice ln p, if the movement of f has this variance
                const double a = common + both.lowerVariance;
                const double b = ratio * common;
                const double c = ratio * ratio * common + both.upperVariance;
                const double determinant = a * c - b * b;
                return -std::log(determinant) - (c * ff - 2.0 * b * fg + a * gg) / determinant;
            };
            const double common = std::max(together(0.0), together(std::max(0.0, fg / ratio)));
            const double apart = ownFit(ff, both.lowerVariance) + ownFit(gg, both.upperVariance);
            return place + slope + std::max(0.0, 0.5 * both.independent - 1.0) * (common - apart) + lnShare;
        }

        const Axis &m_axis;
        std::vector<OvertoneRatio> m_ratios;
    };

} // namespace

std::vector<int> callsOf(const std::vector<Track> &tracks, const AnalysisPlan &plan)
{
    std::vector<int> calls(tracks.size(), 0);
    const bool hasOvertones = plan.grid().isSpectrum() && plan.grid().axes.back().value(0.0) >= 0.0;
    if (!hasOvertones || plan.settings.noise.causal || !std::ranges::all_of(tracks, &Track::hasSecondPass))
        return calls;
    const Overtones overtones(plan.grid().axes.back());
    const double sure = std::log(double(tracks.size())) + sureMarginNats;
    std::vector<std::size_t> strongestFirst(tracks.size());
    std::iota(strongestFirst.begin(), strongestFirst.end(), std::size_t(0));
    std::ranges::stable_sort(strongestFirst, std::greater<>(), [&](std::size_t i) { return tracks[i].peakStatistic; });
    for (auto leader = strongestFirst.begin(); leader != strongestFirst.end(); ++leader) {
        if (calls[*leader] != 0)
            continue;
        std::vector<std::pair<std::size_t, double>> together;
        for (const std::size_t other : std::ranges::subrange(leader + 1, strongestFirst.end()))
            if (calls[other] == 0)
                if (const auto evidence = overtones.evidence(tracks[*leader], tracks[other]))
                    together.emplace_back(other, *evidence);
        const double choice = std::log(double(together.size()));
        std::erase_if(together, [&](const auto &each) { return each.second <= choice; });
        double sum = 0.0;
        for (const auto &[other, evidence] : together)
            sum += evidence - choice;
        if (sum < sure)
            continue;
        calls[*leader] = tracks[*leader].id;
        for (const auto &[other, evidence] : together)
            calls[other] = tracks[*leader].id;
    }
    return calls;
}

} // namespace faintline

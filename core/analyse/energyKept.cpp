#include "analyse/energyKept.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace faintline {

namespace {

    struct Range {
        double low;
        double high;

        bool meets(const Range &other, double margin) const
        {
            return low <= other.high + margin && other.low <= high + margin;
        }
    };

    /// A track in seconds and hertz.
    struct Curve {
        const Track *track;
        const Axis *time;
        std::vector<double> hz;
        Range seconds;
        Range band;

        double secondsAt(std::size_t i) const { return time->value(double(track->points[i].frame)); }

        /// Range of frequencies within a frame of that time.
        Range around(double at) const
        {
            Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
            const double frame = (at - seconds.low) / time->step;
            for (const double shift : {-1.0, 0.0, 1.0}) {
                const double place = std::clamp(frame + shift, 0.0, double(hz.size() - 1));
                const auto i = std::size_t(place);
                const double next = hz[std::min(i + 1, hz.size() - 1)];
                const double value = hz[i] + (place - double(i)) * (next - hz[i]);
                range = {std::min(range.low, value), std::max(range.high, value)};
            }
            return range;
        }
    };

    std::vector<Curve> curvesOf(const TracksOnAxes &all)
    {
        std::vector<Curve> curves;
        for (const Track &track : all.tracks) {
            if (track.smoothed.empty())
                continue;
            Curve curve{&track, &all.time, {}, {}, {}};
            for (const SmoothedPoint &point : track.smoothed)
                curve.hz.push_back(all.frequency.value(point.position));
            const auto [low, high] = std::minmax_element(curve.hz.begin(), curve.hz.end());
            curve.band = {*low, *high};
            curve.seconds = {curve.secondsAt(0), curve.secondsAt(curve.hz.size() - 1)};
            curves.push_back(std::move(curve));
        }
        return curves;
    }

    /// Σ r of all curves near a path.
    double energyNear(const Curve &path, const std::vector<Curve> &curves, double marginHz)
    {
        double sum = 0.0;
        for (const Curve &curve : curves) {
            const double marginSeconds = std::max(path.time->step, curve.time->step);
            if (!curve.seconds.meets(path.seconds, marginSeconds) || !curve.band.meets(path.band, marginHz))
                continue;
            for (std::size_t i = 0; i < curve.hz.size(); ++i) {
                const double at = curve.secondsAt(i);
                if (at < path.seconds.low - marginSeconds || at > path.seconds.high + marginSeconds)
                    continue;
                if (path.around(at).meets({curve.hz[i], curve.hz[i]}, marginHz))
                    sum += double(curve.track->smoothed[i].level);
            }
        }
        return sum;
    }

    double weightedMedian(std::vector<std::pair<double, double>> &valuesAndWeights)
    {
        if (valuesAndWeights.empty())
            return std::numeric_limits<double>::quiet_NaN();
        std::sort(valuesAndWeights.begin(), valuesAndWeights.end());
        double half = 0.0;
        for (const auto &[value, weight] : valuesAndWeights)
            half += 0.5 * weight;
        auto at = valuesAndWeights.begin();
        for (double sum = at->second; sum < half && at + 1 != valuesAndWeights.end(); sum += at->second)
            ++at;
        return at->first;
    }

} // namespace

double energyKept(const TracksOnAxes &shorter, const TracksOnAxes &longer, double leastStatistic)
{
    const std::vector<Curve> ofShorter = curvesOf(shorter);
    const std::vector<Curve> ofLonger = curvesOf(longer);
    std::vector<std::pair<double, double>> shares;
    for (const Curve &path : ofShorter) {
        if (path.track->peakStatistic < leastStatistic)
            continue;
        const double kept = energyNear(path, ofLonger, shorter.cellHz);
        if (kept > 0.0)
            shares.emplace_back(kept / energyNear(path, ofShorter, shorter.cellHz), double(path.hz.size()));
    }
    return weightedMedian(shares);
}

} // namespace faintline

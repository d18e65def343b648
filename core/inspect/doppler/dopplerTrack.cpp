#include "inspect/doppler/dopplerTrack.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace faintline {

namespace {

    /// Limits of a model's slopes, bins per frame.
    struct Slopes {
        double lowest = 0.0, highest = 0.0;

        explicit Slopes(const StateSpace &space)
        {
            for (Index plane = 0; plane < space.planeCount(); ++plane) {
                lowest = std::min(lowest, space.ratesOfPlane(plane).back());
                highest = std::max(highest, space.ratesOfPlane(plane).back());
            }
        }
        /// Whether a line may be steeper than a path of this slope.
        bool isLimit(double slope) const
        {
            constexpr double steepShareOfLimit = 0.85;
            return (slope < 0.0 && slope <= steepShareOfLimit * lowest)
                   || (slope > 0.0 && slope >= steepShareOfLimit * highest);
        }
    };

    /// In a short piece next to a steep one, the path has probably lost its line.
    void dropShortPieces(std::vector<char> &isSteep)
    {
        constexpr std::ptrdiff_t stretchMinimumPoints = 16;
        if (std::find(isSteep.begin(), isSteep.end(), char(1)) == isSteep.end())
            return;
        for (auto from = isSteep.begin(); from != isSteep.end();) {
            const auto to = std::find(from, isSteep.end(), char(1));
            if (to - from < stretchMinimumPoints)
                std::fill(from, to, char(1));
            from = std::find(to, isSteep.end(), char(0));
        }
    }

    /// Flags points within two frames of where the path, or its mean slope over four frames, is at the limit.
    std::vector<char> steepPoints(const StateSpace &space, const Axis &axis, const Track &track)
    {
        constexpr std::ptrdiff_t slopeReachPoints = 2;
        const Slopes slopes(space);
        const std::ptrdiff_t count = std::ssize(track.points);
        const auto at = [&](std::ptrdiff_t i) { return track.lastPosition(std::size_t(i), axis); };
        std::vector<char> isSteep(track.points.size(), 0);
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const std::ptrdiff_t from = std::max<std::ptrdiff_t>(0, i - slopeReachPoints);
            const std::ptrdiff_t to = std::min(count - 1, i + slopeReachPoints);
            const double mean = to > from ? (at(to) - at(from)) / double(to - from) : 0.0;
            const Index plane = track.points[std::size_t(i)].plane;
            if (slopes.isLimit(space.ratesOfPlane(plane).back()) || (!track.smoothed.empty() && slopes.isLimit(mean)))
                std::fill(isSteep.begin() + from, isSteep.begin() + to + 1, char(1));
        }
        dropShortPieces(isSteep);
        return isSteep;
    }

    /// Standard deviation of a point's position, in cells; empty if the signal is absent.
    std::optional<double> deviationOf(const Track &track, std::size_t point)
    {
        if (track.smoothed.empty())
            return 1.0 / std::sqrt(12.0);
        if (!track.isPresent(point))
            return {};
        return track.smoothed[point].deviation();
    }

} // namespace

DopplerTrack dopplerTrack(const AnalysisPlan &plan, const Track &track, double centreHz)
{
    if (!plan.grid().isSpectrum())
        throw Error("Doppler fit", "needs frames on frequency alone; these have more than one axis");
    const Axis &axis = plan.grid().axes.back();
    const StateSpace &space = plan.modelAt(track.model).space;
    const std::vector<char> isSteep = steepPoints(space, axis, track);
    DopplerTrack result;
    result.steepestHzPerSecond = -Slopes(space).lowest * std::abs(axis.step) / plan.time().step;
    for (std::size_t i = 0; i < track.points.size(); ++i) {
        const std::optional<double> cells = deviationOf(track, i);
        if (cells && isSteep[i])
            ++result.steepCount;
        else if (cells)
            result.points.push_back({plan.time().value(double(track.points[i].frame)),
                                     centreHz + axis.value(track.lastPosition(i, axis)), *cells * std::abs(axis.step)});
    }
    return result;
}

DopplerTrack joined(const std::vector<DopplerTrack> &tracks)
{
    DopplerTrack all;
    for (const DopplerTrack &track : tracks) {
        all.points.insert(all.points.end(), track.points.begin(), track.points.end());
        all.steepCount += track.steepCount;
        all.steepestHzPerSecond = std::max(all.steepestHzPerSecond, track.steepestHzPerSecond);
    }
    const auto isEarlier = [](const DopplerPoint &a, const DopplerPoint &b) { return a.seconds < b.seconds; };
    std::stable_sort(all.points.begin(), all.points.end(), isEarlier);
    for (std::size_t i = 1; i < all.points.size(); ++i)
        if (!isEarlier(all.points[i - 1], all.points[i]))
            throw Error("Doppler fit", "the events are there at the same time, so they are not one pass");
    return all;
}

} // namespace faintline

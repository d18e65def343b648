#include "evaluate/comparison/trackScore.h"

#include <cmath>

namespace faintline {

namespace {

    /// Offsets of a point from a target along the axes; empty if the point is outside the gate.
    std::vector<Index> offsetsFrom(const TruthTarget &target, const TrackPoint &point, const Grid &grid,
                                   const std::vector<Index> &gate)
    {
        const Index cell = target.cellAt(point.frame);
        if (cell < 0)
            return {};
        const std::vector<Index> wanted = grid.coordinates(cell);
        const std::vector<Index> found = grid.coordinates(point.cell);
        std::vector<Index> offsets;
        for (std::size_t axis = 0; axis < wanted.size(); ++axis) {
            offsets.push_back(grid.axes[axis].steps(wanted[axis], found[axis]));
            if (std::abs(offsets.back()) > gate[axis])
                return {};
        }
        return offsets;
    }

    /// The target that a track belongs to, -1 if none.
    int ownerOf(const Track &track, const PingTruth &truth, const Grid &grid, const std::vector<Index> &gate)
    {
        int owner = -1;
        Index most = 0;
        for (std::size_t i = 0; i < truth.targets.size(); ++i) {
            Index matched = 0;
            Index present = 0;
            for (const TrackPoint &point : track.points) {
                if (point.frame < track.detectFrame || truth.targets[i].cellAt(point.frame) < 0)
                    continue;
                ++present;
                matched += offsetsFrom(truth.targets[i], point, grid, gate).empty() ? 0 : 1;
            }
            if (matched > most && 2 * matched >= present) {
                most = matched;
                owner = int(i);
            }
        }
        return owner;
    }

    void takeEarlier(Index &latency, Index frame, int firstPing)
    {
        const Index own = frame - firstPing + 1;
        if (frame >= 0 && (latency < 0 || own < latency))
            latency = own;
    }

} // namespace

TrackScore scoreTracks(std::span<const Track> tracks, const PingTruth &truth, const Grid &grid,
                       const std::vector<Index> &gateCells)
{
    TrackScore score;
    score.targets.resize(truth.targets.size());
    std::vector<std::vector<double>> squares(truth.targets.size(), std::vector<double>(gateCells.size(), 0.0));
    for (const Track &track : tracks) {
        const int owner = ownerOf(track, truth, grid, gateCells);
        score.targetOfTrack.push_back(owner);
        if (owner < 0) {
            ++score.falseTracks;
            score.falseConfirmed += track.isConfirmed ? 1 : 0;
            continue;
        }
        const auto i = std::size_t(owner);
        const TruthTarget &target = truth.targets[i];
        TargetScore &own = score.targets[i];
        ++own.tracks;
        takeEarlier(own.detectLatency, track.detectFrame, target.firstPing);
        takeEarlier(own.confirmLatency, track.confirmFrame, target.firstPing);
        for (const TrackPoint &point : track.points) {
            if (point.frame < track.detectFrame)
                continue;
            const std::vector<Index> offsets = offsetsFrom(target, point, grid, gateCells);
            own.matchedPoints += offsets.empty() ? 0 : 1;
            for (std::size_t axis = 0; axis < offsets.size(); ++axis)
                squares[i][axis] += double(offsets[axis] * offsets[axis]);
        }
    }
    for (std::size_t i = 0; i < score.targets.size(); ++i) {
        TargetScore &own = score.targets[i];
        for (double cell : truth.targets[i].cell)
            own.presentPings += cell >= 0.0 ? 1 : 0;
        for (double sum : squares[i])
            own.rmsCells.push_back(own.matchedPoints > 0 ? std::sqrt(sum / double(own.matchedPoints)) : 0.0);
    }
    return score;
}

std::vector<int> latencyHistogram(std::span<const Index> latencies, Index longest)
{
    std::vector<int> counts(std::size_t(longest) + 1, 0);
    for (Index latency : latencies)
        ++counts[std::size_t(latency < 1 || latency > longest ? longest : latency - 1)];
    return counts;
}

std::vector<double> pdAgainstPings(std::span<const Index> latencies, Index longest)
{
    const std::vector<int> counts = latencyHistogram(latencies, longest);
    std::vector<double> pd;
    int sum = 0;
    for (Index i = 0; i < longest; ++i) {
        sum += counts[std::size_t(i)];
        pd.push_back(double(sum) / double(std::ssize(latencies)));
    }
    return pd;
}

} // namespace faintline

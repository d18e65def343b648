#include "track/closeTrackers.h"

#include "track/constants.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace faintline {

std::vector<Index> cellsOfNeighbours(const Grid &grid, const PlaceIndex &places, std::size_t own, Index farthest,
                                     const std::vector<Index> &halfWidth)
{
    const auto distance = [&grid](const std::vector<Index> &a, const std::vector<Index> &b) {
        Index largest = 0;
        for (std::size_t axis = 0; axis < a.size(); ++axis)
            largest = std::max(largest, std::abs(grid.axes[axis].steps(a[axis], b[axis])));
        return largest;
    };
    const std::vector<Index> &mine = places[own];
    std::vector<Index> cells;
    places.forEachNear(mine, farthest, [&](std::size_t other) {
        const std::vector<Index> &centre = places[other];
        if (other == own || distance(mine, centre) > farthest)
            return;
        CellBox{centre, halfWidth}.forEachCell(grid, [&](Index cell) {
            const std::vector<Index> c = grid.coordinates(cell);
            if (distance(c, centre) < distance(c, mine))
                cells.push_back(cell);
        });
    });
    return cells;
}

std::vector<Track> endedDuplicates(std::vector<HmmTracker> &trackers, const Grid &grid,
                                   const std::vector<Index> &linkCells)
{
    std::vector<Track> ended;
    if (trackers.size() < 2)
        return ended;
    std::vector<std::vector<Index>> places;
    for (const HmmTracker &tracker : trackers)
        places.push_back(tracker.coordinates());
    const PlaceIndex index(grid, std::move(places));
    std::vector<std::size_t> near;
    for (std::size_t younger = trackers.size(); younger-- > 1;) {
        HmmTracker &young = trackers[younger];
        near.clear();
        index.forEachNear(index[younger], linkCells.front(), [&](std::size_t older) {
            if (older < younger && CellBox{index[older], linkCells}.contains(grid, index[younger]))
                near.push_back(older);
        });
        std::sort(near.begin(), near.end());
        std::vector<HmmTracker::Beside> beside;
        int longest = 0;
        for (std::size_t i = 0; i < near.size() && longest < duplicateAfterFrames; ++i) {
            const int older = trackers[near[i]].track().id;
            const auto known = std::find_if(young.beside().begin(), young.beside().end(),
                                            [older](const HmmTracker::Beside &other) { return other.track == older; });
            longest = known == young.beside().end() ? 1 : known->frames + 1;
            beside.push_back({older, longest});
        }
        if (longest < duplicateAfterFrames) {
            young.setBeside(std::move(beside));
            continue;
        }
        if (2 * longest < young.age())
            ended.push_back(young.finish(false));
        trackers.erase(trackers.begin() + std::ptrdiff_t(younger));
    }
    return ended;
}

} // namespace faintline

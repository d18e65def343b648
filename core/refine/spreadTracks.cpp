#include "refine/spreadTracks.h"

#include "plan/sureStatistic.h"
#include "refine/constants.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    bool isSpread(const Track &track, const Analysis &analysis)
    {
        if (track.smoothed.empty() || track.peakStatistic < sureStatistic(analysis))
            return false;
        const std::vector<std::size_t> present = track.presentPoints();
        const auto count = double(present.size());
        double level = 0.0;
        double bins = 0.0;
        for (const std::size_t i : present) {
            level += double(track.smoothed[i].level) / count;
            bins += double(track.smoothed[i].high - track.smoothed[i].low) / count;
        }
        const double limit = lineBandCells * std::max(1.0, 1.0 / std::sqrt(std::max(level, 1e-9)));
        return level < strongLevelRatio && bins > limit * analysis.frames->geometry().binsPerCell;
    }

    void addAreas(const Track &track, Index cells, std::vector<Area> &areas)
    {
        const std::vector<std::size_t> present = track.presentPoints();
        for (auto from = present.begin(); from != present.end();) {
            const Index first = track.points[*from].frame;
            Area area{first, first, cells - 1, 0, 0.0};
            auto to = from;
            for (; to != present.end() && track.points[*to].frame < first + spreadAreaFrames; ++to) {
                const SmoothedPoint &point = track.smoothed[*to];
                area.lastFrame = track.points[*to].frame;
                area.firstCell = std::min(area.firstCell, std::clamp<Index>(std::lround(point.low), 0, cells - 1));
                area.lastCell = std::max(area.lastCell, std::clamp<Index>(std::lround(point.high), 0, cells - 1));
                area.level += 1.0 + double(point.level);
            }
            area.level /= double(to - from);
            areas.push_back(area);
            from = to;
        }
    }

} // namespace

void moveSpreadTracks(Analysis &analysis)
{
    if (!analysis.settings.family.isNone()
        || analysis.model.space.axes().front().rateChange.front() < slowLawProbability)
        return;
    const auto spread = std::stable_partition(analysis.tracks.begin(), analysis.tracks.end(),
                                              [&](const Track &track) { return !isSpread(track, analysis); });
    if (spread == analysis.tracks.end())
        return;
    for (auto track = spread; track != analysis.tracks.end(); ++track)
        addAreas(*track, analysis.grid().size(), analysis.areas);
    analysis.tracks.erase(spread, analysis.tracks.end());
    analysis.areas = joinAreas(std::move(analysis.areas));
}

} // namespace faintline

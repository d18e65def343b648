#include "refine/familyTracks.h"

#include "refine/constants.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faintline {

namespace {

    class Members
    {
    public:
        explicit Members(const AnalysisPlan &plan)
            : m_family(plan.settings.family), m_axis(plan.grid().axes.back()),
              m_band(plan.lines.front()->grid().axes.back()),
              m_near(plan.settings.decide.inhibitCells.back() * plan.frames->geometry().binsPerCell * m_band.step)
        {
        }

        /// Share of a track's in-band members that coincide with members of another track while both last.
        double sharedBy(const Track &track, const Track &other) const
        {
            const Index first = std::max(track.points.front().frame, other.points.front().frame);
            const Index last = std::min(track.points.back().frame, other.points.back().frame);
            if (first > last)
                return 0.0;
            const Index step = std::max<Index>(1, (last - first) / comparedFrames);
            double shared = 0.0;
            double count = 0.0;
            for (Index frame = first; frame <= last; frame += step, count += 1.0)
                shared += sharedAt(hzAt(track, frame), hzAt(other, frame));
            return shared / count;
        }

    private:
        double hzAt(const Track &track, Index frame) const
        {
            return m_axis.value(track.lastPosition(std::min(track.pointIndex(frame), track.points.size() - 1), m_axis));
        }

        double sharedAt(double hz, double otherHz) const
        {
            const std::vector<double> others = memberFrequencies(m_family, otherHz);
            double shared = 0.0;
            double inBand = 0.0;
            for (const double member : memberFrequencies(m_family, hz)) {
                if (member < m_band.value(0.0) || member > m_band.last())
                    continue;
                inBand += 1.0;
                shared += std::any_of(others.begin(), others.end(),
                                      [&](double other) { return std::abs(member - other) <= m_near; });
            }
            return inBand > 0.0 ? shared / inBand : 0.0;
        }

        const FamilySettings &m_family;
        const Axis &m_axis;
        const Axis &m_band; ///< of the members
        double m_near;      ///< Hz
    };

    /// Whether a stronger track's members fully explain a statistic.
    bool isExplained(double statistic, double explained, double threshold)
    {
        return explained > 0.0 && (statistic <= ghostStatisticFactor * explained || statistic - explained < threshold);
    }

} // namespace

std::vector<Track> withoutGhosts(const AnalysisPlan &plan, std::vector<Track> tracks)
{
    if (plan.settings.family.isNone())
        return tracks;
    const Members members(plan);
    std::vector<std::size_t> order(tracks.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return tracks[a].peakStatistic > tracks[b].peakStatistic; });
    std::vector<std::size_t> kept;
    for (const std::size_t number : order)
        if (std::none_of(kept.begin(), kept.end(), [&](std::size_t stronger) {
                const double explained =
                    members.sharedBy(tracks[number], tracks[stronger]) * tracks[stronger].peakStatistic;
                return isExplained(tracks[number].peakStatistic, explained, plan.threshold);
            }))
            kept.push_back(number);
    std::sort(kept.begin(), kept.end());
    std::vector<Track> result;
    for (const std::size_t number : kept) {
        result.push_back(std::move(tracks[number]));
        result.back().id = int(result.size());
    }
    return result;
}

} // namespace faintline

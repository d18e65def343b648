#include "refine/overSides.h"

#include "plan/sureStatistic.h"
#include "refine/levelBeside.h"
#include "refine/pathStrips.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace faintline {

namespace {

    constexpr double lineCells = 1.0;                             ///< on either side: the main lobe's upper 6 dB
    constexpr double sideLimitShare = 0.25;                       ///< of a line's power, on its weaker side
    constexpr std::size_t sideStripBytes = std::size_t(64) << 20; ///< read at a time

    class Sides
    {
    public:
        Sides(const Analysis &analysis, std::span<const Track> all)
            : m_analysis(analysis), m_all(all), m_model(bothWaysModel(analysis)),
              m_half(Index(std::ceil(lineCells * m_model.binsPerCell)))
        {
            const auto byCell = [](const TrackPoint &a, const TrackPoint &b) { return a.cell < b.cell; };
            for (const Track &track : all) {
                const auto [lowest, highest] = std::ranges::minmax_element(track.points, byCell);
                m_ranges.emplace_back(lowest->cell, highest->cell);
            }
        }

        PathStrip stripOf(const Track &line) const
        {
            return stripAlong(line, levelOfSidesHalfWidth(m_model.binsPerCell));
        }

        bool isLine(PathStrip strip)
        {
            PathStrip sides = strip;
            removeSignals(sides);
            if (shareOfSides(strip, sides, m_model.binsPerCell) > sideLimitShare)
                return false;
            keepLine(strip, float(levelOfSides(sides, m_model.binsPerCell)));
            setLnK(m_model, m_analysis, strip);
            return strongestIn(strip, m_model) >= sureStatistic(m_analysis);
        }

    private:
        void removeSignals(PathStrip &strip) const
        {
            const auto [lowest, highest] = std::ranges::minmax(strip.centres);
            const Index reach = strip.halfWidth + m_half;
            for (std::size_t i = 0; i < m_all.size(); ++i)
                if (m_ranges[i].first <= highest + reach && m_ranges[i].second >= lowest - reach)
                    removeSignal(strip, m_all[i]);
        }

        void removeSignal(PathStrip &strip, const Track &track) const
        {
            const Index first = track.points.front().frame;
            const Index from = std::max(strip.firstFrame, first);
            const Index end = std::min(strip.firstFrame + strip.frameCount(), track.points.back().frame + 1);
            for (Index frame = from; frame < end; ++frame) {
                const Index at = frame - strip.firstFrame;
                const Index centre = track.points[std::size_t(frame - first)].cell - strip.firstCell(at);
                const Index last = std::min(strip.width() - 1, centre + m_half);
                for (Index i = std::max<Index>(0, centre - m_half); i <= last; ++i)
                    strip.row(at)[i] = std::numeric_limits<float>::quiet_NaN();
            }
        }

        /// Divides y by the level, and sets it to 0 beside the line.
        void keepLine(PathStrip &strip, float level) const
        {
            for (Index at = 0; at < strip.frameCount(); ++at)
                for (Index bin = -strip.halfWidth; bin <= strip.halfWidth; ++bin)
                    strip.row(at)[strip.halfWidth + bin] *= std::abs(bin) <= m_half ? 1.0f / level : 0.0f;
        }

        const Analysis &m_analysis;
        std::span<const Track> m_all;
        BothWaysModel m_model;
        Index m_half;                                  ///< bins of a line on either side
        std::vector<std::pair<Index, Index>> m_ranges; ///< lowest and highest cell of each track
    };

} // namespace

std::vector<Track> overSides(const Analysis &analysis, std::vector<Track> lines, std::span<const Track> all,
                             const RunContext &context)
{
    Sides sides(analysis, all);
    std::vector<Track> result;
    for (std::size_t first = 0; first < lines.size();) {
        std::vector<PathStrip> strips;
        std::size_t end = first;
        for (std::size_t bytes = 0; end < lines.size() && bytes < sideStripBytes; ++end) {
            strips.push_back(sides.stripOf(lines[end]));
            bytes += sizeof(float) * std::size_t(strips.back().frameCount() * strips.back().width());
        }
        const auto share = [&](std::size_t line) { return double(line) / double(lines.size()); };
        readStrips(analysis, strips, context.part(share(first), share(end)), "comparing lines with their surroundings");
        for (std::size_t i = first; i < end; ++i)
            if (sides.isLine(std::move(strips[i - first])))
                result.push_back(std::move(lines[i]));
        first = end;
    }
    return result;
}

} // namespace faintline

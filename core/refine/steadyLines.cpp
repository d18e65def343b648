#include "refine/steadyLines.h"

#include "plan/Analysis.h"
#include "plan/sureStatistic.h"
#include "refine/levelBeside.h"
#include "refine/numberByDetection.h"
#include "refine/pathStrips.h"
#include "refine/trimEnds.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <utility>
#include <vector>

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

    /// Those of `lines`, which stand still, that stand out of their surroundings.
    ///
    /// A band of a few cells has a path as good as a line's. So the detector's score of the strongest path within a
    /// cell of the track, with y divided by the level on its sides (levelOfSides), has to reach
    /// sureStatistic(analysis), and the weaker side must not have more than a quarter of the path's mean power over the
    /// noise's (shareOfSides). Cells within a cell of `all` tracks of this analysis do not belong to the sides.
    ///
    /// The levels of levelBeside do not decide this: they are those of cells farther away, over fewer frames, and less
    /// their scatter.
    ///
    /// Frames are read again if there are any lines, for 64 MiB of cells around them at a time. Throws Cancelled.
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
            readStrips(analysis, strips, context.part(share(first), share(end)),
                       "comparing lines with their surroundings");
            for (std::size_t i = first; i < end; ++i)
                if (sides.isLine(std::move(strips[i - first])))
                    result.push_back(std::move(lines[i]));
            first = end;
        }
        return result;
    }

    constexpr double mostWander = 0.1;    ///< of a steady line, cells per frame
    constexpr double sameLineCells = 2.0; ///< in cells of the longer window
    constexpr double mostExplained = 0.5; ///< of the frames of a line that is not found yet
    constexpr double leastFollowed = 0.8; ///< of the frames of a piece

    const Axis &frequencyOf(const Analysis &analysis)
    {
        return analysis.grid().axes.back();
    }

    double cellHz(const Analysis &analysis)
    {
        return 1.0 / analysis.frames->spectrogram()->windowSeconds();
    }

    double secondsAt(const Analysis &analysis, const Track &track, std::size_t point)
    {
        return analysis.time().value(double(track.points[point].frame));
    }

    double hzAt(const Analysis &analysis, const Track &track, std::size_t point)
    {
        return frequencyOf(analysis).value(track.smoothed[point].position);
    }

    bool standsStill(const Track &track, const Analysis &analysis)
    {
        double way = 0.0;
        for (std::size_t i = 1; i < track.points.size(); ++i)
            way += std::abs(hzAt(analysis, track, i) - hzAt(analysis, track, i - 1));
        const auto steps = double(track.points.size() - 1);
        return steps > 0.0 && way <= mostWander * cellHz(analysis) * steps;
    }

    /// Comparison of the tracks of two windows.
    class Comparison
    {
    public:
        Comparison(const Analysis &chosen, const Analysis &longer) : m_chosen(chosen), m_longer(longer) {}

        /// For each track of the chosen window, whether it follows this one (on the chosen window's frames).
        std::vector<bool> followers(const Track &line) const
        {
            std::vector<bool> result;
            for (const Track &track : m_chosen.tracks)
                result.push_back(follows(track, line));
            return result;
        }

        /// Whether the longer window's track lies on none of the chosen window's tracks, except followers.
        bool isMissed(const Track &track, const std::vector<bool> &followers) const
        {
            double explained = 0.0;
            for (std::size_t i = 0; i < track.points.size(); ++i)
                if (isExplained(secondsAt(m_longer, track, i), hzAt(m_longer, track, i), followers))
                    explained += 1.0;
            return explained <= mostExplained * double(track.points.size());
        }

        /// Converts the track to the chosen window's frames.
        Track onChosenFrames(const Track &track) const
        {
            const double shift = m_chosen.threshold - m_longer.threshold;
            Track result = track;
            result.isSubtracted = false; // refers to the longer window, but the display shows the chosen one
            result.windowSeconds = m_longer.frames->spectrogram()->windowSeconds();
            result.onsetFrame = frameOf(track.onsetFrame);
            result.detectFrame = frameOf(track.detectFrame);
            result.endFrame = frameOf(track.endFrame);
            result.confirmFrame = track.confirmFrame < 0 ? -1 : frameOf(track.confirmFrame);
            result.peakStatistic += shift;
            result.detectStatistic += shift;
            result.points.clear();
            result.smoothed.clear();
            const auto last = double(track.points.size() - 1);
            for (Index frame = result.onsetFrame; frame <= result.endFrame; ++frame) {
                const double at = m_longer.time().position(m_chosen.time().value(double(frame)));
                append(result, frame, between(track, std::clamp(at - double(track.points.front().frame), 0.0, last)),
                       shift);
            }
            return result;
        }

    private:
        struct Place {
            double statistic;
            SmoothedPoint point; ///< in cells and power of the longer window
        };

        bool follows(const Track &track, const Track &line) const
        {
            const double cell = cellHz(m_chosen) / frequencyOf(m_chosen).step;
            const Index reach = m_chosen.time().nearest(m_chosen.time().first + 0.5 / cellHz(m_longer));
            double near = 0.0;
            for (std::size_t i = 0; i < track.points.size(); ++i) {
                const Index frame = track.points[i].frame;
                if (frame < line.onsetFrame - reach || frame > line.endFrame + reach)
                    continue;
                const Index at = std::clamp(frame, line.onsetFrame, line.endFrame) - line.onsetFrame;
                const double apart = track.smoothed[i].position - line.smoothed[std::size_t(at)].position;
                near += std::abs(apart) <= cell ? 1.0 : 0.0;
            }
            return near >= leastFollowed * double(track.points.size());
        }

        /// Whether a track of the chosen window, other than a follower, is near within the time of the longer window.
        bool isExplained(double seconds, double hz, const std::vector<bool> &followers) const
        {
            for (std::size_t i = 0; i < m_chosen.tracks.size(); ++i)
                if (!followers[i] && comesNear(m_chosen.tracks[i], seconds, hz))
                    return true;
            return false;
        }

        bool comesNear(const Track &track, double seconds, double hz) const
        {
            const Axis &time = m_chosen.time();
            const double half = 0.5 / cellHz(m_longer);
            const auto frames = double(track.points.size());
            const double start = secondsAt(m_chosen, track, 0);
            const auto at = [&](double t) { return (t - start) / time.step; };
            const double from = std::max(0.0, std::ceil(at(seconds - half)));
            const double to = std::min(frames - 1.0, std::floor(at(seconds + half)));
            if (from > to)
                return false;
            const auto first = track.smoothed.begin() + Index(from);
            const auto end = track.smoothed.begin() + Index(to) + 1;
            const auto byPosition = [](const SmoothedPoint &a, const SmoothedPoint &b) {
                return a.position < b.position;
            };
            const Axis &axis = frequencyOf(m_chosen);
            double low = axis.value(std::min_element(first, end, byPosition)->position);
            double high = axis.value(std::max_element(first, end, byPosition)->position);
            if (high - low > cellHz(m_longer))
                for (auto point = first; point != end; ++point) {
                    low = std::min(low, axis.value(double(point->low)));
                    high = std::max(high, axis.value(double(point->high)));
                }
            const double margin = sameLineCells * cellHz(m_longer);
            return low - margin <= hz && hz <= high + margin;
        }

        Index frameOf(Index longerFrame) const
        {
            return m_chosen.time().nearest(m_longer.time().value(double(longerFrame)));
        }

        /// Interpolates linearly at a fractional point of a track.
        static Place between(const Track &track, double at)
        {
            const auto i = std::size_t(at);
            const std::size_t next = std::min(i + 1, track.points.size() - 1);
            const double share = at - double(i);
            const auto mix = [&](auto a, auto b) { return static_cast<decltype(a)>((1.0 - share) * a + share * b); };
            const SmoothedPoint &a = track.smoothed[i];
            const SmoothedPoint &b = track.smoothed[next];
            return {mix(track.points[i].statistic, track.points[next].statistic),
                    {mix(a.position, b.position), mix(a.low, b.low), mix(a.high, b.high), mix(a.presence, b.presence),
                     mix(a.level, b.level)}};
        }

        void append(Track &track, Index frame, const Place &place, double shift) const
        {
            const Axis &axis = frequencyOf(m_chosen);
            const auto here = [&](double position) { return axis.position(frequencyOf(m_longer).value(position)); };
            const double windows = cellHz(m_chosen) / cellHz(m_longer);
            const double position = std::clamp(here(place.point.position), 0.0, double(axis.count - 1));
            track.points.push_back(
                {frame, Index(std::lround(position)), m_chosen.model.space.planeCount() / 2, place.statistic + shift});
            track.smoothed.push_back({position, float(here(double(place.point.low))),
                                      float(here(double(place.point.high))), place.point.presence,
                                      float(double(place.point.level) / windows)});
        }

        const Analysis &m_chosen;
        const Analysis &m_longer;
    };

    /// Whether no follower is measured better by the chosen window.
    bool isBetterKnown(const Track &line, const std::vector<Track> &tracks, const std::vector<bool> &followers)
    {
        for (std::size_t i = 0; i < tracks.size(); ++i)
            if (followers[i] && tracks[i].peakStatistic >= line.peakStatistic)
                return false;
        return true;
    }

} // namespace

std::vector<Track> withSteadyLines(const Analysis &chosen, const Analysis &longer, const RunContext &context)
{
    const Comparison comparison(chosen, longer);
    const std::vector<Track> trimmed = withEndsTrimmed(longer.tracks);
    std::vector<Track> steady;
    std::ranges::copy_if(trimmed, std::back_inserter(steady), [&](const Track &track) {
        return track.peakStatistic >= sureStatistic(longer) && standsStill(track, longer);
    });
    std::vector<Track> lines;
    std::vector<bool> isReplaced(chosen.tracks.size(), false);
    for (const Track &track : overSides(longer, std::move(steady), trimmed, context)) {
        Track line = comparison.onChosenFrames(track);
        const std::vector<bool> followers = comparison.followers(line);
        if (!isBetterKnown(line, chosen.tracks, followers) || !comparison.isMissed(track, followers))
            continue;
        for (std::size_t i = 0; i < followers.size(); ++i)
            if (followers[i]) {
                isReplaced[i] = true;
                line.isSubtracted = line.isSubtracted || chosen.tracks[i].isSubtracted;
                line.detectFrame = std::clamp(chosen.tracks[i].detectFrame, line.onsetFrame, line.detectFrame);
            }
        lines.push_back(std::move(line));
    }
    for (std::size_t i = 0; i < chosen.tracks.size(); ++i)
        if (!isReplaced[i])
            lines.push_back(chosen.tracks[i]);
    numberByDetection(lines);
    return lines;
}

} // namespace faintline

#include "refine/steadyLines.h"

#include "plan/sureStatistic.h"
#include "refine/numberByDetection.h"
#include "refine/overSides.h"
#include "refine/trimEnds.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace faintline {

namespace {

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

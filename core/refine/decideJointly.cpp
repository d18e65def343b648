#include "refine/decideJointly.h"

#include "recursion/jointPaths.h"
#include "refine/constants.h"
#include "refine/pathStrips.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace faintline {

namespace {

    struct FramesTogether {
        Index from = 0;
        Index to = -1; ///< inclusive
        Index count() const { return to - from + 1; }
    };

    class JointDecision
    {
    public:
        JointDecision(const Analysis &analysis, std::vector<Track> tracks, Index slopeFrames)
            : m_analysis(analysis), m_binsPerCell(analysis.frames->geometry().binsPerCell), m_slopeFrames(slopeFrames),
              m_tracks(std::move(tracks))
        {
            for (const Track &track : m_tracks)
                m_ranges.push_back(rangeOf(track));
        }

        std::vector<Track> run(const RunContext &context)
        {
            for (std::size_t i = 0; i < m_tracks.size(); ++i)
                for (std::size_t j = i + 1; j < m_tracks.size(); ++j) {
                    const FramesTogether together = besideEachOther(i, j);
                    if (together.count() >= togetherSlopeLengths * m_slopeFrames && areEqual(i, j, together)
                        && areAlone(i, j, together))
                        decide(i, j, together, context);
                }
            std::erase_if(m_tracks, [](const Track &track) { return track.points.empty(); });
            return std::move(m_tracks);
        }

    private:
        /// Lowest and highest position of a track.
        struct Range {
            double low = 0.0;
            double high = 0.0;
        };

        static Range rangeOf(const Track &track)
        {
            const auto byPosition = [](const SmoothedPoint &a, const SmoothedPoint &b) {
                return a.position < b.position;
            };
            const auto [low, high] = std::ranges::minmax_element(track.smoothed, byPosition);
            return {low->position, high->position};
        }

        bool canMeet(const Range &a, const Range &b) const
        {
            return a.low < b.high + near() && b.low < a.high + near();
        }

        double near() const { return meetingCells * m_binsPerCell; }

        /// The longest run of frames in which two tracks are near, with gaps of up to slopeFrames.
        FramesTogether besideEachOther(std::size_t i, std::size_t j) const
        {
            const Track &a = m_tracks[i];
            const Track &b = m_tracks[j];
            FramesTogether longest;
            if (a.points.empty() || b.points.empty() || !canMeet(m_ranges[i], m_ranges[j]))
                return longest;
            FramesTogether run;
            const Index last = std::min(a.points.back().frame, b.points.back().frame);
            for (Index frame = std::max(a.points.front().frame, b.points.front().frame); frame <= last; ++frame) {
                if (std::abs(a.positionAt(frame) - b.positionAt(frame)) >= near())
                    continue;
                if (run.count() == 0 || frame - run.to > m_slopeFrames)
                    run.from = frame;
                run.to = frame;
                if (run.count() > longest.count())
                    longest = run;
            }
            return longest;
        }

        static double levelOf(const Track &track, const FramesTogether &frames)
        {
            double sum = 0.0;
            for (Index frame = frames.from; frame <= frames.to; ++frame)
                sum += double(track.smoothedAt(frame).level);
            return sum / double(frames.count());
        }

        bool areEqual(std::size_t i, std::size_t j, const FramesTogether &frames) const
        {
            const double a = levelOf(m_tracks[i], frames);
            const double b = levelOf(m_tracks[j], frames);
            return std::min(a, b) >= leastJointLevelRatio && std::max(a, b) <= comparableLevelRatio * std::min(a, b);
        }

        /// Whether no third track comes near. Tracks on one of the two or between them do not count: they are pieces.
        bool areAlone(std::size_t i, std::size_t j, const FramesTogether &frames) const
        {
            for (std::size_t other = 0; other < m_tracks.size(); ++other) {
                const Track &track = m_tracks[other];
                if (other == i || other == j || track.points.empty())
                    continue;
                const Index last = std::min(frames.to, track.points.back().frame);
                for (Index frame = std::max(frames.from, track.points.front().frame); frame <= last; ++frame) {
                    const double a = m_tracks[i].positionAt(frame);
                    const double b = m_tracks[j].positionAt(frame);
                    const double at = track.positionAt(frame);
                    if (at > std::min(a, b) - near() && at < std::max(a, b) + near()
                        && (at < std::min(a, b) - onPathCells * m_binsPerCell
                            || at > std::max(a, b) + onPathCells * m_binsPerCell))
                        return false;
                }
            }
            return true;
        }

        /// The mean of both positions, averaged over ± slopeFrames.
        std::vector<Index> centresOf(std::size_t i, std::size_t j, const FramesTogether &frames) const
        {
            std::vector<double> sums{0.0};
            for (Index frame = frames.from; frame <= frames.to; ++frame)
                sums.push_back(sums.back() + 0.5 * (m_tracks[i].positionAt(frame) + m_tracks[j].positionAt(frame)));
            std::vector<Index> centres;
            for (Index at = 0; at < frames.count(); ++at) {
                const Index reach = std::min({m_slopeFrames, at, frames.count() - 1 - at});
                const auto from = std::size_t(at - reach);
                const auto to = std::size_t(at + reach + 1);
                centres.push_back(Index(std::lround((sums[to] - sums[from]) / double(to - from))));
            }
            return centres;
        }

        void decide(std::size_t i, std::size_t j, const FramesTogether &frames, const RunContext &context)
        {
            PathStrip strip;
            strip.firstFrame = frames.from;
            strip.halfWidth = Index(std::ceil(meetingCells * m_binsPerCell));
            strip.centres = centresOf(i, j, frames);
            readStrips(m_analysis, std::span(&strip, 1), context, "deciding between close signals");
            closeBeyondTheAxis(strip);
            const Likelihood likelihood(m_analysis.model.likelihood.kind(), jointDesignLevelRatio);
            auto paths =
                jointPaths(std::move(strip), likelihood, Index(std::lround(pathsApartCells * m_binsPerCell)), context);
            const auto apart = [&](std::size_t path, std::size_t track, Index frame) {
                return std::abs(double(paths[path][std::size_t(frame - frames.from)])
                                - m_tracks[track].positionAt(frame));
            };
            const auto isCrosswise = [&](Index frame) {
                return apart(0, i, frame) + apart(1, j, frame) > apart(0, j, frame) + apart(1, i, frame);
            };
            if (isCrosswise(frames.from))
                std::swap(paths[0], paths[1]);
            bool swapsTails = isCrosswise(frames.to);
            if (swapsTails && meetAndPart(i, j, frames)) {
                changeOver(paths);
                swapsTails = false;
            }
            Track first = along(paths[0], frames, m_tracks[i], m_tracks[swapsTails ? j : i]);
            Track second = along(paths[1], frames, m_tracks[j], m_tracks[swapsTails ? i : j]);
            removePieces(paths, frames, i, j);
            m_tracks[i] = std::move(first);
            m_tracks[j] = std::move(second);
            m_ranges[i] = rangeOf(m_tracks[i]);
            m_ranges[j] = rangeOf(m_tracks[j]);
        }

        /// Off the axis there is no power at all, so that no path prefers it to noise.
        void closeBeyondTheAxis(PathStrip &strip) const
        {
            const Index cells = m_analysis.grid().size();
            for (Index at = 0; at < strip.frameCount(); ++at)
                for (Index i = 0; i < strip.width(); ++i)
                    if (const Index cell = strip.firstCell(at) + i; cell < 0 || cell >= cells)
                        strip.row(at)[i] = 0.0f;
        }

        /// Whether two tracks come from and go to where they are apart, so that their ways there tell who is who.
        bool meetAndPart(std::size_t i, std::size_t j, const FramesTogether &frames) const
        {
            const Track &a = m_tracks[i];
            const Track &b = m_tracks[j];
            return frames.from - m_slopeFrames >= std::max(a.points.front().frame, b.points.front().frame)
                   && frames.to + m_slopeFrames <= std::min(a.points.back().frame, b.points.back().frame);
        }

        /// Exchanges two paths from where they are nearest to each other.
        static void changeOver(std::array<std::vector<Index>, 2> &paths)
        {
            std::size_t nearest = 0;
            const auto apart = [&](std::size_t at) { return std::abs(paths[0][at] - paths[1][at]); };
            for (std::size_t at = 0; at < paths[0].size(); ++at)
                nearest = apart(at) < apart(nearest) ? at : nearest;
            std::swap_ranges(paths[0].begin() + std::ptrdiff_t(nearest), paths[0].end(),
                             paths[1].begin() + std::ptrdiff_t(nearest));
        }

        /// The measured point nearest to a path in a frame, among all tracks; null if none lies on it.
        const Track *trackOn(Index cell, Index frame) const
        {
            const Track *nearest = nullptr;
            double least = onPathCells * m_binsPerCell;
            for (const Track &track : m_tracks)
                if (track.isThere(frame))
                    if (const double apart = std::abs(track.positionAt(frame) - double(cell)); apart <= least) {
                        least = apart;
                        nearest = &track;
                    }
            return nearest;
        }

        /// One signal: a track up to the frames, a path in them, and a track from there on.
        Track along(const std::vector<Index> &path, const FramesTogether &frames, const Track &head,
                    const Track &tail) const
        {
            Track result = head.withoutPoints();
            const auto append = [&](const Track &from, std::size_t i) {
                const double before = i > 0 ? from.points[i - 1].statistic : 0.0;
                TrackPoint point = from.points[i];
                point.statistic += (result.points.empty() ? 0.0 : result.points.back().statistic) - before;
                result.points.push_back(point);
                result.smoothed.push_back(from.smoothed[i]);
            };
            for (std::size_t i = 0; i < head.points.size() && head.points[i].frame < frames.from; ++i)
                append(head, i);
            for (Index frame = frames.from; frame <= frames.to; ++frame) {
                const Index cell =
                    std::clamp<Index>(path[std::size_t(frame - frames.from)], 0, m_analysis.grid().size() - 1);
                if (const Track *on = trackOn(cell, frame)) {
                    append(*on, on->pointIndex(frame));
                    continue;
                }
                SmoothedPoint point = head.smoothedAt(frame);
                TrackPoint at = head.points[head.pointIndex(frame)];
                at.cell = cell;
                at.statistic = result.points.empty() ? 0.0 : result.points.back().statistic;
                point.position = double(cell);
                point.presence = 0.0f; // nobody has measured it there
                point.low = float(double(cell) - 0.5 * m_binsPerCell);
                point.high = float(double(cell) + 0.5 * m_binsPerCell);
                result.points.push_back(at);
                result.smoothed.push_back(point);
            }
            for (std::size_t i = 0; i < tail.points.size(); ++i)
                if (tail.points[i].frame > frames.to)
                    append(tail, i);
            result.takeEndsOfPoints();
            result.isOpen = tail.isOpen;
            result.keepDecisionsIn(result.onsetFrame, result.endFrame);
            for (const TrackPoint &point : result.points)
                result.peakStatistic = std::max(result.peakStatistic, point.statistic);
            return result;
        }

        /// Removes the other tracks that follow one of the paths for most of their time.
        void removePieces(const std::array<std::vector<Index>, 2> &paths, const FramesTogether &frames, std::size_t i,
                          std::size_t j)
        {
            const auto isOn = [&](const Track &track, std::size_t point) {
                const Index at = track.points[point].frame - frames.from;
                return at >= 0 && at < frames.count() && std::ranges::any_of(paths, [&](const auto &path) {
                           const double apart = double(path[std::size_t(at)]) - track.smoothed[point].position;
                           return std::abs(apart) <= onPathCells * m_binsPerCell;
                       });
            };
            for (std::size_t other = 0; other < m_tracks.size(); ++other) {
                Track &track = m_tracks[other];
                if (other == i || other == j || track.points.empty())
                    continue;
                Index on = 0;
                for (std::size_t point = 0; point < track.points.size(); ++point)
                    on += isOn(track, point) ? 1 : 0;
                if (double(on) >= followedShare * double(track.points.size())) {
                    track.points.clear();
                    track.smoothed.clear();
                }
            }
        }

        const Analysis &m_analysis;
        double m_binsPerCell;
        Index m_slopeFrames;
        std::vector<Track> m_tracks;
        std::vector<Range> m_ranges;
    };

} // namespace

std::vector<Track> decideJointly(const Analysis &analysis, std::vector<Track> tracks, Index slopeFrames,
                                 const RunContext &context)
{
    return JointDecision(analysis, std::move(tracks), slopeFrames).run(context);
}

} // namespace faintline

#include "refine/relink.h"

#include "refine/PolynomialFit.h"
#include "refine/constants.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    /// Frames from … to, inclusive.
    struct Frames {
        Index from;
        Index to;
    };

    /// Positions along a track, and beyond its ends.
    struct Way {
        Index first = 0;
        std::vector<double> positions; ///< one per frame
        double low = std::numeric_limits<double>::infinity();
        double high = -std::numeric_limits<double>::infinity();

        Index last() const { return first + std::ssize(positions) - 1; }
        double at(Index frame) const { return positions[std::size_t(frame - first)]; }
    };

    Index firstFrame(const Track &track)
    {
        return track.points.front().frame;
    }

    Index lastFrame(const Track &track)
    {
        return track.points.back().frame;
    }

    /// Points from … to, exclusive, that no encounter touches.
    struct Run {
        std::size_t from;
        std::size_t to;
    };

    /// All such runs; the whole track if there is none.
    std::vector<Run> runsOf(const std::vector<bool> &marks)
    {
        std::vector<Run> runs;
        for (std::size_t from = 0; from < marks.size();) {
            std::size_t to = from;
            while (to < marks.size() && marks[to] == marks[from])
                ++to;
            if (!marks[from] && to - from >= fewestRunPoints)
                runs.push_back({from, to});
            from = to;
        }
        if (runs.empty())
            runs.push_back({0, marks.size()});
        return runs;
    }

    Way measured(const Track &track, const Run &run)
    {
        Way way{firstFrame(track) + Index(run.from), {}};
        for (std::size_t i = run.from; i < run.to; ++i)
            way.positions.push_back(track.smoothed[i].position);
        return way;
    }

    /// A run and its extrapolation in direction ±1, as far as a fit determines it.
    Way extended(const Track &track, const Run &run, Index direction, const EncounterRule &rule)
    {
        Way way = measured(track, run);
        const std::size_t count = std::min(run.to - run.from, std::size_t(rule.fitFrames));
        const std::size_t from = direction > 0 ? run.to - count : run.from;
        const PolynomialFit fit(std::span(track.smoothed).subspan(from, count), firstFrame(track) + Index(from),
                                rule.leastDeviation);
        const Index end = direction > 0 ? way.last() : way.first;
        std::vector<double> beyond;
        for (Index i = 1; i <= rule.extension; ++i) {
            const auto frame = double(end + direction * i);
            if (!(fit.positionVarianceAt(frame) <= rule.farthest * rule.farthest))
                break;
            beyond.push_back(fit.positionAt(frame));
        }
        if (direction < 0) {
            way.first -= std::ssize(beyond);
            std::reverse(beyond.begin(), beyond.end());
            beyond.insert(beyond.end(), way.positions.begin(), way.positions.end());
            std::swap(way.positions, beyond);
        } else {
            way.positions.insert(way.positions.end(), beyond.begin(), beyond.end());
        }
        return way;
    }

    /// Frames in which two paths are near or cross.
    std::vector<Frames> meetings(const Way &a, const Way &b, const EncounterRule &rule)
    {
        std::vector<Frames> result;
        const Index first = std::max(a.first, b.first);
        const Index last = std::min(a.last(), b.last());
        double before = 0.0;
        for (Index frame = first; frame <= last; ++frame) {
            const double distance = a.at(frame) - b.at(frame);
            const bool crosses = frame > first && before * distance < 0.0;
            before = distance;
            if (std::abs(distance) >= rule.near && !crosses)
                continue;
            const Index from = crosses ? frame - 1 : frame;
            if (!result.empty() && from - result.back().to <= rule.joined)
                result.back().to = frame;
            else
                result.push_back({from, frame});
        }
        for (Frames &frames : result) {
            frames.from -= rule.widening;
            frames.to += rule.widening;
        }
        return result;
    }

    void mark(const Track &track, const Frames &frames, std::vector<bool> &marks)
    {
        const Index from = std::max(frames.from, firstFrame(track));
        const Index to = std::min(frames.to, lastFrame(track));
        for (Index frame = from; frame <= to; ++frame)
            marks[std::size_t(frame - firstFrame(track))] = true;
    }

    /// Marks a track that approached another one and ended beside it, from where it came near: its last positions are
    /// those that the other signal left it. Nothing is marked where it came near quickly, where little of the track
    /// would remain, or where both ran side by side all the time.
    void markApproach(const Track &track, bool isFirst, const Track &beside, const EncounterRule &rule,
                      std::vector<bool> &marks)
    {
        const Index end = isFirst ? firstFrame(track) : lastFrame(track);
        const Index inwards = isFirst ? 1 : -1;
        Index near = end;
        for (Index frame = end; track.isThere(frame) && beside.isThere(frame); frame += inwards) {
            const double apart = std::abs(track.positionAt(frame) - beside.positionAt(frame));
            if (apart < rule.endNear)
                near = frame;
            const Index run = std::abs(end - near) + 1;
            const bool isLong = run >= rule.fitFrames / 4 && std::ssize(track.smoothed) - run >= rule.fitFrames / 2;
            if (apart >= approachInEndNears * rule.endNear && isLong)
                return mark(track, {std::min(end, near), std::max(end, near)}, marks);
        }
    }

    /// Marks both tracks where one of them ends beside the other.
    void markEnds(const Track &track, const Track &beside, const EncounterRule &rule, std::vector<bool> &marks,
                  std::vector<bool> &marksBeside)
    {
        for (const bool isFirst : {true, false}) {
            const Index end = isFirst ? firstFrame(track) : lastFrame(track);
            if (!beside.isThere(end) || std::abs(track.positionAt(end) - beside.positionAt(end)) >= rule.endNear)
                continue;
            mark(beside, {end - rule.endFrames, end + rule.endFrames}, marksBeside);
            markApproach(track, isFirst, beside, rule, marks);
        }
    }

    class Encounters
    {
    public:
        Encounters(const std::vector<Track> &tracks, const EncounterRule &rule) : m_tracks(tracks), m_rule(rule)
        {
            for (const Track &track : tracks)
                m_marks.emplace_back(track.smoothed.size(), false);
        }

        std::vector<std::vector<bool>> run()
        {
            markWhatIsSeen();
            std::vector<std::vector<Run>> runs;
            for (const std::vector<bool> &marks : m_marks)
                runs.push_back(runsOf(marks));
            for (std::size_t lost = 0; lost < m_tracks.size(); ++lost)
                for (const Index direction : {1, -1})
                    markWhereLost(lost, runs, direction);
            return std::move(m_marks);
        }

    private:
        void markWhatIsSeen()
        {
            std::vector<Way> ways;
            for (const Track &track : m_tracks) {
                ways.push_back(measured(track, {0, track.smoothed.size()}));
                for (const double position : ways.back().positions) {
                    ways.back().low = std::min(ways.back().low, position);
                    ways.back().high = std::max(ways.back().high, position);
                }
            }
            const double reach = std::max(m_rule.near, m_rule.endNear);
            for (std::size_t i = 0; i < ways.size(); ++i)
                for (std::size_t j = i + 1; j < ways.size(); ++j) {
                    const Way &a = ways[i];
                    const Way &b = ways[j];
                    if (a.first > b.last() || b.first > a.last() || a.low > b.high + reach || b.low > a.high + reach)
                        continue;
                    for (const Frames &frames : meetings(a, b, m_rule)) {
                        mark(m_tracks[i], frames, m_marks[i]);
                        mark(m_tracks[j], frames, m_marks[j]);
                    }
                    markEnds(m_tracks[j], m_tracks[i], m_rule, m_marks[j], m_marks[i]);
                    markEnds(m_tracks[i], m_tracks[j], m_rule, m_marks[i], m_marks[j]);
                }
        }

        /// If a track is lost beside others, the encounter lasts as long as the extrapolated paths stay near each
        /// other: a signal that is seen later may be any of them.
        void markWhereLost(std::size_t lost, const std::vector<std::vector<Run>> &runs, Index direction)
        {
            const bool isForward = direction > 0;
            const Track &track = m_tracks[lost];
            const Way way = extended(track, isForward ? runs[lost].back() : runs[lost].front(), direction, m_rule);
            const Index end = firstFrame(track) + Index(isForward ? runs[lost].back().to - 1 : runs[lost].front().from);
            for (std::size_t other = 0; other < m_tracks.size(); ++other) {
                const Track &beside = m_tracks[other];
                if (other == lost || firstFrame(beside) > end || lastFrame(beside) < end)
                    continue;
                const Run *run = nullptr;
                for (const Run &candidate : runs[other]) {
                    const Index from = firstFrame(beside) + Index(candidate.from);
                    const Index to = firstFrame(beside) + Index(candidate.to) - 1;
                    if (isForward ? from <= end : (to >= end && !run))
                        run = &candidate;
                }
                if (!run)
                    continue;
                for (const Frames &frames : meetings(way, extended(beside, *run, direction, m_rule), m_rule)) {
                    const bool isBeyond = isForward ? frames.to > end : frames.from < end;
                    if (isBeyond)
                        mark(beside, frames, m_marks[other]);
                }
            }
        }

        const std::vector<Track> &m_tracks;
        const EncounterRule &m_rule;
        std::vector<std::vector<bool>> m_marks;
    };

} // namespace

std::vector<std::vector<bool>> encounters(const std::vector<Track> &tracks, const EncounterRule &rule)
{
    return Encounters(tracks, rule).run();
}

} // namespace faintline

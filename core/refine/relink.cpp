#include "refine/relink.h"

#include "refine/PolynomialFit.h"
#include "refine/assign.h"
#include "refine/constants.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace faintline {

namespace {

    /// A stretch of a track between encounters: points from … to, exclusive.
    struct Piece {
        std::size_t track;
        std::size_t from;
        std::size_t to;
        double slopeVariance = 0.0; ///< q, (cells per frame)²
        double startDb = 0.0;
        double endDb = 0.0;
    };

    double meanDb(std::span<const SmoothedPoint> points)
    {
        double sum = 0.0;
        for (const SmoothedPoint &point : points)
            sum += double(point.level);
        return 10.0 * std::log10(std::max(0.05, sum / double(points.size())));
    }

    class Relinking
    {
    public:
        Relinking(std::vector<Track> tracks, const RelinkRule &rule) : m_tracks(std::move(tracks)), m_rule(rule) {}

        std::vector<Track> run()
        {
            cut();
            link();
            return build();
        }

    private:
        Index m() const { return m_rule.slopeFrames; }
        Index longestAbsence() const { return m() / 5; }
        double cells(double resolutionCells) const { return resolutionCells * m_rule.binsPerCell; }

        /// Whether its track has another piece before this one.
        bool isAfterAnother(std::size_t number) const
        {
            return number > 0 && m_pieces[number - 1].track == m_pieces[number].track;
        }

        bool isBeforeAnother(std::size_t number) const
        {
            return number + 1 < m_pieces.size() && isAfterAnother(number + 1);
        }

        Index startOf(const Piece &piece) const { return m_tracks[piece.track].points[piece.from].frame; }
        Index endOf(const Piece &piece) const { return m_tracks[piece.track].points[piece.to - 1].frame; }

        std::span<const SmoothedPoint> pointsOf(const Piece &piece) const
        {
            return std::span(m_tracks[piece.track].smoothed).subspan(piece.from, piece.to - piece.from);
        }

        void cut()
        {
            EncounterRule rule;
            rule.near = cells(encounterCells);
            rule.endNear = cells(endNearCells);
            rule.joined = Index(std::lround(joinedSlopeLengths * double(m())));
            rule.widening = m() / 5;
            rule.fitFrames = m() << (fitLengthOctaves - 1);
            rule.extension = gapSlopeLengths * m();
            rule.farthest = cells(knownWayCells);
            rule.leastDeviation = cells(leastErrorCells);
            const auto marks = encounters(m_tracks, rule);
            for (std::size_t i = 0; i < m_tracks.size(); ++i) {
                const std::size_t first = m_pieces.size();
                for (std::size_t from = 0; from < marks[i].size();) {
                    std::size_t to = from;
                    while (to < marks[i].size() && marks[i][to] == marks[i][from])
                        ++to;
                    const bool isBetween = from > 0 && to < marks[i].size(); // two encounters
                    if (!marks[i][from] && Index(to - from) >= (isBetween ? m() / 2 : fewestPieceFrames))
                        m_pieces.push_back({i, from, to});
                    from = to;
                }
                if (m_pieces.size() == first) // nothing but encounters
                    m_pieces.push_back({i, 0, marks[i].size()});
            }
            for (Piece &piece : m_pieces) {
                const auto points = pointsOf(piece);
                const std::size_t count = std::min(points.size(), std::size_t(m()));
                piece.startDb = meanDb(points.first(count));
                piece.endDb = meanDb(points.last(count));
                piece.slopeVariance = slopeVariance(points);
            }
            m_next.assign(m_pieces.size(), none);
            m_previous.assign(m_pieces.size(), none);
        }

        /// Half the mean square of the differences of the slopes of neighbouring blocks, without that of their errors.
        double slopeVariance(std::span<const SmoothedPoint> points) const
        {
            const auto block = std::size_t(std::max<Index>(4, m() / 2));
            double sum = 0.0;
            double errors = 0.0;
            double count = 0.0;
            std::optional<PolynomialFit> before;
            for (std::size_t from = 0; from + block <= points.size(); from += block) {
                const PolynomialFit fit(points.subspan(from, block), Index(from), cells(leastErrorCells));
                const auto middle = [&](std::size_t first) { return double(first) + 0.5 * double(block - 1); };
                if (before) {
                    const double change = fit.slopeAt(middle(from)) - before->slopeAt(middle(from - block));
                    sum += 0.5 * change * change;
                    errors += 0.5 * (fit.slopeVarianceAt(middle(from)) + before->slopeVarianceAt(middle(from - block)));
                    count += 1.0;
                }
                before = fit;
            }
            return count > 0.0 ? std::max(0.0, (sum - errors) / count) : 0.0;
        }

        std::size_t fitLength(const Piece &piece, Index gap) const
        {
            const auto wanted = std::size_t(std::clamp(gap, m(), m() << (fitLengthOctaves - 1)));
            return std::min(wanted, piece.to - piece.from);
        }

        PolynomialFit fitAtEnd(const Piece &piece, Index gap) const
        {
            const std::size_t count = fitLength(piece, gap);
            return {pointsOf(piece).last(count), endOf(piece) - Index(count) + 1, cells(leastErrorCells)};
        }

        PolynomialFit fitAtStart(const Piece &piece, Index gap) const
        {
            return {pointsOf(piece).first(fitLength(piece, gap)), startOf(piece), cells(leastErrorCells)};
        }

        double costOf(const Piece &a, const Piece &b) const
        {
            const Index gap = startOf(b) - endOf(a);
            const PolynomialFit before = fitAtEnd(a, gap);
            const PolynomialFit after = fitAtStart(b, gap);
            const double middle = 0.5 * double(endOf(a) + startOf(b));
            const double half = 0.5 * double(gap);
            const double q = std::max(a.slopeVariance, b.slopeVariance);
            const double least = cells(changedPositionCells) * cells(changedPositionCells);
            const double variance =
                before.positionVarianceAt(middle) + after.positionVarianceAt(middle) + q * half * half + least;
            const double leastSlope = cells(0.1) / double(m());
            const double slopes =
                before.slopeVarianceAt(middle) + after.slopeVarianceAt(middle) + 2.0 * q + leastSlope * leastSlope;
            const auto square = [](double value) { return value * value; };
            return 0.5
                   * (square(before.positionAt(middle) - after.positionAt(middle)) / variance
                      + std::log(variance / least) + square(before.slopeAt(middle) - after.slopeAt(middle)) / slopes
                      + square((a.endDb - b.startDb) / changedLevelDb));
        }

        /// The cubic between the ends of two pieces, with their slopes there: one position for each frame of the gap.
        std::vector<double> wayBetween(const Piece &a, const Piece &b) const
        {
            const Index gap = startOf(b) - endOf(a);
            const auto g = double(gap);
            const double from = pointsOf(a).back().position;
            const double to = pointsOf(b).front().position;
            const double before = fitAtEnd(a, gap).slopeAt(double(endOf(a)));
            const double after = fitAtStart(b, gap).slopeAt(double(startOf(b)));
            std::vector<double> way;
            for (Index i = 1; i < gap; ++i) {
                const double u = double(i) / g;
                const double v = 1.0 - u;
                way.push_back(from * v * v * (1.0 + 2.0 * u) + to * u * u * (1.0 + 2.0 * v)
                              + g * u * v * (before * v - after * u));
            }
            return way;
        }

        /// Whether a signal between two pieces would have been missed where it could have been seen.
        bool isAbsent(const Piece &a, const Piece &b) const
        {
            const double absence = m_rule.absence(std::pow(10.0, 0.1 * std::min(a.endDb, b.startDb)));
            Index visible = 0;
            Index frame = endOf(a);
            for (const double position : wayBetween(a, b))
                if (isVisible(++frame, position)
                    && (++visible > longestAbsence() || double(visible) * absence > m_rule.threshold))
                    return true;
            return false;
        }

        /// Whether the end of one's track and the beginning of the other's were seen at the same time, as two signals.
        bool areSeenTogether(std::size_t from, std::size_t to) const
        {
            const Piece &a = m_pieces[from];
            const Piece &b = m_pieces[to];
            return !isBeforeAnother(from) && !isAfterAnother(to)
                   && m_tracks[a.track].points.back().frame - m_tracks[b.track].points.front().frame >= m() / 5;
        }

        bool isVisible(Index frame, double position) const
        {
            return std::none_of(m_tracks.begin(), m_tracks.end(), [&](const Track &track) {
                return track.isThere(frame) && std::abs(track.positionAt(frame) - position) < cells(crossingHidesCells);
            });
        }

        /// A rough bound on the way between two pieces, before anything is fitted.
        bool isInReach(const Piece &a, const Piece &b) const
        {
            const Index gap = startOf(b) - endOf(a);
            return gap >= 1 && gap <= gapSlopeLengths * m()
                   && std::abs(pointsOf(a).back().position - pointsOf(b).front().position)
                          <= m_steepest * double(gap) + cells(endNearCells);
        }

        bool isMeasured(const PairCost &pair) const
        {
            return isOwnWay(pair.from, pair.to) || startOf(m_pieces[pair.to]) - endOf(m_pieces[pair.from]) == 1
                   || m_bridges.contains({pair.from, pair.to});
        }

        BridgeWay bridgeWay(const PairCost &pair) const
        {
            const auto a = pointsOf(m_pieces[pair.from]);
            const auto b = pointsOf(m_pieces[pair.to]);
            const auto before = a.last(std::min(a.size(), std::size_t(BridgeWay::pieceFrames)));
            const auto after = b.first(std::min(b.size(), std::size_t(BridgeWay::pieceFrames)));
            BridgeWay way;
            way.firstFrame = endOf(m_pieces[pair.from]) + 1 - std::ssize(before);
            way.before.assign(before.begin(), before.end());
            way.after.assign(after.begin(), after.end());
            for (const SmoothedPoint &point : before)
                way.positions.push_back(point.position);
            for (const double position : wayBetween(m_pieces[pair.from], m_pieces[pair.to]))
                way.positions.push_back(std::clamp(position, 0.0, double(m_rule.cells - 1)));
            for (const SmoothedPoint &point : after)
                way.positions.push_back(point.position);
            return way;
        }

        bool isRefuted(const Bridge &bridge) const
        {
            const auto seen = std::count(bridge.isSeen.begin(), bridge.isSeen.end(), true);
            return bridge.absence > m_rule.threshold || (seen > longestAbsence() && bridge.gain < 0.0);
        }

        /// Measures the chosen pairs that were not measured before, and removes those that their own cells refute.
        /// Returns whether there were any.
        bool removeRefuted(std::vector<PairCost> &pairs, const std::vector<std::size_t> &chosen)
        {
            std::vector<std::size_t> asked;
            std::vector<BridgeWay> ways;
            for (const std::size_t number : chosen)
                if (!isMeasured(pairs[number])) {
                    asked.push_back(number);
                    ways.push_back(bridgeWay(pairs[number]));
                }
            if (ways.empty())
                return false;
            std::vector<Bridge> bridges = m_rule.measure(ways);
            std::vector<bool> isWrong(pairs.size(), false);
            for (std::size_t i = 0; i < asked.size(); ++i) {
                const PairCost &pair = pairs[asked[i]];
                if (isRefuted(bridges[i]))
                    isWrong[asked[i]] = true;
                else
                    m_bridges.emplace(std::pair(pair.from, pair.to), std::move(bridges[i]));
            }
            std::size_t number = 0;
            return std::erase_if(pairs, [&](const PairCost &) { return isWrong[number++]; }) > 0;
        }

        void link()
        {
            std::vector<PairCost> pairs = possiblePairs();
            std::vector<std::size_t> links = assign(pairs, m_rule.threshold);
            while (removeRefuted(pairs, links))
                links = assign(pairs, m_rule.threshold);
            for (const std::size_t chosen : links) {
                const PairCost &pair = pairs[chosen];
                m_next[pair.from] = pair.to;
                m_previous[pair.to] = pair.from;
                if (const auto found = m_bridges.find({pair.from, pair.to}); found != m_bridges.end())
                    settle(found->second, pair);
            }
        }

        std::vector<PairCost> possiblePairs()
        {
            for (const Piece &piece : m_pieces)
                for (const PolynomialFit &fit : {fitAtEnd(piece, 1), fitAtStart(piece, 1)})
                    if (const double slope = std::abs(fit.slopeAt(double(endOf(piece)))); piece.to - piece.from >= 8)
                        m_steepest = std::max(m_steepest, slope);
            std::vector<std::size_t> byStart(m_pieces.size());
            for (std::size_t i = 0; i < byStart.size(); ++i)
                byStart[i] = i;
            std::stable_sort(byStart.begin(), byStart.end(), [this](std::size_t a, std::size_t b) {
                return startOf(m_pieces[a]) < startOf(m_pieces[b]);
            });
            std::vector<PairCost> pairs;
            for (std::size_t i = 0; i < m_pieces.size(); ++i) {
                const Piece &a = m_pieces[i];
                auto at = std::upper_bound(byStart.begin(), byStart.end(), endOf(a),
                                           [this](Index frame, std::size_t b) { return frame < startOf(m_pieces[b]); });
                for (; at != byStart.end() && startOf(m_pieces[*at]) - endOf(a) <= gapSlopeLengths * m(); ++at) {
                    const Piece &b = m_pieces[*at];
                    const bool isOwn = *at == i + 1 && a.track == b.track;
                    if (isOwn || !isInReach(a, b) || areSeenTogether(i, *at))
                        continue;
                    if (const double cost = costOf(a, b); cost < m_rule.threshold && !isAbsent(a, b))
                        pairs.push_back({i, *at, cost});
                }
                if (isBeforeAnother(i))
                    pairs.push_back(
                        {i, i + 1, std::min(costOf(a, m_pieces[i + 1]), ownWayThresholds * m_rule.threshold)});
            }
            return pairs;
        }

        bool isOwnWay(std::size_t from, std::size_t to) const
        {
            return to == from + 1 && m_pieces[from].track == m_pieces[to].track;
        }

        std::vector<Track> build()
        {
            std::vector<std::size_t> best(m_tracks.size(), none); // piece with the largest gain of each track
            for (std::size_t i = 0; i < m_pieces.size(); ++i) {
                std::size_t &piece = best[m_pieces[i].track];
                if (piece == none || gainOf(i) > gainOf(piece))
                    piece = i;
            }
            std::vector<Track> result;
            for (std::size_t first = 0; first < m_pieces.size(); ++first) {
                if (m_previous[first] != none)
                    continue;
                std::vector<std::size_t> chain;
                for (std::size_t i = first; i != none; i = m_next[i])
                    chain.push_back(i);
                if (isWhole(chain)) {
                    result.push_back(std::move(m_tracks[m_pieces[first].track])); // no other chain needs it
                    continue;
                }
                Track track = joined(chain);
                const bool hasBest = std::any_of(chain.begin(), chain.end(),
                                                 [&](std::size_t i) { return best[m_pieces[i].track] == i; });
                if (!hasBest && track.peakStatistic < m_rule.threshold)
                    continue;
                track.peakStatistic = std::max(track.peakStatistic, m_rule.threshold);
                result.push_back(std::move(track));
            }
            return result;
        }

        /// Whether a chain is a track as it was.
        bool isWhole(const std::vector<std::size_t> &chain) const
        {
            const std::size_t track = m_pieces[chain.front()].track;
            const bool isOne =
                std::all_of(chain.begin(), chain.end(), [&](std::size_t i) { return m_pieces[i].track == track; });
            const bool hasAll = chain.back() - chain.front() + 1 == chain.size();
            return isOne && hasAll && !isAfterAnother(chain.front()) && !isBeforeAnother(chain.back());
        }

        /// First point of a piece with half of the encounter before it.
        std::size_t firstWithHalf(std::size_t number) const
        {
            return isAfterAnother(number) ? (m_pieces[number - 1].to + m_pieces[number].from) / 2 : 0;
        }

        /// One past the last point of a piece with half of the encounter behind it.
        std::size_t endWithHalf(std::size_t number) const
        {
            return isBeforeAnother(number) ? (m_pieces[number].to + m_pieces[number + 1].from) / 2
                                           : m_tracks[m_pieces[number].track].points.size();
        }

        /// Gain of the path's statistic along a piece and half of the encounters on either side.
        double gainOf(std::size_t number) const
        {
            const std::vector<TrackPoint> &points = m_tracks[m_pieces[number].track].points;
            const std::size_t first = firstWithHalf(number);
            return points[endWithHalf(number) - 1].statistic - (first > 0 ? points[first - 1].statistic : 0.0);
        }

        /// First point that belongs to a piece if nothing is linked before it.
        std::size_t firstPoint(std::size_t number) const
        {
            return isAfterAnother(number) && m_next[number - 1] != none ? m_pieces[number].from : firstWithHalf(number);
        }

        std::size_t endPoint(std::size_t number) const
        {
            return isBeforeAnother(number) && m_previous[number + 1] != none ? m_pieces[number].to
                                                                             : endWithHalf(number);
        }

        Track joined(const std::vector<std::size_t> &chain) const
        {
            const Track &first = m_tracks[m_pieces[chain.front()].track];
            Track track = first.withoutPoints();
            for (std::size_t i = 0; i < chain.size(); ++i) {
                const Piece &piece = m_pieces[chain[i]];
                const bool isOwnBefore = i > 0 && isOwnWay(chain[i - 1], chain[i]);
                const std::size_t from = i == 0        ? firstPoint(chain[i])
                                         : isOwnBefore ? m_pieces[chain[i - 1]].to
                                                       : piece.from;
                if (i > 0 && !isOwnBefore)
                    bridge(track, chain[i - 1], chain[i]);
                append(track, m_tracks[piece.track], from, i + 1 == chain.size() ? endPoint(chain[i]) : piece.to);
            }
            track.takeEndsOfPoints();
            const std::vector<double> scores = scoresOf(track);
            track.peakStatistic = *std::max_element(scores.begin(), scores.end());
            describe(track, chain);
            return track;
        }

        static void append(Track &track, const Track &from, std::size_t begin, std::size_t end)
        {
            const double offset = (track.points.empty() ? 0.0 : track.points.back().statistic)
                                  - (begin > 0 ? from.points[begin - 1].statistic : 0.0);
            for (std::size_t i = begin; i < end; ++i) {
                track.points.push_back(from.points[i]);
                track.points.back().statistic += offset;
                track.smoothed.push_back(from.smoothed[i]);
            }
        }

        /// Gain of a track's statistic in a frame in which it is there.
        static double gainAt(const Track &track, Index frame)
        {
            const std::size_t i = track.pointIndex(frame);
            return track.points[i].statistic - (i > 0 ? track.points[i - 1].statistic : 0.0);
        }

        /// Score of a path along a track's points by itself. It begins anew where the statistic falls below its start,
        /// as it does where a lost signal was found again (joinTracks.h).
        static std::vector<double> scoresOf(const Track &track)
        {
            std::vector<double> scores;
            double score = 0.0;
            for (const TrackPoint &point : track.points)
                scores.push_back(score = std::max(0.0, score + gainAt(track, point.frame)));
            return scores;
        }

        /// Gain of the statistic in a frame between two linked pieces: of the first one's track up to the middle, then
        /// of the second one's; where one of these has its end, of the other.
        double gainBetween(std::size_t from, std::size_t to, Index frame) const
        {
            const Track &a = m_tracks[m_pieces[from].track];
            const Track &b = m_tracks[m_pieces[to].track];
            const bool isFirstHalf = 2 * frame <= endOf(m_pieces[from]) + startOf(m_pieces[to]);
            const bool isInA = frame <= a.points.back().frame && (isFirstHalf || !isBeforeAnother(from));
            const bool isInB = frame >= b.points.front().frame && (!isFirstHalf || !isAfterAnother(to));
            return isInA && (isFirstHalf || !isInB) ? gainAt(a, frame) : isInB ? gainAt(b, frame) : 0.0;
        }

        /// What was measured nearest to a position, of a signal that is not much stronger; null if there is none.
        const SmoothedPoint *measuredAt(Index frame, double position, double level) const
        {
            const SmoothedPoint *nearest = nullptr;
            double least = cells(onPathCells);
            for (const Track &track : m_tracks) {
                if (!track.isThere(frame))
                    continue;
                const SmoothedPoint &point = track.smoothedAt(frame);
                const double apart = std::abs(point.position - position);
                if (apart <= least && point.presence > 0.5f && double(point.level) <= comparableLevelRatio * level) {
                    least = apart;
                    nearest = &point;
                }
            }
            return nearest;
        }

        static bool isSeenNear(const Bridge &bridge, Index at)
        {
            const Index last = std::ssize(bridge.isSeen) - 1;
            if (at < seenWithinFrames || last - at < seenWithinFrames) // the pieces themselves
                return true;
            const auto from = bridge.isSeen.begin() + (at - seenWithinFrames);
            return std::find(from, from + 2 * seenWithinFrames + 1, true) != from + 2 * seenWithinFrames + 1;
        }

        /// Replaces the points of a bridge by those of an equal signal, and leaves out what could not be seen.
        void settle(Bridge &measured, const PairCost &pair) const
        {
            const float level =
                std::max(pointsOf(m_pieces[pair.from]).back().level, pointsOf(m_pieces[pair.to]).front().level);
            Index frame = endOf(m_pieces[pair.from]);
            for (Index at = 0; at < std::ssize(measured.points); ++at) {
                SmoothedPoint &point = measured.points[std::size_t(at)];
                if (const SmoothedPoint *own = measuredAt(++frame, point.position, double(level)))
                    point = *own;
                else if (!isSeenNear(measured, at))
                    point.presence = 0.0f;
            }
        }

        /// Fills the gap between two pieces with what was measured there. What their tracks gained there is evidence
        /// for the signals that meet, whichever of them a track followed.
        void bridge(Track &track, std::size_t last, std::size_t next) const
        {
            const auto found = m_bridges.find({last, next});
            if (found == m_bridges.end()) // adjacent frames
                return;
            const TrackPoint end = track.points.back();
            Index frame = end.frame;
            double statistic = end.statistic;
            for (const SmoothedPoint &point : found->second.points) {
                statistic += gainBetween(last, next, ++frame);
                track.points.push_back({frame, Index(std::lround(point.position)), end.plane, statistic});
                track.smoothed.push_back(point);
            }
        }

        /// Detection and confirmation are those of the first of its tracks that was detected along it, or where its own
        /// statistic reaches the threshold.
        void describe(Track &track, const std::vector<std::size_t> &chain) const
        {
            const Track *detected = nullptr;
            for (const std::size_t i : chain) {
                const Piece &piece = m_pieces[i];
                const Track &own = m_tracks[piece.track];
                track.isConfirmed = track.isConfirmed || own.isConfirmed;
                if (own.detectFrame >= startOf(piece) && own.detectFrame <= endOf(piece)
                    && (!detected || own.detectFrame < detected->detectFrame))
                    detected = &own;
            }
            const std::vector<double> scores = scoresOf(track);
            const auto reached =
                std::find_if(scores.begin(), scores.end(), [this](double score) { return score >= m_rule.threshold; });
            const Index own = reached == scores.end() ? track.endFrame : track.onsetFrame + (reached - scores.begin());
            track.detectFrame = detected ? detected->detectFrame : own;
            const Track &last = m_tracks[m_pieces[chain.back()].track];
            track.isOpen = last.isOpen && track.endFrame == last.endFrame;
            if (detected) {
                track.detectStatistic = detected->detectStatistic;
                track.confirmFrame = detected->confirmFrame;
                track.id = detected->id;
            }
            if (track.isConfirmed)
                track.confirmFrame = std::clamp(track.confirmFrame, track.detectFrame, track.endFrame);
        }

        static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

        std::vector<Track> m_tracks;
        const RelinkRule &m_rule;
        std::vector<Piece> m_pieces; ///< by track, then time
        std::vector<std::size_t> m_next;
        std::vector<std::size_t> m_previous;
        std::map<std::pair<std::size_t, std::size_t>, Bridge> m_bridges; ///< between pieces of different tracks
        double m_steepest = 0.0;                                         ///< slope of any piece, cells per frame
    };

} // namespace

std::vector<Track> relink(std::vector<Track> tracks, const RelinkRule &rule)
{
    constexpr int rounds = 2; // the second one sees longer pieces
    for (int round = 0; round < rounds; ++round)
        tracks = Relinking(std::move(tracks), rule).run();
    return tracks;
}

} // namespace faintline

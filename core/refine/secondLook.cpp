#include "refine/secondLook.h"

#include "frames/Window.h"
#include "refine/TrackPiece.h"
#include "refine/bothWays.h"
#include "refine/constants.h"
#include "refine/decideJointly.h"
#include "refine/explainPath.h"
#include "refine/explanation.h"
#include "refine/levelBeside.h"
#include "refine/numberByDetection.h"
#include "refine/pathStrips.h"
#include "refine/relink.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace faintline {

namespace {

    constexpr std::string_view following = "refining tracks in both directions";

    struct Stretch {
        Index from;      ///< frames of the piece's strip
        Index to;        ///< one past the last
        double gain;     ///< gain of the path's statistic, nat
        double evidence; ///< evidence of the mean path, nat
    };

    /// Where a track of the chain is in a frame.
    struct OtherPath {
        Index cell;
        const Track *track;
    };

    /// Result of a stretch, or of several that were separated by the cuts between pieces.
    struct StretchResult {
        Track track;
        std::vector<ExplainedSignal> signals;
        double gain;
        double evidence;
    };

    bool isObserved(const PathStrip &strip, Index at)
    {
        const auto row = strip.y.begin() + at * strip.width();
        return std::any_of(row, row + strip.width(), [](float y) { return !std::isnan(y); });
    }

    /// Of frames that were not observed nobody knows whether the signal was there: it is not reported.
    BothWays lookAtObserved(const PathStrip &strip, const BothWaysModel &model)
    {
        BothWays seen = lookBothWays(strip, model);
        for (Index at = 0; at < strip.frameCount(); ++at)
            if (!isObserved(strip, at))
                seen.endsBy[std::size_t(at)] = 0.0f;
        return seen;
    }

    /// The point at a frame, or the nearest one.
    const TrackPoint &pointAt(const Track &track, Index frame)
    {
        const Index first = track.points.front().frame;
        return track.points[std::size_t(std::clamp(frame, first, track.points.back().frame) - first)];
    }

    /// Frames over which a track's way is measured: the faster the law, the fewer.
    Index slopeFramesOf(const KinematicAxis &axis)
    {
        constexpr double slowLawFrames = 56.0;
        constexpr double fastLawFrames = 16.0; // from a largest slope of four cells per frame on
        const double steepest = std::max({1.0, std::abs(axis.rate(0)), std::abs(axis.rate(axis.rateCount - 1))});
        return Index(std::lround(
            std::max(fastLawFrames,
                     slowLawFrames * std::pow(steepest, std::log(fastLawFrames / slowLawFrames) / std::log(4.0)))));
    }

    /// Mean evidence, in a frame of noise alone, against a signal of that level, nat. A level above 4 counts as 4, so
    /// that a keyed line is one signal.
    double evidenceOfAbsence(LikelihoodKind kind, double level)
    {
        constexpr int quantiles = 128;
        const Likelihood likelihood(kind, std::clamp(level, 0.1, 4.0));
        double sum = 0.0;
        for (int i = 0; i < quantiles; ++i)
            sum -= likelihood.at(-std::log((i + 0.5) / quantiles));
        return sum / quantiles;
    }

    Explanations explanationsOf(const Analysis &analysis)
    {
        const NormalisedFrames &frames = *analysis.frames;
        /// The window's leakage over a distance in bins that is known to `error` cells.
        const auto around = [geometry = frames.geometry()](double (*leakage)(WindowShape, double), double error) {
            return [=](double bins) {
                const double cells = bins / geometry.binsPerCell;
                return std::max({leakage(geometry.window, std::max(0.0, cells - error)),
                                 leakage(geometry.window, cells), leakage(geometry.window, cells + error)});
            };
        };
        const bool isAlone = analysis.settings.noise.causal; // nothing is explained: no tables
        return {isAlone ? 0 : frames.grid().size(), around(leakageBound, 0.0), around(leakageAt, 0.02)};
    }

    std::vector<PathStrip *> stripsOf(std::vector<TrackPiece> &pieces)
    {
        std::vector<PathStrip *> strips;
        for (TrackPiece &piece : pieces)
            strips.push_back(&piece.strip);
        return strips;
    }

    class SecondLook
    {
    public:
        SecondLook(const Analysis &analysis, const RunContext &context)
            : SecondLook(analysis, context, {{}, {}, {}, explanationsOf(analysis)})
        {
        }

        SecondLook(const Analysis &analysis, const RunContext &context, SecondView view)
            : m_analysis(analysis), m_context(context), m_frames(*analysis.frames), m_cells(m_frames.grid().size()),
              m_isAlone(analysis.settings.noise.causal), m_geometry(m_frames.geometry()),
              m_likeness(m_geometry.likeness()), m_overlap(m_geometry.overlap()),
              m_explanations(std::move(view.explanations)), m_model(bothWaysModel(analysis)),
              m_tracks(std::move(view.tracks)), m_areas(std::move(view.areas)),
              m_explainedByNoise(std::move(view.explainedByNoise))
        {
        }

        SecondView result()
        {
            return {std::move(m_tracks), std::move(m_areas), std::move(m_explainedByNoise), std::move(m_explanations)};
        }

        void lookBehindAll()
        {
            searchBehindAll();
            m_tracks = relinked(std::move(m_tracks));
            m_tracks =
                decideJointly(m_analysis, std::move(m_tracks), slopeFramesOf(*m_model.axis), m_context.part(1.0, 1.0));
        }

        void lookAtAll(std::vector<Track> found, std::span<const Track> subtracted, const RunContext &context)
        {
            std::stable_sort(found.begin(), found.end(),
                             [](const Track &a, const Track &b) { return a.peakStatistic > b.peakStatistic; });
            std::vector<TrackPiece> pieces;
            for (const Track &track : subtracted)
                addPieces(pieces, track, m_frames.time().count, m_model.binsPerCell);
            for (const Track &track : found)
                addPieces(pieces, track, m_frames.time().count, m_model.binsPerCell);
            m_paths = pathsByFrame(found);
            readInTurn(m_analysis, stripsOf(pieces), context, following, [&](std::size_t i) {
                pieces[i].track->isSubtracted ? lookAtRest(pieces[i]) : lookAt(pieces[i]);
            });
        }

    private:
        /// Searches behind what is explained, as long as that finds something.
        void searchBehindAll()
        {
            bool isMore = !m_tracks.empty();
            for (int pass = 0; pass < mostPassesBehind && isMore; ++pass) {
                const RunContext context =
                    m_context.part(double(pass) / mostPassesBehind, double(pass + 1) / mostPassesBehind);
                const std::size_t known = m_tracks.size();
                lookAtAll(searchBehind(m_analysis, m_explanations, context.part(0.0, 0.7)), {}, context.part(0.7, 1.0));
                isMore = m_tracks.size() > known;
            }
        }

        /// Replaces the cells of a frame in which a piece of the track itself was measured by that line alone.
        void setPoint(PathStrip &strip, Index at, const SmoothedPoint &point) const
        {
            strip.floor[std::size_t(at)] = 1.0f;
            for (Index i = 0; i < strip.width(); ++i) {
                const double apart = std::abs(double(strip.firstCell(at) + i) - point.position) / m_model.binsPerCell;
                strip.row(at)[i] = 1.0f + point.level * float(leakageBound(m_geometry.window, apart));
            }
        }

        /// Measures ways between pieces of tracks over the floor of everything that was found; frames in which it hides
        /// the way are not observed.
        std::vector<Bridge> measured(std::span<const BridgeWay> ways)
        {
            std::vector<PathStrip> strips;
            for (const BridgeWay &way : ways) {
                PathStrip &strip = strips.emplace_back();
                strip.firstFrame = way.firstFrame;
                strip.halfWidth = bothWaysHalfWidth(m_model.binsPerCell);
                for (const double position : way.positions)
                    strip.centres.push_back(Index(std::lround(position)));
            }
            std::vector<Bridge> bridges(ways.size());
            std::vector<PathStrip *> inTurn;
            for (PathStrip &strip : strips)
                inTurn.push_back(&strip);
            readInTurn(m_analysis, inTurn, m_context.part(1.0, 1.0), following,
                       [&](std::size_t i) { bridges[i] = bridgeAlong(ways[i], strips[i]); });
            return bridges;
        }

        /// Whether the middle of a strip can be seen in a frame; if another signal hides it, none of the frame's cells
        /// counts, or a path would take those that do not count.
        bool isSeenOrCleared(PathStrip &strip, Index at) const
        {
            constexpr float notObserved = std::numeric_limits<float>::quiet_NaN();
            float middle = 0.0f;
            m_explanations.hide(strip.firstFrame + at, strip.centres[std::size_t(at)], std::span(&middle, 1),
                                notObserved);
            if (std::isnan(middle))
                std::fill_n(strip.row(at), strip.width(), notObserved);
            return !std::isnan(middle);
        }

        Bridge bridgeAlong(const BridgeWay &way, PathStrip &strip)
        {
            divideByFloor(strip);
            const Index from = std::ssize(way.before);
            const Index to = from + way.gap();
            Bridge bridge;
            std::vector<bool> wasObserved;
            for (Index at = 0; at < strip.frameCount(); ++at) {
                if (at < from)
                    setPoint(strip, at, way.before[std::size_t(at)]);
                else if (at >= to)
                    setPoint(strip, at, way.after[std::size_t(at - to)]);
                else {
                    wasObserved.push_back(isObserved(strip, at));
                    bridge.isSeen.push_back(isSeenOrCleared(strip, at) && wasObserved.back());
                }
            }
            setLnK(m_model, m_analysis, strip);
            m_model.ends = {};
            const BothWays seen = lookBothWays(strip, m_model);
            double against = 0.0;
            for (Index at = from; at < to; ++at) {
                const auto i = std::size_t(at);
                const double gain = bridge.isSeen[std::size_t(at - from)] ? seen.gains[i] : 0.0;
                bridge.gain += gain;
                against = std::max(0.0, against - gain);
                bridge.absence = std::max(bridge.absence, against);
                bridge.points.push_back({std::clamp(seen.positions[i], 0.0, double(m_cells - 1)), seen.presence.low[i],
                                         seen.presence.high[i],
                                         wasObserved[std::size_t(at - from)] ? seen.endsBy[i] : 0.0f,
                                         float(seen.levels[i])});
            }
            return bridge;
        }

        std::vector<Track> relinked(std::vector<Track> tracks)
        {
            RelinkRule rule;
            rule.threshold = m_analysis.threshold;
            rule.binsPerCell = m_model.binsPerCell;
            rule.cells = m_cells;
            rule.slopeFrames = slopeFramesOf(*m_model.axis);
            rule.absence = [this](double level) { return evidenceOfAbsence(m_model.likelihood.kind(), level); };
            rule.measure = [this](std::span<const BridgeWay> ways) { return measured(ways); };
            return relink(std::move(tracks), rule);
        }

        /// Divides a strip by the floor of stronger tracks; returns whether they raise it.
        bool divideByFloor(PathStrip &strip) const
        {
            bool isRaised = false;
            std::vector<float> floor(std::size_t(strip.width()));
            strip.floor.clear();
            for (Index at = 0; at < strip.frameCount(); ++at) {
                m_explanations.read(strip.firstFrame + at, strip.firstCell(at), floor);
                strip.floor.push_back(floor[std::size_t(strip.halfWidth)]);
                float *y = strip.row(at);
                for (const float level : floor) {
                    *y++ /= level;
                    isRaised = isRaised || level > 1.0f;
                }
            }
            return isRaised;
        }

        /// Loss of a path's score, in nats, if y is replaced by `less`; the strongest of three bins along its way
        /// counts.
        double lossAlongPath(const PathStrip &strip, const PathStrip &less) const
        {
            double loss = 0.0;
            for (Index at = 0; at < strip.frameCount(); ++at) {
                const Index centre = strip.centres[std::size_t(at)];
                const auto lambda = [&](const PathStrip &of) {
                    const float y =
                        std::max({of.valueAt(at, centre), of.valueAt(at, centre - 1), of.valueAt(at, centre + 1)});
                    return std::isnan(y) ? 0.0 : m_model.likelihood.at(double(y));
                };
                loss += lambda(strip) - lambda(less);
            }
            return loss;
        }

        /// Loss of score over the level of its surroundings: in a burst, a cloud or a hum a path is not a signal of its
        /// own.
        double lossOver(const std::vector<double> &levels, const PathStrip &strip) const
        {
            PathStrip alone = strip;
            for (Index at = 0; at < alone.frameCount(); ++at)
                for (float &y : std::span(alone.row(at), std::size_t(alone.width())))
                    y /= float(levels[std::size_t(at)]);
            return lossAlongPath(strip, alone);
        }

        /// Adds the areas in which the levels beside a path are raised, within the examined width.
        void addAreas(const PathStrip &strip, const std::vector<double> &levels)
        {
            const Index half = levelBesideHalfWidth(m_model.binsPerCell);
            for (Index at = 0; at < strip.frameCount(); ++at) {
                const auto i = std::size_t(at);
                if (levels[i] > 1.0)
                    m_areas.push_back({strip.firstFrame + at, strip.firstFrame + at,
                                       std::clamp<Index>(strip.centres[i] - half, 0, m_cells - 1),
                                       std::clamp<Index>(strip.centres[i] + half, 0, m_cells - 1), levels[i]});
            }
        }

        /// Divides the strip by the floor; returns what remains of the track's statistic above that and above the level
        /// of its surroundings, or nothing if it is less than the threshold. Then areas through which it runs are stored.
        std::optional<double> remainderOf(const Track &track, PathStrip &strip)
        {
            const PathStrip before = strip;
            double statistic = track.peakStatistic;
            if (divideByFloor(strip)) {
                const double left = strongestIn(strip, m_model);
                const bool isMore = left >= ghostStatisticShare * statistic; // more than a ghost of the stronger track
                statistic -= strongestIn(before, m_model) - left;
                if (isMore)
                    statistic = std::max(left, statistic);
                if (statistic < m_analysis.threshold)
                    return {};
            }
            if (!m_analysis.settings.family.isNone())
                return statistic; // the family's own members lie one cell beside it
            const std::vector<double> levels = levelBeside(strip, m_model.binsPerCell);
            const double over = statistic - std::max(0.0, lossOver(levels, strip));
            if (over >= m_analysis.threshold || over == statistic)
                return over;
            addAreas(strip, levels);
            return {};
        }

        /// Whether a piece's statistic is beyond what is as common in its surroundings.
        bool exceedsSurroundings(double statistic, const PathStrip &strip, const BothWays &seen) const
        {
            if (!m_analysis.settings.family.isNone())
                return true;
            const PathStrip beside =
                withoutLine(strip, seen.positions, seen.levels, m_geometry.window, m_model.binsPerCell);
            const auto present = std::ranges::count_if(seen.endsBy, [](float share) { return share > 0.5f; });
            return statistic / runsBeside(beside, seen.positions, present, m_model.binsPerCell, m_likeness, m_overlap)
                   >= m_analysis.threshold;
        }

        void lookAt(TrackPiece &piece)
        {
            PathStrip &strip = piece.strip;
            setLnK(m_model, m_analysis, strip);
            if (const std::optional<double> remainder = remainderOf(*piece.track, strip)) {
                m_model.ends = {.absentBefore = piece.isFirst(), .absentAfter = piece.isLast()};
                const BothWays seen = lookAtObserved(withoutOthers(strip, *piece.track), m_model);
                if (exceedsSurroundings(*remainder, strip, seen)) {
                    for (const Stretch &stretch : stretchesOf(piece, seen))
                        propose(piece, seen, stretch);
                } else {
                    m_explainedByNoise.push_back(*piece.track);
                    m_explainedByNoise.back().keepPoints(piece.from, piece.to);
                }
            }
            if (piece.isLast())
                accept();
        }

        /// In each frame in order of the cells.
        static std::vector<std::vector<OtherPath>> pathsByFrame(const std::vector<Track> &tracks)
        {
            std::vector<std::vector<OtherPath>> paths;
            for (const Track &track : tracks) {
                paths.resize(std::max(paths.size(), std::size_t(track.points.back().frame + 1)));
                for (const TrackPoint &point : track.points)
                    paths[std::size_t(point.frame)].push_back({point.cell, &track});
            }
            for (std::vector<OtherPath> &frame : paths)
                std::ranges::stable_sort(frame, {}, &OtherPath::cell);
            return paths;
        }

        /// The paths up to `reach` cells beside that of a strip in a frame.
        std::span<const OtherPath> pathsNear(const PathStrip &strip, Index at, Index reach) const
        {
            const auto frame = std::size_t(strip.firstFrame + at);
            if (frame >= m_paths.size())
                return {};
            const Index centre = strip.centres[std::size_t(at)];
            const auto first = std::ranges::lower_bound(m_paths[frame], centre - reach, {}, &OtherPath::cell);
            const auto end = std::ranges::upper_bound(m_paths[frame], centre + reach, {}, &OtherPath::cell);
            return {first, end};
        }

        /// A strip in which nothing is to be seen in cells that are nearer to another signal: a track that stays well beside
        /// this one, with less than half of either's power midway. A path does not go on along a signal that has a track of
        /// its own.
        PathStrip withoutOthers(const PathStrip &strip, const Track &track) const
        {
            if (m_isAlone)
                return strip;
            const Index beside = Index(std::ceil(meetingCells * m_model.binsPerCell));
            struct Meeting {
                double own = 0.0;
                double other = 0.0;
                double midway = 0.0;
                bool isNear = false;
                bool isApart() const { return !isNear && midway < 0.5 * std::min(own, other); }
            };
            std::map<const Track *, Meeting> others;
            for (Index at = 0; at < strip.frameCount(); ++at) {
                const Index frame = strip.firstFrame + at;
                const Index centre = strip.centres[std::size_t(at)];
                const auto power = [&](Index cell) {
                    const float y = strip.valueAt(at, cell);
                    return std::isnan(y) ? 0.0 : double(y) - 1.0;
                };
                for (const auto &[cell, other] : pathsNear(strip, at, strip.halfWidth)) {
                    if (other == &track)
                        continue;
                    Meeting &meeting = others[other];
                    meeting.isNear = meeting.isNear || std::abs(cell - centre) < beside;
                    if (frame < track.onsetFrame || frame > track.endFrame)
                        continue;
                    meeting.own += power(centre);
                    meeting.other += power(cell);
                    meeting.midway += power((centre + cell) / 2);
                }
            }
            std::erase_if(others, [](const auto &each) { return !each.second.isApart(); });
            PathStrip own = strip;
            for (Index at = 0; at < own.frameCount() && !others.empty(); ++at) {
                const Index centre = own.centres[std::size_t(at)];
                for (const auto &[cell, other] : pathsNear(own, at, 2 * own.halfWidth + beside)) {
                    if (!others.contains(other))
                        continue;
                    const Index middle = centre + (cell - centre) / 2;
                    for (Index i = std::min(middle, cell - beside); i <= std::max(middle, cell + beside); ++i)
                        if (cell > centre ? i > middle : i < middle)
                            if (const Index k = i - own.firstCell(at); k >= 0 && k < own.width())
                                own.row(at)[k] = 0.0f;
                }
            }
            return own;
        }

        /// What subtraction left of a line is not a separate signal.
        void lookAtRest(TrackPiece &piece)
        {
            for (ExplainedSignal &signal : explainSubtracted(piece.strip, m_model.binsPerCell))
                m_explanations.add(std::move(signal));
        }

        void propose(const TrackPiece &piece, const BothWays &seen, const Stretch &stretch)
        {
            Track track = trackOf(piece, seen, stretch);
            ExplainedSignal signal = explainPath(piece.strip, seen, stretch.from, stretch.to, m_model.binsPerCell);
            signal.hides = hiddenCells * m_model.binsPerCell;
            if (m_candidates.empty() || m_candidates.back().track.endFrame + 1 != track.onsetFrame) {
                if (!piece.isLast()) { // long: no room needed beyond that
                    track.points.reserve(piece.track->points.size() - piece.from
                                         + 2 * std::size_t(TrackPiece::extraFrames));
                    track.smoothed.reserve(track.points.capacity());
                }
                m_candidates.push_back({std::move(track), {std::move(signal)}, stretch.gain, stretch.evidence});
                return;
            }
            StretchResult &before = m_candidates.back();
            if (holds(stretch, piece.track->detectFrame - piece.strip.firstFrame))
                before.track.detectFrame = track.detectFrame;
            before.track.endFrame = track.endFrame;
            before.track.isOpen = track.isOpen;
            before.track.points.insert(before.track.points.end(), track.points.begin(), track.points.end());
            before.track.smoothed.insert(before.track.smoothed.end(), track.smoothed.begin(), track.smoothed.end());
            before.signals.push_back(std::move(signal));
            before.gain += stretch.gain;
            before.evidence += stretch.evidence;
        }

        /// Accepts the stretch of a track with the largest gain, and all others with sufficient evidence of their own.
        void accept()
        {
            const auto best =
                std::max_element(m_candidates.begin(), m_candidates.end(),
                                 [](const StretchResult &a, const StretchResult &b) { return a.gain < b.gain; });
            for (auto candidate = m_candidates.begin(); candidate != m_candidates.end(); ++candidate) {
                if (candidate != best && (m_isAlone || candidate->evidence < m_analysis.threshold))
                    continue;
                if (candidate != best)
                    candidate->track.peakStatistic = candidate->evidence;
                m_tracks.push_back(std::move(candidate->track));
                for (ExplainedSignal &signal : candidate->signals)
                    if (!m_isAlone)
                        m_explanations.add(std::move(signal));
            }
            m_candidates.clear();
        }

        /// The stretches of a piece, without those that its neighbours give.
        std::vector<Stretch> stretchesOf(const TrackPiece &piece, const BothWays &seen) const
        {
            const std::vector<TrackPoint> &points = piece.track->points;
            const Index from = piece.isFirst() ? 0 : points[piece.from].frame - piece.strip.firstFrame;
            const Index to =
                piece.isLast() ? piece.strip.frameCount() : points[piece.to].frame - piece.strip.firstFrame;
            const std::vector<float> &present = seen.presence.present;
            const float least = std::min(0.5f, 0.5f * *std::max_element(present.begin(), present.end()));
            std::vector<Stretch> stretches;
            for (Index at = from; at < to; ++at) {
                const auto i = std::size_t(at);
                if (present[i] <= least)
                    continue;
                if (stretches.empty() || (!m_isAlone && at - stretches.back().to > pauseFrames))
                    stretches.push_back({at, at, 0.0, 0.0});
                stretches.back().to = at + 1;
                stretches.back().evidence += seen.gains[i];
            }
            if (m_isAlone && !stretches.empty()) { // goes on in the pieces beside
                stretches.front().from = piece.isFirst() ? stretches.front().from : from;
                stretches.front().to = piece.isLast() ? stretches.front().to : to;
            }
            const auto statistic = [&](Index at) { // of the path up to there
                const Index frame = piece.strip.firstFrame + at;
                return frame < points.front().frame ? 0.0 : pointAt(*piece.track, frame).statistic;
            };
            for (Stretch &stretch : stretches)
                stretch.gain = statistic(stretch.to - 1) - statistic(stretch.from - 1);
            return stretches;
        }

        static bool holds(const Stretch &stretch, Index at) { return at >= stretch.from && at < stretch.to; }

        /// Where the evidence of a stretch alone reached the threshold; or where it was largest, if it never did.
        Index detectionIn(const Stretch &stretch, const BothWays &seen) const
        {
            Index largest = stretch.from;
            double most = 0.0;
            double score = 0.0;
            for (Index at = stretch.from; at < stretch.to; ++at) {
                score = std::max(0.0, score) + seen.gains[std::size_t(at)];
                if (score > most) {
                    most = score;
                    largest = at;
                }
                if (score > m_analysis.threshold)
                    break;
            }
            return largest;
        }

        Track trackOf(const TrackPiece &piece, const BothWays &seen, const Stretch &stretch) const
        {
            const PathStrip &strip = piece.strip;
            const Track &found = *piece.track;
            Track track = found.withoutPoints();
            track.onsetFrame = strip.firstFrame + stretch.from;
            track.endFrame = strip.firstFrame + stretch.to - 1;
            track.isOpen = found.isOpen && track.endFrame + 1 == m_frames.time().count;
            track.detectFrame = holds(stretch, found.detectFrame - strip.firstFrame)
                                    ? found.detectFrame
                                    : strip.firstFrame + detectionIn(stretch, seen);
            if (found.confirmFrame >= 0)
                track.confirmFrame = std::max(found.confirmFrame, track.detectFrame);
            for (Index at = stretch.from; at < stretch.to; ++at) {
                const auto i = std::size_t(at);
                const double position = std::clamp(seen.positions[i], 0.0, double(m_cells - 1));
                const TrackPoint &before = pointAt(found, strip.firstFrame + at);
                track.points.push_back(
                    {strip.firstFrame + at, Index(std::lround(position)), before.plane, before.statistic});
                track.smoothed.push_back(
                    {position, seen.presence.low[i], seen.presence.high[i], seen.endsBy[i], float(seen.levels[i])});
            }
            return track;
        }

        const Analysis &m_analysis;
        const RunContext &m_context;
        const NormalisedFrames &m_frames;
        std::vector<std::vector<OtherPath>> m_paths; ///< of the tracks that are looked at, by frame
        Index m_cells;
        bool m_isAlone; ///< each track is asked without regard to others
        FrameGeometry m_geometry;
        double m_likeness;
        double m_overlap;
        Explanations m_explanations;
        BothWaysModel m_model;
        std::vector<StretchResult> m_candidates; ///< for the current track
        std::vector<Track> m_tracks;
        std::vector<Area> m_areas;
        std::vector<Track> m_explainedByNoise;
    };

} // namespace

bool canLookTwice(const AnalysisSettings &settings)
{
    return std::holds_alternative<SmdSettings>(settings.detector)
           && settings.model.likelihood != LikelihoodKind::Linear;
}

bool looksTwice(const AnalysisPlan &analysis)
{
    return analysis.settings.track.bothWays && canLookTwice(analysis.settings) && analysis.grid().isSpectrum()
           && !analysis.isBank();
}

namespace {

    /// The frames from the first to the last one in which a signal is present; both -1 if there are none.
    struct PresentFrames {
        Index first = -1;
        Index last = -1;
    };

    /// Extends them by those of a piece, whose strip has been read.
    void addPresent(PresentFrames &frames, const TrackPiece &piece, BothWaysModel &model, const Analysis &analysis)
    {
        setLnK(model, analysis, piece.strip);
        model.ends = {.absentBefore = piece.isFirst(), .absentAfter = piece.isLast()};
        const std::vector<float> present = lookAtObserved(piece.strip, model).endsBy;
        for (std::size_t i = piece.from; i < piece.to; ++i) {
            const Index frame = piece.track->points[i].frame;
            if (present[std::size_t(frame - piece.strip.firstFrame)] <= 0.5f)
                continue;
            frames.first = frames.first < 0 ? frame : frames.first;
            frames.last = frame;
        }
    }

} // namespace

bool cutsOnly(const AnalysisPlan &analysis)
{
    return analysis.settings.track.bothWays && analysis.settings.model.likelihood != LikelihoodKind::Linear
           && analysis.grid().isSpectrum() && !analysis.isBank() && analysis.settings.family.isNone()
           && !looksTwice(analysis);
}

std::vector<Track> cutToSignals(const Analysis &analysis, std::vector<Track> tracks, const RunContext &context)
{
    BothWaysModel model = bothWaysModel(analysis);
    std::vector<TrackPiece> pieces;
    for (const Track &track : tracks)
        addPieces(pieces, track, analysis.time().count, model.binsPerCell);
    std::vector<PresentFrames> present(tracks.size());
    readInTurn(analysis, stripsOf(pieces), context, following, [&](std::size_t i) {
        addPresent(present[std::size_t(pieces[i].track - tracks.data())], pieces[i], model, analysis);
    });
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        Track &track = tracks[i];
        if (present[i].first < 0)
            continue;
        const Index first = track.points.front().frame;
        track.keepPoints(std::size_t(present[i].first - first), std::size_t(present[i].last + 1 - first));
        track.keepDecisionsIn(present[i].first, present[i].last);
    }
    return tracks;
}

SecondView lookTwice(const Analysis &analysis, std::vector<Track> found, std::span<const Track> subtracted,
                     const RunContext &context)
{
    SecondLook look(analysis, context);
    look.lookAtAll(std::move(found), subtracted, context);
    return look.result();
}

SecondView lookBehind(const Analysis &analysis, SecondView view, const RunContext &context)
{
    if (!analysis.settings.family.isNone() || analysis.settings.noise.causal)
        return view;
    SecondLook look(analysis, context, std::move(view));
    look.lookBehindAll();
    return look.result();
}

} // namespace faintline

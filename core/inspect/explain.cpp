#include "inspect/explain.h"

#include "base/Error.h"
#include "base/logmath.h"
#include "base/numberText.h"
#include "inspect/StateReplay.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// The chain after the given frame, with all of the past that it would have recorded, and with trackers' histories
    /// since `begin`.
    Replay replayTo(const Analysis &analysis, Index begin, Index frame, const RunContext &context)
    {
        Replay replay(analysis, 0, Replay::Of::Paths);
        replay.seek(std::clamp<Index>(frame + 1 - replay.chain().longestPath(), 0, begin));
        replay.stepTo(frame + 1, context, "replaying the recording");
        return replay;
    }

    /// Offset between a model's scores in the chain's newest frame and the statistic.
    double offsetOf(const Analysis &analysis, const DetectionChain &chain, std::size_t model)
    {
        return chain.detector().offset(model) - analysis.offsetAt(model);
    }

    /// The best path into a cell in the newest frame, by the tracker that follows the cell or by the detector.
    struct PathInto {
        std::vector<PathStep> steps; ///< under a tracker: from its seed frame on, as far as it knows
        bool isTracked = false;
        std::size_t model = 0; ///< with which it begins
        Index seedFrame = 0;   ///< of the tracker
        std::vector<ModelChange> modelChanges;
    };

    PathInto pathInto(const Analysis &analysis, const DetectionChain &chain, Index cell)
    {
        const std::size_t model = chain.detector().winnerAt(cell);
        const StateSpace &space = analysis.modelAt(model).space;
        const std::span<const float> scores = chain.detector().scores(model);
        Index state = cell;
        for (Index other = cell; other < space.stateCount(); other += space.cellCount())
            if (scores[std::size_t(other)] > scores[std::size_t(state)])
                state = other;
        auto best = double(shownScore(analysis, chain, model, scores[std::size_t(state)]));
        const HmmTracker *following = nullptr;
        for (const HmmTracker &tracker : chain.trackers()) {
            Index candidate = 0;
            if (const double score = tracker.scoreAt(cell, &candidate); score > best) {
                best = score;
                state = candidate;
                following = &tracker;
            }
        }
        if (following)
            return {following->explain(state), true, following->track().model, following->track().detectFrame,
                    following->track().modelChanges};
        return {chain.detectorPathInto(state, model), false, model, 0, {}};
    }

    /// Runs the chain frame by frame and evaluates the alternatives to a path's steps, which the path itself does not
    /// contain.
    class Competitors
    {
    public:
        Competitors(const Analysis &analysis, std::size_t model)
            : m_analysis(analysis), m_model(analysis.modelAt(model)), m_replay(analysis), m_number(model)
        {
        }

        /// Moves to the state before that frame.
        void goTo(Index frame, const RunContext &context)
        {
            if (m_replay.next() == 0)
                m_replay.seek(frame);
            m_replay.stepTo(frame, context, "evaluating competing states");
        }

        struct Ways {
            double best = minusInfinity; ///< after forgetting
            double second = minusInfinity;
            double remembered = minusInfinity; ///< the best without forgetting
            std::optional<int> track;          ///< for which the path to the remembered one was forgotten
        };
        Ways into(Index state, Index frame) const
        {
            Ways ways;
            const PathDetector &detector = m_replay.chain().detector();
            const double background = std::max(0.0, -detector.offset(m_number));
            for (const StateSpace::Predecessor &p : m_model.space.predecessors(state, frame)) {
                const double ln = p.lnProbability * m_model.transitionScale;
                const auto score = double(detector.scores(m_number)[std::size_t(p.state)]);
                const std::optional<int> track = forgottenFor(m_model.space.cellOf(p.state));
                const double left = (track ? std::min(score, background) : score) + ln;
                ways.second = std::max(ways.second, std::min(left, ways.best));
                ways.best = std::max(ways.best, left);
                if (score + ln > ways.remembered) {
                    ways.remembered = score + ln;
                    ways.track = track;
                }
            }
            return ways;
        }

        /// For the last step.
        double lnK() const { return m_replay.chain().detector().regulation(m_number).stepLnK; }

    private:
        std::optional<int> forgottenFor(Index cell) const
        {
            const std::vector<Index> place = m_analysis.grid().coordinates(cell);
            for (const CellBox &box : m_replay.chain().forgotten())
                if (box.contains(m_analysis.grid(), place))
                    for (const auto &inhibition : m_replay.chain().inhibitions())
                        if (inhibition.box.centre == box.centre && inhibition.box.halfWidth == box.halfWidth)
                            return inhibition.track;
            return {};
        }

        const Analysis &m_analysis;
        const MarkovModel &m_model;
        Replay m_replay;
        std::size_t m_number; ///< of the model
    };

    /// Determines why the path was reset in its first step, and the margins of the detector's own steps.
    void findCompetitors(Explanation &explanation, const Analysis &analysis, std::size_t ownSteps,
                         const RunContext &context)
    {
        Competitors competitors(analysis, explanation.model);
        for (std::size_t i = 0; i < ownSteps; ++i) {
            PathStep &step = explanation.steps[i];
            if (step.frame == 0)
                continue;
            competitors.goTo(step.frame, context);
            const Competitors::Ways ways = competitors.into(step.state, step.frame);
            if (i > 0) {
                step.runnerUp = ways.best - ways.second;
                continue;
            }
            competitors.goTo(step.frame + 1, context);
            const double lnK = competitors.lnK();
            const bool isForgotten = ways.track && ways.remembered + lnK > 0.0;
            explanation.reset = isForgotten
                                    ? ResetCause{ResetCause::Kind::Forgotten, ways.remembered + lnK, *ways.track}
                                    : ResetCause{ResetCause::Kind::Background, -(ways.best + lnK), 0};
        }
    }

    /// Finds the second best state of the cell.
    void findOther(Explanation &explanation, const Analysis &analysis, const DetectionChain &chain, Index frame,
                   Index cell)
    {
        const std::size_t model = explanation.modelAt(frame);
        const StateSpace &space = analysis.modelAt(model).space;
        const StateScores scores = scoresNow(analysis, chain, frame, model);
        const Index own = explanation.steps.back().state;
        double best = minusInfinity;
        for (Index state = cell; state < space.stateCount(); state += space.cellCount())
            if (const auto score = double(scores.values[std::size_t(state)]); state != own && score > best) {
                best = score;
                explanation.otherState = state;
            }
        explanation.otherMargin = double(scores.values[std::size_t(own)]) - best;
    }

    /// The number of an inhibited box's track in the analysis, where tracks are renumbered after the second pass.
    int numberOf(const DetectionChain::Inhibition &inhibition, Index frame, const Analysis &analysis)
    {
        if (inhibition.track == 0)
            return 0;
        for (const Track &track : analysis.tracks) {
            const Index at = frame - track.onsetFrame;
            if (at >= 0 && at < std::ssize(track.points)
                && inhibition.box.contains(analysis.grid(),
                                           analysis.grid().coordinates(track.points[std::size_t(at)].cell)))
                return track.id;
        }
        return -1;
    }

    /// The tracks through the cell, or within a resolution cell of it.
    std::vector<const Track *> tracksThrough(const std::vector<Track> &tracks, const Analysis &analysis, Index frame,
                                             Index cell)
    {
        const FrameGeometry geometry = analysis.frames->geometry();
        const auto near = geometry.isOfSpectra() ? Index(std::ceil(geometry.binsPerCell)) : 0;
        std::vector<const Track *> through;
        for (const Track &track : tracks)
            if (std::any_of(track.points.begin(), track.points.end(), [&](const TrackPoint &point) {
                    return point.frame == frame && std::abs(point.cell - cell) <= near;
                }))
                through.push_back(&track);
        return through;
    }

    Index frameAt(const Axis &time, double seconds)
    {
        const double half = 0.5 * time.step;
        if (!(seconds >= time.first - half && seconds <= time.last() + half))
            throw Error("time " + formatNumber(seconds) + " s",
                        "must lie in " + formatNumber(time.first) + " … " + formatNumber(time.last()) + " s");
        return time.nearest(seconds);
    }

    Index cellAt(const Grid &grid, const std::vector<double> &position)
    {
        std::vector<Index> coordinates;
        for (auto axis = grid.axes.begin(); const double value : position) {
            const Axis &along = *axis++;
            if (std::isnan(value))
                throw Error(along.name + " nan", "must be a number");
            if (const double at = along.position(value);
                !along.cyclic && !(at >= -0.5 && at <= double(along.count) - 0.5))
                throw Error(along.name + " " + formatPlainly(value) + " " + along.unit,
                            "must lie in " + formatPlainly(along.first) + " … " + formatPlainly(along.last()) + " "
                                + along.unit);
            coordinates.push_back(along.nearest(value));
        }
        return grid.cell(coordinates);
    }

    /// Whether the detector is kept from a box: places without a signal always, those of tracks unless it was switched
    /// off.
    bool isKept(const Analysis &analysis, const DetectionChain::Inhibition &inhibition)
    {
        return inhibition.track == 0 || analysis.settings.decide.inhibits;
    }

    /// Explanation::inhibitedFor
    std::optional<int> inhibitedFor(const Analysis &analysis, const DetectionChain &chain, Index frame, Index cell)
    {
        // The box of a track that starts in this frame inhibits the detector from the next frame on.
        const auto isNew = [&](int track) {
            return std::any_of(chain.trackers().begin(), chain.trackers().end(), [track](const HmmTracker &tracker) {
                return tracker.track().id == track && tracker.age() == 1;
            });
        };
        std::optional<int> track;
        for (const DetectionChain::Inhibition &inhibition : chain.inhibitions())
            if (isKept(analysis, inhibition) && !isNew(inhibition.track)
                && inhibition.box.contains(analysis.grid(), analysis.grid().coordinates(cell)))
                track = numberOf(inhibition, frame, analysis);
        return track;
    }

} // namespace

Explanation explain(const Analysis &analysis, double seconds, const std::vector<double> &position,
                    const RunContext &context)
{
    const Index frame = frameAt(analysis.time(), seconds);
    const Index cell = cellAt(analysis.grid(), position);

    // A tracker's path reaches its beginning only if it keeps all of its history, which changes no score.
    Analysis detailed = analysis;
    detailed.settings.track.smoothingFrames = int(std::min<Index>(frame + 1, 1 << 30));
    Replay replay = replayTo(detailed, frame, frame, context.part(0.0, 0.3));
    PathInto path = pathInto(detailed, replay.chain(), cell);
    if (path.isTracked && path.steps.front().frame > path.seedFrame) { // followed for longer than the chain has run
        replay = replayTo(detailed, path.seedFrame, frame, context.part(0.3, 0.5));
        path = pathInto(detailed, replay.chain(), cell);
    }

    Explanation explanation;
    explanation.seconds = analysis.time().value(double(frame));
    explanation.position = analysis.grid().position(cell);
    explanation.displayed = double(replay.statistic()[std::size_t(cell)]);
    explanation.threshold = analysis.threshold;
    explanation.isTracked = path.isTracked;
    explanation.isExplainedByNoise = !tracksThrough(analysis.explainedByNoise, analysis, frame, cell).empty();
    explanation.isSubtracted = std::ranges::any_of(tracksThrough(analysis.tracks, analysis, frame, cell),
                                                   [](const Track *track) { return track->isSubtracted; });
    for (const Track *track : tracksThrough(analysis.tracks, analysis, frame, cell))
        if (track->windowSeconds > 0.0 && track->windowSeconds != analysis.frames->geometry().windowSeconds) {
            explanation.otherWindowTrack = track->id;
            explanation.otherWindowSeconds = track->windowSeconds;
        }
    explanation.steps = path.steps;
    std::size_t ownSteps = path.steps.size(); // the detector's, which precede a tracker's
    explanation.model = path.model;
    explanation.modelChanges = path.modelChanges;
    explanation.offset = offsetOf(detailed, replay.chain(), path.model);
    findOther(explanation, detailed, replay.chain(), frame, cell);
    explanation.inhibitedFor = inhibitedFor(analysis, replay.chain(), frame, cell);
    if (path.isTracked) {
        // Before its tracker was seeded, the path is that of the detector.
        const PathStep seed = path.steps.front();
        const Replay before = replayTo(detailed, seed.frame, seed.frame, context.part(0.5, 0.8));
        explanation.steps = before.chain().detectorPathInto(seed.state, path.model);
        ownSteps = explanation.steps.size();
        explanation.offset = offsetOf(detailed, before.chain(), path.model);
        explanation.steps.insert(explanation.steps.end(), path.steps.begin() + 1, path.steps.end());
    }
    findCompetitors(explanation, analysis, ownSteps, context.part(0.8, 1.0));
    for (PathStep &step : explanation.steps) {
        explanation.statistic += step.logLikelihoodRatio + step.lnTransition + step.lnK;
        step.score = explanation.statistic;
    }
    explanation.statistic += explanation.offset;
    return explanation;
}

} // namespace faintline

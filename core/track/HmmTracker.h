#pragma once

#include "recursion/PathTrace.h"
#include "track/Track.h"
#include "track/TrackerModel.h"

#include <deque>
#include <memory>
#include <span>
#include <vector>

namespace faintline {

/// Follows one signal in a small window of the state space that moves with the most probable state.
///
/// The recursion is the detector's without reset: u = λ + ln K + max_m [ln P(n|m) + u(m)]. There are two scores. The
/// *statistic* is the path's own and continues from the detector's. The *level* decides about the end: it follows the
/// statistic, loses `decayNats` per frame, is limited to threshold + `ceilingNats`, and the track ends when it falls
/// below threshold - `endNats`. The path is smoothed by tracing back from the best state `smoothingFrames` or more
/// later. The end is placed where the level's final fall began. Source: Parsons 2008 section 2.3 and Figure 1.
class HmmTracker
{
public:
    /// The detector's scores in the cells of an excursion whose best state crossed the threshold.
    struct Seed {
        Index state;
        std::span<const Index> cells;  ///< ascending
        std::span<const float> scores; ///< of all states
        double offset;                 ///< to be added to the scores
    };

    /// `start` holds the path so far.
    HmmTracker(TrackerModel &model, Track start, const Seed &seed);

    // Trackers are only moved, never copied, because their history is large.
    HmmTracker(HmmTracker &&) noexcept = default;
    HmmTracker &operator=(HmmTracker &&) noexcept = default;

    /// A copy that continues bit for bit but has no path before the newest frame, so its size does not depend on its
    /// age.
    HmmTracker withoutPast(TrackerModel &model) const;

    /// The same track as if another model of the bank, its `number`, followed it from the newest frame on: each state
    /// takes the score of the states with the nearest rates, plus `lnChange`, ln P of a change of model. Both models
    /// have the same cells and window. Its points begin with the newest frame.
    HmmTracker changedTo(TrackerModel &model, std::size_t number, double lnChange) const;

    /// Becomes `next`, which was made by changedTo() from this tracker in an earlier frame. The path before the change
    /// remains this one's; it leads to the beginning of the other's.
    void changeTo(HmmTracker next);

    /// Index in the bank of the model that follows now.
    std::size_t model() const { return m_track.lastModel(); }

    /// Memory used.
    std::size_t bytes() const;

    /// Takes the log-likelihood ratios of a whole frame; returns false when the track has ended.
    bool update(Index frame, std::span<const float> lambda, double lnK);

    Index cell() const { return m_model->space.cellOf(m_best); }
    const std::vector<Index> &coordinates() const { return m_history.back().centre; }
    /// Distance of a line from the middle of the newest cell, cells (TrackPoint::offset).
    double displacement() const;
    double statistic() const { return m_statistic; }
    double level() const { return m_level; }
    const Track &track() const { return m_track; }
    Index age() const { return m_age; } ///< frames since detection, inclusive

    /// Earliest possible end of the track: its end is placed where its level's final fall begins.
    Index earliestEnd() const { return m_track.detectFrame + m_fallFrame; }

    /// A track that was beside this one in consecutive frames, up to now.
    struct Beside {
        int track = 0;
        int frames = 0;
    };
    const std::vector<Beside> &beside() const { return m_beside; }
    void setBeside(std::vector<Beside> beside) { m_beside = std::move(beside); }

    /// Raises `statistic` to this track's score in each cell of its window.
    void paint(std::span<float> statistic) const;
    /// Raises the scores of all states (StateSpace order) to this track's, state by state.
    void paintStates(std::span<float> scores) const;

    /// Score of the best state in a cell, and that state; -∞ outside the window.
    double scoreAt(Index cell, Index *state = nullptr) const;

    /// The reachable states of the newest frame's window, and the origin of each in the previous frame (itself when
    /// seeded).
    struct Origin {
        Index state;
        Index before;
    };
    std::vector<Origin> origins() const;

    /// The terms of the path to a state in the newest frame, back to the state it was seeded from (first step, score
    /// only), as far as the history goes: request a long smoothing lag first.
    std::vector<PathStep> explain(Index state) const;

    /// Ends the track, with its points traced and cut at the last evidence.
    Track finish(bool isOpen);

private:
    /// The window's scores after one frame, relative to `offset`.
    struct Slice {
        Index frame = 0;
        std::vector<Index> centre; ///< grid coordinates of the window's middle
        std::vector<float> scores;
        double offset = 0.0;
        std::vector<float> lambda; ///< of the window's cells
        double lnK = 0.0;
    };

    HmmTracker() = default;
    Slice cutOut(Index frame, const std::vector<Index> &centre, std::span<const float> lambda, double lnK) const;
    void follow(Index frame, std::span<const float> lambda, double lnK);
    Index predecessorIn(const Slice &earlier, Index state, PathStep &step) const; ///< sets ln P and the runner-up
    Index localOf(const Slice &slice, Index state) const;
    /// The path to a state in the newest frame, as far as the history goes.
    std::vector<TrackPoint> pathTo(Index state) const;
    /// The best state of the newest frame that changedTo() a model on `later` maps to `state`.
    Index stateBefore(Index state, const StateSpace &later) const;
    void commit(std::size_t count);
    void measureFirst(std::size_t count, std::vector<TrackPoint> &path) const; ///< sets offsets
    void holdLevel();

    TrackerModel *m_model = nullptr;
    Track m_track;
    std::deque<Slice> m_history;
    Index m_age = 0;
    Index m_fallFrame = 0;    ///< frames from detection to the start of the level's latest fall
    double m_fallLevel = 0.0; ///< tilted level at that frame: the largest so far
    Index m_best = 0;         ///< global index of the most probable state
    std::vector<Beside> m_beside;
    double m_statistic = 0.0;
    double m_level = 0.0;
    double m_lnChange = 0.0;              ///< of the last change of model
    std::unique_ptr<HmmTracker> m_former; ///< the tracker before that change, while the history reaches back to it
};

} // namespace faintline

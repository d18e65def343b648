#pragma once

#include "detect/PathDetector.h"
#include "detect/PathTrace.h"
#include "model/MarkovModel.h"
#include "track/Cluster.h"
#include "track/HmmTracker.h"
#include "track/PlaceIndex.h"
#include "track/Track.h"
#include "track/joinTracks.h"

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace faintline {

/// What the chain needs to know besides the model: everything in cells of the grid and nats.
struct ChainSettings {
    double threshold = 0.0; ///< on the detector's statistic
    /// Nat, where the statistic is not the score of the paths that trackers follow (GuidedDetector): what a tracker's
    /// level is held against, and begins with at least, because its signal has been detected.
    std::optional<double> trackThreshold;
    /// Cells above this around a crossing belong to the same excursion and are forgotten with it.
    double shoulder = 0.0;
    std::vector<Index> linkCells;    ///< crossings this near belong to one cluster, per axis
    std::vector<Index> inhibitCells; ///< half the box inhibited around a track, per axis
    std::vector<Index> forgetCells;  ///< half the box reset around a new track, per axis; may be empty: as inhibitCells
    /// Cells where no signal is looked for, by coordinates: kept from the detector as if a track were there all the
    /// time.
    std::vector<std::vector<Index>> excluded;
    TrackSettings track;
    /// How far back the beginning of a new track is looked for; 0: as far as its path goes. 1: no traceback, no past is
    /// kept.
    Index onsetFrames = 0;
    bool feedback = true;      ///< false: detector only, no reset, no inhibition, no tracks
    bool resets = true;        ///< the detector forgets what a track has taken over
    bool inhibits = true;      ///< y is inhibited around the tracks
    bool keepsNumbers = false; ///< of tracks that are joined, the first one's number stays, and no other takes a gap's
    /// Half-width along the last axis over which a signal of power y leaks into its neighbours; may be empty.
    std::function<Index(double y)> leakageExtent;
    /// Bins of one resolution cell along the last axis: a strong signal's skirts are followed outward in such steps; 0:
    /// not.
    Index skirtStep = 0;
};

/// What the next frames' statistic depends on: the detector's state, and for each track in progress its window,
/// whatever its age.
struct ChainState {
    std::shared_ptr<const DetectorState> detector;
    std::vector<HmmTracker> trackers;
    std::vector<CellBox> boxes;
    std::vector<CellBox> newBoxes;
    std::vector<int> boxTracks;
    std::size_t excursions = 0;
    int nextId = 1;

    std::size_t bytes() const; ///< that it takes
};

/// From frames to tracks: Parsons' Figure 1.
///
/// For each frame, in this order: the trackers take the raw frame, and those whose signal is gone end; y is set to 0 in
/// a box around every track and the detector takes the rest; crossings are clustered; the peak of each cluster starts a
/// track, whose past is traced back to its onset, and the detector resets the box around it. The statistic shown is the
/// detector's, raised to the trackers' scores where they follow something. Under a bank of models a track belongs to
/// the model whose statistic crossed: its path is traced, and followed, with that one. Of a detector that is guided, a
/// track's cell shows the statistic that it was detected with, for its tracker's scores are something else.
/// Deterministic; one object per thread.
class DetectionChain
{
public:
    DetectionChain(const MarkovModel &model, const Grid &grid, std::unique_ptr<PathDetector> detector,
                   ChainSettings settings);

    /// One model for each member of the detector, all with the same likelihood.
    DetectionChain(std::vector<MarkovModel> models, const Grid &grid, std::unique_ptr<PathDetector> detector,
                   ChainSettings settings);

    /// Takes frame number `frame` (ascending, no gaps); writes the statistic of every cell.
    void update(Index frame, std::span<const float> y, std::span<float> statistic);

    /// Ends the tracks still open. Afterwards `tracks()` is complete, ordered by detection, then cell.
    void finish();

    const std::vector<Track> &tracks() const { return m_ended; }
    /// Those that have ended since they were last taken, in the order of their ends; handed over. Under what rule they
    /// are joined once there are no more of them.
    std::vector<Track> takeEnded();
    JoinRule joinRule() const;
    /// A track begins at most so many frames before its detection, that one included.
    Index longestRunUp() const;
    /// The same after the end, those that are pieces of one signal joined; handed over, so that there are none left.
    std::vector<Track> takeJoinedTracks();
    const std::vector<HmmTracker> &trackers() const { return m_trackers; }
    const PathDetector &detector() const { return *m_detector; }

    /// The detector's best path into a state of the newest frame, by one of its models.
    std::vector<PathStep> detectorPathInto(Index state, std::size_t model = 0) const;
    /// So many frames back at most, the newest included: all that is remembered.
    Index longestPath() const { return Index(m_seenLimit); }

    /// Null where the detector cannot tell its state.
    std::shared_ptr<const ChainState> state() const;
    /// Goes on from there, with the same bytes: a state of this chain, or of one made alike. Paths and tracks begin
    /// anew.
    void setState(const ChainState &state);

    /// The boxes that the detector forgets before it takes the next frame.
    std::span<const CellBox> forgotten() const;

    /// The boxes kept from the detector in the last frame, those of tracks started in it included.
    const std::vector<CellBox> &inhibited() const { return m_boxes; }

    /// A box kept from the detector, and the track that it was kept for.
    struct Inhibition {
        int track = 0; ///< 0: a place where no signal is looked for
        CellBox box;
    };
    /// The same with their tracks, in the order of `inhibited()`.
    std::vector<Inhibition> inhibitions() const;

private:
    /// One frame as the detector saw it.
    struct Seen {
        std::vector<float> y;
        std::vector<double> lnK; ///< of each model
        std::vector<CellBox> forgotten;
    };

    /// The scores of all states after a frame.
    struct Checkpoint {
        Index frame;
        std::vector<std::vector<float>> scores; ///< of each model
    };

    void remember(Index frame, Seen seen);
    std::span<const CellBox> forgottenBoxes() const;
    void keepExcursions();
    void keepFromDetector(std::span<const CellBox> boxes, std::vector<float> &y);
    void updateTrackers(Index frame, std::span<const float> y);
    float nothingSeen() const;
    std::vector<std::pair<Index, float>> maskNeighbours(const PlaceIndex &places, std::size_t own);
    void endDuplicates();
    CellBox boxRound(const std::vector<Index> &centre, std::span<const float> y, double margin = 1.0) const;
    void startTrack(Index frame, const Cluster &cluster, std::span<const float> y);
    Index bestState(Index cell) const;
    double scoreOf(Index state, std::size_t model) const;
    RecursionRecord record(std::size_t model) const;

    std::vector<MarkovModel> m_models;
    Grid m_grid;
    std::unique_ptr<PathDetector> m_detector;
    ChainSettings m_settings;
    std::vector<std::unique_ptr<TrackerModel>> m_trackerModels;
    std::vector<HmmTracker> m_trackers;
    std::vector<Track> m_ended;
    std::vector<CellBox> m_boxes;
    std::vector<CellBox> m_newBoxes; ///< of them, those of tracks started in the last frame
    std::vector<int> m_boxTracks;    ///< the track of each box
    /// The first of the boxes: what was forgotten before the last frame with the tracks that had just begun.
    std::size_t m_excursions = 0;
    std::deque<Seen> m_seen;
    Index m_firstSeen = 0;
    std::size_t m_seenLimit;
    std::deque<Checkpoint> m_checkpoints;
    std::size_t m_checkpointLimit;
    int m_nextId = 1;
    std::vector<float> m_lambda;
};

} // namespace faintline

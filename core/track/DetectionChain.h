#pragma once

#include "track/Cluster.h"
#include "track/HmmTracker.h"
#include "track/RecentFrames.h"
#include "track/RivalModels.h"
#include "track/Track.h"
#include "track/joinTracks.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace faintline {

class PlaceIndex;

/// Settings of the chain apart from the model, in cells of the grid and nats.
struct ChainSettings {
    double threshold = 0.0; ///< for the detector's statistic
    /// Nat, if the statistic is not the score of the followed paths (GuidedDetector): threshold for a tracker's level,
    /// which also starts at least there, because its signal has been detected.
    std::optional<double> trackThreshold;
    /// Cells above this around a crossing belong to the same excursion and are forgotten with it.
    double shoulder = 0.0;
    std::vector<Index> linkCells;    ///< crossings this close belong to one cluster, per axis
    std::vector<Index> inhibitCells; ///< half width of the box inhibited around a track, per axis
    std::vector<Index> forgetCells;  ///< half width of the box reset around a new track, per axis; empty: inhibitCells
    /// Coordinates of cells where no signal is looked for; inhibited as if a track were there all the time.
    std::vector<std::vector<Index>> excluded;
    TrackSettings track;
    /// Maximum number of frames to trace back to the onset of a new track. 0: as far as its path goes; 1: no traceback,
    /// and no past is stored.
    Index onsetFrames = 0;
    bool feedback = true;      ///< false: detector only, without reset, inhibition and tracks
    bool resets = true;        ///< the detector forgets cells that a track has taken over
    bool inhibits = true;      ///< y is inhibited around tracks
    bool keepsNumbers = false; ///< joined tracks keep the first one's number, and numbers of gaps are not reused
    /// Half width along the last axis over which a signal of power y leaks into its neighbours; may be empty.
    std::function<Index(double y)> leakageExtent;
    /// Bins per resolution cell along the last axis, the step in which a strong signal's skirts are followed outward;
    /// 0: not followed.
    Index skirtStep = 0;
};

/// Everything on which the next frames' statistic depends: the detector's state, and the window of each open track,
/// regardless of its age.
struct ChainState {
    std::shared_ptr<const DetectorState> detector;
    std::vector<HmmTracker> trackers;
    std::map<int, std::vector<HmmTracker>> rivals; ///< of a bank's other models, by the number of the track
    std::vector<CellBox> boxes;
    std::vector<CellBox> newBoxes;
    std::vector<int> boxTracks;
    std::size_t excursions = 0;
    int nextId = 1;

    std::size_t bytes() const; ///< memory used
};

/// Converts frames to tracks: Parsons' Figure 1.
///
/// For each frame, in this order: trackers take the raw frame, and those whose signal is lost end; y is set to 0 in a
/// box around each track and the detector takes the rest; crossings are clustered; the peak of each cluster starts a
/// track, which is traced back to its onset, and the detector resets the box around it. The output statistic is the
/// detector's, raised to the trackers' scores where they follow something. With a bank of models, a track belongs to
/// the model whose statistic crossed, and is traced with that model; it changes to another one that follows it better
/// (RivalModels). With a guided detector, the output statistic is that detector's for the frames as they are, whether
/// tracks follow something or not, because trackers' scores are another quantity. Deterministic; use one object per
/// thread.
class DetectionChain
{
public:
    DetectionChain(const MarkovModel &model, const Grid &grid, std::unique_ptr<PathDetector> detector,
                   ChainSettings settings);

    /// One model for each member of the detector, all with the same likelihood.
    DetectionChain(std::vector<MarkovModel> models, const Grid &grid, std::unique_ptr<PathDetector> detector,
                   ChainSettings settings);

    /// Takes frame number `frame` (ascending, no gaps); writes the statistic of each cell.
    void update(Index frame, std::span<const float> y, std::span<float> statistic);

    /// Takes some of these frames, the first at least: several at once while nothing is followed, if the detector can.
    /// The same bytes as one at a time, but faster. Returns their number; `regulations` then tells of each.
    Index updateSome(Index frame, std::span<const float> y, std::span<float> statistic);
    /// Takes all of these frames.
    void updateAll(Index frame, std::span<const float> y, std::span<float> statistic);
    /// Regulation of the first model in the frames that updateSome took.
    const std::vector<PathDetector::Regulation> &regulations() const { return m_regulations; }

    /// Ends open tracks. Afterwards `tracks()` is complete, ordered by detection, then cell.
    void finish();

    const std::vector<Track> &tracks() const { return m_ended; }
    /// Moves out the tracks that have ended since the last call, in the order of their ends. joinRule() is the rule for
    /// joining them once all have ended.
    std::vector<Track> takeEnded();
    JoinRule joinRule() const;
    /// Maximum number of frames between a track's onset and its detection, including the latter.
    Index longestRunUp() const;
    /// Number of newest frames in which a tracker's path may still change.
    Index longestOpenPath() const { return 2 * Index(m_settings.track.smoothingFrames) + 1; }
    /// Moves out all tracks after the end, with the pieces of each signal joined.
    std::vector<Track> takeJoinedTracks();
    const std::vector<HmmTracker> &trackers() const { return m_trackers; }
    const PathDetector &detector() const { return *m_detector; }

    /// The best path of one model into a state of the newest frame.
    std::vector<PathStep> detectorPathInto(Index state, std::size_t model = 0) const;
    /// Maximum length of such a path in frames, including the newest.
    Index longestPath() const { return m_recent.longest(); }

    /// Null if the detector cannot save its state.
    std::shared_ptr<const ChainState> state() const;
    /// Continues from a state of this chain, or of one with the same settings, with the same bytes. Paths and tracks
    /// start anew.
    void setState(const ChainState &state);

    /// The boxes that the detector forgets before the next frame.
    std::span<const CellBox> forgotten() const;

    /// The boxes inhibited in the last frame, including those of tracks started in it.
    const std::vector<CellBox> &inhibited() const { return m_boxes; }

    /// An inhibited box and its track.
    struct Inhibition {
        int track = 0; ///< 0: an excluded place
        CellBox box;
    };
    /// Inhibited boxes with their tracks, in the order of `inhibited()`.
    std::vector<Inhibition> inhibitions() const;

private:
    Index takenTogether(Index frame, std::span<const float> y) const;
    bool advanceTogether(Index frame, std::span<const float> y, std::span<float> statistic);
    void showStatistic(std::span<const float> y, std::span<float> statistic);
    std::span<const CellBox> forgottenBoxes() const;
    void keepExcursions();
    void addExcluded(std::span<const float> y);
    std::vector<Index> inhibit(std::span<const CellBox> boxes, std::span<float> y) const;
    void forgetBoxes();
    void updateTrackers(Index frame, std::span<const float> y);
    float nothingSeen() const;
    std::vector<std::pair<Index, float>> maskNeighbours(const PlaceIndex &places, std::size_t own);
    void endDuplicates();
    CellBox boxRound(const std::vector<Index> &centre, std::span<const float> y, double margin = 1.0) const;
    void startTrack(Index frame, const Cluster &cluster, std::span<const float> y);
    Index bestState(Index cell) const;
    double scoreOf(Index state, std::size_t model) const;

    std::vector<MarkovModel> m_models;
    Grid m_grid;
    std::unique_ptr<PathDetector> m_detector;
    ChainSettings m_settings;
    std::vector<std::unique_ptr<TrackerModel>> m_trackerModels;
    std::vector<HmmTracker> m_trackers;
    RivalModels m_rivals;
    std::vector<Track> m_ended;
    std::vector<CellBox> m_boxes;
    std::vector<CellBox> m_newBoxes; ///< those of tracks started in the last frame
    std::vector<int> m_boxTracks;    ///< track of each box
    /// Number of leading boxes that were forgotten before the last frame together with newly started tracks.
    std::size_t m_excursions = 0;
    RecentFrames m_recent;
    int m_nextId = 1;
    std::vector<float> m_lambda;
    std::vector<PathDetector::Regulation> m_regulations;
    Index m_singlyBefore = 0; ///< frames before this one are taken one at a time
};

} // namespace faintline

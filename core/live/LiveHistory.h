#pragma once

#include "live/listen.h"
#include "spectrum/PeakPyramid.h"

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace faintline {

/// Settings of a live run that hold from a time on.
struct SettingsChange {
    double seconds = 0.0;
    std::vector<std::string> fields; ///< that changed, "stage.name"
    double threshold = 0.0;          ///< nat, from then on
};

/// What there is to be seen of a live run so far: a value, which shares with the run all but the newest rows.
struct LiveView {
    std::shared_ptr<const AnalysisPlan> plan;                  ///< in force
    Axis time;                                                 ///< of its frames so far
    std::shared_ptr<const PeakPyramid> input, statistic;       ///< all of these, merged to rows where they are many
    std::shared_ptr<const PeakPyramid> newInput, newStatistic; ///< the newest of these, single
    std::shared_ptr<const std::vector<Event>> events;          ///< by onset, then frequency; those in progress are open
    std::vector<std::shared_ptr<const Track>> tracks;          ///< of the newest events, their points thinned out
    std::vector<SettingsChange> changes;
    std::shared_ptr<const WrittenSamples> written; ///< what is being recorded; null: nothing
    Index goesBackTo = 0;                          ///< the first frame that can be gone through again under the plan
    std::shared_ptr<const Checkpoints<ChainState>> checkpoints; ///< of the chain
    std::chrono::steady_clock::time_point heardAt;              ///< when the last sample of the newest frame came
    Index lostCount = 0;                                        ///< samples

    bool isEmpty() const { return !plan; }
};

/// A live run so far as an analysis, from its recording: what it has of pictures, and what it takes to read frames and to go
/// through the chain again, from where the plan holds. Tracks, counts and what there is for each frame it has not. Null
/// where nothing is recorded. Reads nothing; its frames are read, as any, on a worker.
std::shared_ptr<const Analysis> analysisSoFar(const LiveView &view);

/// Collects what a live run tells, for `view`. Used by one thread.
///
/// Memory: 64 MiB a picture and as much of its end, however long the run; 256 tracks of up to 512 points; all events;
/// states to go back to, 64 MiB of the noise and 32 MiB of the chain.
class LiveHistory
{
public:
    // What ListenSinks tell of:
    void take(std::shared_ptr<const WrittenSamples> written) { m_written = std::move(written); }
    void take(const AnalysisPlan &plan);
    void take(const ListenFrame &frame);
    void take(const EventChange &change);

    LiveView view() const;

    /// Frames of the end that are kept single at least, once there are so many.
    static Index singleFrames(Index cells);

private:
    /// A picture of everything, and two of the newest frames: when the younger is full, the older one has as many
    /// again, and goes.
    struct Picture {
        Picture(const Axis &time, Index cells, ByteScale::Kind kind);
        void append(std::span<const float> frame);

        Axis time;
        Index fullFrames; ///< of the younger
        PeakPyramid all;
        PeakPyramid older;
        PeakPyramid younger;
        std::vector<std::uint8_t> bytes;
    };

    void markChange(const AnalysisPlan &plan, double seconds);
    void beginStates(const AnalysisPlan &plan, Index from);
    void keepState(const ListenFrame &frame);
    Index goesBackTo() const;
    void follow(const HmmTracker &tracker, const ListenFrame &frame);

    std::shared_ptr<const AnalysisPlan> m_plan;
    std::unique_ptr<Picture> m_input;
    std::unique_ptr<Picture> m_statistic;
    std::map<int, Event> m_events;
    mutable std::shared_ptr<const std::vector<Event>> m_told; ///< of these; null: they have changed
    std::map<int, std::shared_ptr<Track>> m_tracks;
    std::vector<SettingsChange> m_changes;
    std::shared_ptr<const WrittenSamples> m_written;
    Index m_heldFrom = 0; ///< frame from which on the plan is in force
    std::shared_ptr<Checkpoints<ChainState>> m_checkpoints;
    std::chrono::steady_clock::time_point m_heardAt{};
    Index m_lostCount = 0;
};

} // namespace faintline

#pragma once

#include "live/listen.h"

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace faintline {

/// A change of a live run's settings.
struct SettingsChange {
    double seconds = 0.0;
    std::vector<std::string> fields; ///< changed fields, "stage.name"
    double threshold = 0.0;          ///< new threshold, nat
};

/// The state of a live run so far, for display. A value that shares all but the newest rows with the run.
struct LiveView {
    std::shared_ptr<const AnalysisPlan> plan;                  ///< currently in use
    Axis time;                                                 ///< of the frames so far
    std::shared_ptr<const PeakPyramid> input, statistic;       ///< all frames; long runs are merged into rows
    std::shared_ptr<const PeakPyramid> newInput, newStatistic; ///< newest frames, unmerged
    std::shared_ptr<const std::vector<Event>> events;          ///< by onset, then frequency; in progress: open
    std::vector<std::shared_ptr<const Track>> tracks;          ///< of the newest events, decimated
    std::vector<SettingsChange> changes;
    std::shared_ptr<const WrittenSamples> written; ///< recording in progress; null: none
    Index goesBackTo = 0;                          ///< first frame from which the chain can be rerun with the plan
    std::shared_ptr<const Checkpoints<ChainState>> checkpoints; ///< of the chain
    std::chrono::steady_clock::time_point heardAt;              ///< arrival of the newest frame's last sample
    Index lostCount = 0;                                        ///< samples

    bool isEmpty() const { return !plan; }
};

/// The live run so far as an analysis of its recording. It has the pictures and can read frames and rerun the chain
/// from where the plan took effect, but has no tracks, counts or per-frame data. Null if nothing is recorded. Reads
/// nothing itself; call frame reads on a worker, as usual.
std::shared_ptr<const Analysis> analysisSoFar(const LiveView &view);

/// Collects the output of a live run for `view`. Not thread-safe.
///
/// Memory: 64 MiB per picture and the same for its newest frames, however long the run; 256 tracks of up to 512 points;
/// all events; checkpoints, 64 MiB for the noise and 32 MiB for the chain.
class LiveHistory
{
public:
    // Called from the ListenSinks:
    void take(std::shared_ptr<const WrittenSamples> written) { m_written = std::move(written); }
    void take(const AnalysisPlan &plan);
    void take(const ListenFrame &frame);
    void take(const EventChange &change);

    LiveView view() const;

    /// Minimum number of newest frames kept unmerged, once that many exist.
    static Index singleFrames(Index cells);

private:
    /// A picture of all frames, and two of the newest. When `younger` is full it replaces `older`, which by then holds
    /// twice as many frames.
    struct GrowingPicture {
        GrowingPicture(const Axis &time, Index cells, ByteScale::Kind kind);
        void append(std::span<const float> frame);

        Axis time;
        Index fullFrames; ///< capacity of `younger`
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
    std::unique_ptr<GrowingPicture> m_input;
    std::unique_ptr<GrowingPicture> m_statistic;
    std::map<int, Event> m_events;
    mutable std::shared_ptr<const std::vector<Event>> m_told; ///< snapshot of m_events; null: out of date
    std::map<int, std::shared_ptr<Track>> m_tracks;
    std::vector<SettingsChange> m_changes;
    std::shared_ptr<const WrittenSamples> m_written;
    Index m_heldFrom = 0; ///< first frame that uses the plan
    std::shared_ptr<Checkpoints<ChainState>> m_checkpoints;
    std::chrono::steady_clock::time_point m_heardAt{};
    Index m_lostCount = 0;
};

} // namespace faintline

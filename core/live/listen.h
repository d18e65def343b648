#pragma once

#include "base/RunContext.h"
#include "live/EventFollower.h"
#include "live/HeardRecording.h"
#include "live/ListenSettings.h"
#include "live/sources/SampleSource.h"
#include "plan/Analysis.h"

#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// A frame that the chain has processed.
struct ListenFrame {
    Index number = 0; ///< index among the plan's frames
    std::span<const float> y;
    std::span<const float> statistic;
    const DetectionChain &chain;
    std::chrono::steady_clock::time_point heardAt; ///< arrival of its last sample
    Index lostCount = 0;                           ///< samples lost so far
    int idsBefore = 0;                             ///< offset from a track's number to its event's
};

/// Callbacks of a live run. Called from two threads, but never at the same time.
struct ListenSinks {
    /// `plan`: the current plan.
    std::function<void(const EventChange &change, const AnalysisPlan &plan)> event;
    std::function<void(const ListenNotice &notice, const StreamFormat &format)> notice;
    /// Called before the first plan if the stream is recorded.
    std::function<void(std::shared_ptr<const WrittenSamples> written)> recording{};
    /// Called before the first frame and whenever new settings take effect, with the plan for all that follows.
    std::function<void(const AnalysisPlan &plan)> plan{};
    std::function<void(const ListenFrame &frame)> frame{};
    /// Called before each frame: returns settings to switch to once they are calibrated, or nothing.
    std::function<std::optional<AnalysisSettings>()> wish{};
};

/// Result of a live run.
struct ListenResult {
    AnalysisPlan plan;                      ///< without frames if the stream was shorter than a window
    std::vector<Event> events;              ///< all, identical to a run over the recording
    std::optional<double> startUnixSeconds; ///< of the first sample, by this machine's clock
    Index sampleCount = 0;                  ///< gaps included
    Index lostCount = 0;
    Index silentCount = 0;          ///< samples of all frames, if these are silent; else -1
    bool isAnalysedToTheEnd = true; ///< false: the end of the recording was not analysed
    bool isRecordedWhole = true;
    std::vector<std::string> files; ///< metadata of the recordings
    std::string recording;          ///< opens all: the metadata, or the list if there are several; empty: none
};

/// Runs until the source ends, the selection's end is reached, or the context requests a stop. A stop is not an error:
/// what has been received is analysed and written within half a second.
///
/// Recording: source → SigMF on disk. Analysis: source → buffer → frames over a causal background → chain → events,
/// frame by frame. Both have the same samples at the same positions, and frames and chain are those of `analyse`, so
/// the events equal those of the recording with the same settings. Memory does not grow with time: it is the buffer, a
/// block of noise and the chain's state. Throws Error if the source or the settings cannot be used, or a pipe fails.
///
/// Settings can change during a run. A new threshold keeps the tracks. A new detector or model restarts the chain at
/// the next frame; new frame settings restart at the next sample and need a first block of noise again. Event numbers
/// are kept and never reused. The result's plan is the last one.
ListenResult listen(SampleSource &source, const ListenSettings &settings, const ListenSinks &sinks,
                    const RunContext &context = {});

/// The settings that a live run uses on a stream of this format: causal, with a window, slopes in bins per frame.
AnalysisSettings settingsForListening(AnalysisSettings settings, const StreamFormat &format);

// Output of `listen`: one JSON object per line.

/// {"event": 7, "state": "provisional", "t": …, …}: the event's number, which never changes; its state (provisional,
/// confirmed, updated, final); then the members of `eventJson`, in s from the first sample and Hz. For a track in
/// progress the drift is omitted and t_end is the present. "utc" of t_detect is given if `startUnixSeconds` is known. A
/// final event that is not an event of its own has "part_of", the number that it continues as, or "withdrawn".
std::string eventLine(const EventChange &change, const AnalysisPlan &plan, std::optional<double> startUnixSeconds);

/// {"notice": "lost", "t": …, "sample": …, "samples": …, "message": "…"}.
std::string noticeLine(const ListenNotice &notice, const StreamFormat &format);

} // namespace faintline

#pragma once

#include "analysis/Analysis.h"
#include "base/RunContext.h"
#include "live/EventFollower.h"
#include "live/HeardRecording.h"
#include "live/ListenSettings.h"
#include "live/SampleSource.h"

#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// A frame that the chain has taken.
struct ListenFrame {
    Index number = 0; ///< in the plan's frames
    std::span<const float> y;
    std::span<const float> statistic;
    const DetectionChain &chain;
    std::chrono::steady_clock::time_point heardAt; ///< when the last of its samples came
    Index lostCount = 0;                           ///< samples so far
    int idsBefore = 0;                             ///< an event's number is its track's and this
};

/// What a listener is told while it happens, and may ask for. Called from two threads, never at the same time.
struct ListenSinks {
    /// `plan` is that of the run.
    std::function<void(const EventChange &change, const AnalysisPlan &plan)> event;
    std::function<void(const ListenNotice &notice, const StreamFormat &format)> notice;
    /// Before the first plan, where something is recorded.
    std::function<void(std::shared_ptr<const WrittenSamples> written)> recording{};
    /// Before the first frame, and again where changed settings are in force: what all that follows is made with.
    std::function<void(const AnalysisPlan &plan)> plan{};
    std::function<void(const ListenFrame &frame)> frame{};
    /// Asked for before each frame: settings to go on with as soon as they are calibrated; none: as before.
    std::function<std::optional<AnalysisSettings>()> wish{};
};

/// What is known at the end.
struct ListenResult {
    AnalysisPlan plan;                      ///< no frames where there was not a window's length
    std::vector<Event> events;              ///< all, as `events` gives them of a run over the recording that was made
    std::optional<double> startUnixSeconds; ///< of the first sample, by the machine's clock
    Index sampleCount = 0;                  ///< in time, gaps included
    Index lostCount = 0;
    bool isAnalysedToTheEnd = true; ///< else the recording has more than was analysed
    bool isRecordedWhole = true;
    std::vector<std::string> files; ///< recordings' metadata
    std::string recording;          ///< to open all of it by: the metadata, or the list of several; empty: none
};

/// Listens until the source is over, the selection's end is reached, or the context's stop is asked for, which is no
/// error: within half a second what is there is analysed and written.
///
/// recording: source → SigMF on disk; analysis: source → buffer → frames over a causal background → chain → events,
/// frame by frame. Both have the same samples at the same places, and the frames and the chain are those of `analyse`:
/// the events are those of that recording with the same settings. Memory: the buffer, a block of noise, and what the
/// chain holds; it does not grow with time. Throws Error where the source or the settings cannot be used, or a pipe
/// fails.
///
/// Settings that change on the way hold from a frame on. Another threshold lets tracks go on; another detector or model
/// begins anew with the next frame, and other frames with the next sample, whose background needs a first block again.
/// Events keep their numbers, and none has that of another. The result's plan is the last one.
ListenResult listen(SampleSource &source, const ListenSettings &settings, const ListenSinks &sinks,
                    const RunContext &context = {});

/// The settings that a run with these has on a stream of that format: causal, with a window, slopes in bins a frame.
AnalysisSettings settingsForListening(AnalysisSettings settings, const StreamFormat &format);

} // namespace faintline

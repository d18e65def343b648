#pragma once

#include "analysis/AnalysisSettings.h"
#include "analysis/Calibration.h"
#include "analysis/WindowChoice.h"
#include "base/RunContext.h"
#include "detect/NoiseBand.h"
#include "recording/Recording.h"
#include "spectrum/NormalisedFrames.h"
#include "spectrum/PeakPyramid.h"
#include "track/DetectionChain.h"
#include "track/Track.h"

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// One of several models that run in parallel.
struct BankMember {
    MarkovModel model;
    std::shared_ptr<const Calibration> calibration;
    double offset = 0.0; ///< taken off its statistic, nat: equal false-alarm probability at the threshold
};

/// Where the chain can go on from: its state before that frame.
struct ChainCheckpoint {
    Index frame = 0;
    std::shared_ptr<const DetectionChain::Snapshot> state;
};

/// What a run of the chain leaves behind. Immutable; parts that a change of settings leaves valid are shared.
struct Analysis {
    AnalysisSettings settings;
    RecordingPointer recording;           ///< null for ready-made frames
    NormalisedFramesPointer frames;       ///< random access, recomputed on demand
    std::shared_ptr<const NoiseBackground> background; ///< null for ready-made frames
    MarkovModel model;
    std::vector<BankMember> bank;         ///< several models in parallel, `model` the first; empty: `model` alone
    std::shared_ptr<const Calibration> calibration;
    double threshold = 0.0;               ///< nat
    double cellFramesPerHour = 0.0;       ///< cells × frames of an hour of this recording
    std::shared_ptr<const PeakPyramid> input;     ///< y in dB
    std::shared_ptr<const PeakPyramid> statistic; ///< D in nats
    /// Of frames on several axes: both pictures along one axis each, the maximum over the others. Of lines: empty.
    std::vector<std::shared_ptr<const PeakPyramid>> inputAlong, statisticAlong;
    /// Of frames on several axes: what was kept from the detector in each of them, and for which track.
    std::vector<std::vector<DetectionChain::Inhibition>> inhibitions;
    std::vector<Track> tracks;            ///< ordered by detection, then cell
    std::vector<Track> conventional;      ///< of frames on several axes: what thresholding each frame by itself would have found
    std::vector<float> lnK;               ///< per frame
    NoiseBand lnKBand;                    ///< where it stays on noise, under a law that regulates it (regulation.h)
    std::vector<float> continuedFraction; ///< per frame
    std::vector<double> statisticCounts;  ///< cells whose D lies in [i/4 - 4, (i+1)/4 - 4) nat: the data's own histogram

    std::vector<ChainCheckpoint> checkpoints; ///< evenly spaced, ≤ 32 MiB whatever is tracked; none of detectors that cannot tell their state

    std::optional<WindowChoice> choice; ///< where the window was left to the recording (chooseWindow.h)

    const Axis &time() const { return frames->time(); }
    const Grid &grid() const { return frames->grid(); }

    /// Whether it is what these settings ask for.
    bool answers(const AnalysisSettings &wanted) const { return settings == wanted || (choice && choice->asked == wanted); }
};

/// One detected signal, in physical units; a view of a track.
struct Event {
    int id = 0;
    double onsetSeconds = 0.0;
    double detectSeconds = 0.0;
    double endSeconds = 0.0;
    std::vector<double> position;   ///< at detection, one per axis (Hz; or m, degrees)
    double driftPerSecond = 0.0;    ///< straight-line slope of the track along the last axis
    double statistic = 0.0;         ///< in the detector's unit: the path's largest where it is its score, else that of the detection
    bool isConfirmed = false;
    bool isOpen = false;
    std::vector<double> ratesPerSecond; ///< as driftPerSecond, along every axis
    std::size_t model = 0;          ///< of a bank, the one that found it

    // Of tracks that were looked at from both ends (secondLook.h); NaN of others:
    double snrDb = std::numeric_limits<double>::quiet_NaN();     ///< mean power along the track over the noise's in one frame
    double bandWidth = std::numeric_limits<double>::quiet_NaN(); ///< of the 5-95 % band of its position, mean, in units of the last axis
    /// That noise alone brings an event as significant as this in this recording: 1 - exp(-rate(statistic)·cells·frames).
    double noiseProbability = std::numeric_limits<double>::quiet_NaN();
};

/// A track's statistic as its event has it.
double statisticOf(const Track &track, const Analysis &analysis);

/// The events of an analysis at its threshold, ordered by onset, then frequency.
std::vector<Event> events(const Analysis &analysis);
/// The same of other tracks on its frames, such as the conventional ones.
std::vector<Event> events(const Analysis &analysis, const std::vector<Track> &tracks);

/// Called with every block of frames' statistic, in order: first frame, frames × cells values.
using StatisticSink = std::function<void(Index firstFrame, std::span<const float> statistic)>;

/// What is there to be seen of a long recording before all of it has been gone through.
struct PicturesSoFar {
    std::shared_ptr<const PeakPyramid> glance;    ///< y in dB at some times of the whole recording
    std::shared_ptr<const PeakPyramid> input;     ///< y in dB as far as the chain got; null before it starts
    std::shared_ptr<const PeakPyramid> statistic; ///< D in nats, likewise
    Axis time;                                    ///< of all frames
    Axis frequency;
};

/// Called by the thread that computes, a few times a second, if the recording is long or not calibrated yet. Changes no byte.
using PictureSink = std::function<void(const PicturesSoFar &)>;

/// What an analysis is made for: everything, or its tracks without pictures and checkpoints.
enum class AnalysisDepth { Whole, Tracks };

/// The pipeline: recording → frames → normalised frames → detector → threshold, clusters, tracks.
///
/// Every caller, window, command line and library, comes through here. `previous`, if given, lends what is still valid.
/// Streams: memory is bounded whatever the recording's length. Throws Error, Cancelled.
/// A first estimate of the threshold is there sooner and is not the last word; nothing else of the run differs.
std::shared_ptr<Analysis> analyse(RecordingPointer recording, const AnalysisSettings &settings, const RunContext &context = {},
                                  const Analysis *previous = nullptr, const StatisticSink &sink = {}, const PictureSink &pictures = {},
                                  CalibrationDepth calibrationDepth = CalibrationDepth::Refined, AnalysisDepth depth = AnalysisDepth::Whole);

/// The same from ready-made frames on any grid, with the settings' own model or bank of models (`previous` lends its picture of the
/// input and the band of ln K) …
std::shared_ptr<const Analysis> analyse(NormalisedFramesPointer frames, const AnalysisSettings &settings, const RunContext &context = {},
                                        const Analysis *previous = nullptr, const StatisticSink &sink = {});

/// … or with a model of one's own.
std::shared_ptr<const Analysis> analyse(NormalisedFramesPointer frames, const MarkovModel &model, const AnalysisSettings &settings,
                                        const RunContext &context = {}, const StatisticSink &sink = {});

} // namespace faintline

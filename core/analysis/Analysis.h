#pragma once

#include "analysis/AnalysisSettings.h"
#include "analysis/Calibration.h"
#include "analysis/WindowChoice.h"
#include "base/Checkpoints.h"
#include "detect/NoiseBand.h"
#include "recording/Recording.h"
#include "spectrum/NormalisedFrames.h"
#include "spectrum/PeakPyramid.h"
#include "track/Area.h"
#include "track/DetectionChain.h"
#include "track/Track.h"

#include <memory>
#include <optional>
#include <vector>

namespace faintline {

/// One of several models that run in parallel.
struct BankMember {
    MarkovModel model;
    std::shared_ptr<const Calibration> calibration;
    double offset = 0.0; ///< subtracted from its statistic, nat: gives equal false-alarm probability at the threshold
};

/// Everything a chain is made from: frames, models with their calibrations, and the threshold.
struct AnalysisPlan {
    AnalysisSettings settings;
    RecordingPointer recording;     ///< null for ready-made frames
    NormalisedFramesPointer frames; ///< random access, recomputed on demand
    /// Frames of single lines, one per analysed channel, from which `frames` are made. Empty for ready-made frames.
    std::vector<NormalisedFramesPointer> lines;
    std::shared_ptr<const NoiseBackground> background; ///< of the first of these channels; null for ready-made frames
    MarkovModel model;
    std::vector<BankMember> bank; ///< several models in parallel, starting with `model`; empty: `model` only
    std::shared_ptr<const Calibration> calibration;
    double threshold = 0.0;         ///< nat
    double cellFramesPerHour = 0.0; ///< cells × frames per hour of this recording

    const Axis &time() const { return frames->time(); }
    const Grid &grid() const { return frames->grid(); }

    bool isBank() const { return !bank.empty(); }
    std::size_t modelCount() const { return isBank() ? bank.size() : 1; }
    const MarkovModel &modelAt(std::size_t number) const { return isBank() ? bank[number].model : model; }
    /// Offset subtracted from that model's statistic, nat.
    double offsetAt(std::size_t number) const { return isBank() ? bank[number].offset : 0.0; }
};

/// Result of a run of the chain, with its plan. Immutable; parts that remain valid after a change of settings are
/// shared.
struct Analysis : AnalysisPlan {
    std::shared_ptr<const PeakPyramid> input;     ///< y in dB
    std::shared_ptr<const PeakPyramid> statistic; ///< D in nats
    /// Both pictures along each axis, the maximum over the others; for lines, the pictures themselves.
    std::vector<std::shared_ptr<const PeakPyramid>> inputAlong, statisticAlong;
    /// For frames on several axes: the boxes inhibited in each frame, and their tracks.
    std::vector<std::vector<DetectionChain::Inhibition>> inhibitions;
    std::vector<Track> tracks; ///< ordered by detection, then cell
    /// Tracks that the recording's own noise explains (overOwnNoise.h), not among `tracks`.
    std::vector<Track> explainedByNoise;
    /// The tracks before signals were searched for behind others and identities assigned (secondLook.h), including
    /// those that the noise explains, untrimmed; kept while a window is chosen, because trials of other windows have no
    /// others.
    std::vector<Track> firstTracks;
    std::vector<Area> areas; ///< regions of raised level without a line, ordered by time (secondLook.h)
    /// For frames on several axes: the tracks found by thresholding each frame separately.
    std::vector<Track> conventional;
    std::vector<float> lnK;               ///< per frame
    NoiseBand lnKBand;                    ///< its range on noise, under a law that regulates it (regulation.h)
    std::vector<float> continuedFraction; ///< per frame
    std::vector<double> statisticCounts;  ///< cells whose D lies in [i/4 - 4, (i+1)/4 - 4) nat: histogram of the data

    /// States of the chain, evenly spaced, for repeating a part of the run: ≤ 32 MiB for any number of tracks; none for
    /// detectors that cannot save their state.
    Checkpoints<ChainState> checkpoints;

    std::optional<WindowChoice> choice; ///< if the recording determined the window (chooseWindow.h)
    /// In that case: analysis with the next longer window, whose steady lines are among `tracks` (steadyLines.h).
    /// Without pictures; null if there is no longer window.
    std::shared_ptr<const Analysis> longer;
    /// If strong lines were subtracted: analysis of the unchanged recording, without pictures. The frames and all other
    /// results are then those of the remainder; `tracks` has both (subtractLines.h). Null if nothing was subtracted.
    std::shared_ptr<const Analysis> unsubtracted;

    /// Whether this analysis has the given settings.
    bool answers(const AnalysisSettings &wanted) const
    {
        return settings == wanted || (choice && choice->asked == wanted);
    }
};

} // namespace faintline

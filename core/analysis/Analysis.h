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
    double offset = 0.0; ///< taken off its statistic, nat: equal false-alarm probability at the threshold
};

/// What a chain is made from: frames, models with their calibrations, and the threshold.
struct AnalysisPlan {
    AnalysisSettings settings;
    RecordingPointer recording;     ///< null for ready-made frames
    NormalisedFramesPointer frames; ///< random access, recomputed on demand
    /// Of single lines, one a channel that is analysed: what the frames are made from. Empty for ready-made frames.
    std::vector<NormalisedFramesPointer> lines;
    std::shared_ptr<const NoiseBackground> background; ///< of the first of these channels; null for ready-made frames
    MarkovModel model;
    std::vector<BankMember> bank; ///< several models in parallel, `model` the first; empty: `model` alone
    std::shared_ptr<const Calibration> calibration;
    double threshold = 0.0;         ///< nat
    double cellFramesPerHour = 0.0; ///< cells × frames of an hour of this recording

    const Axis &time() const { return frames->time(); }
    const Grid &grid() const { return frames->grid(); }

    bool isBank() const { return !bank.empty(); }
    std::size_t modelCount() const { return isBank() ? bank.size() : 1; }
    const MarkovModel &modelAt(std::size_t number) const { return isBank() ? bank[number].model : model; }
    /// What is taken off that model's statistic, nat.
    double offsetAt(std::size_t number) const { return isBank() ? bank[number].offset : 0.0; }
};

/// What a run of the chain leaves behind, with its plan. Immutable; parts that a change of settings leaves valid are
/// shared.
struct Analysis : AnalysisPlan {
    std::shared_ptr<const PeakPyramid> input;     ///< y in dB
    std::shared_ptr<const PeakPyramid> statistic; ///< D in nats
    /// Both pictures along each axis, the maximum over the others: of lines, the pictures themselves.
    std::vector<std::shared_ptr<const PeakPyramid>> inputAlong, statisticAlong;
    /// Of frames on several axes: what was kept from the detector in each of them, and for which track.
    std::vector<std::vector<DetectionChain::Inhibition>> inhibitions;
    std::vector<Track> tracks; ///< ordered by detection, then cell
    /// Not among them: what the recording's own noise explains (overOwnNoise.h).
    std::vector<Track> explainedByNoise;
    std::vector<Area> areas; ///< of raised level without a line, ordered by time (secondLook.h)
    /// Of frames on several axes: what thresholding each frame by itself would have found.
    std::vector<Track> conventional;
    std::vector<float> lnK;               ///< per frame
    NoiseBand lnKBand;                    ///< where it stays on noise, under a law that regulates it (regulation.h)
    std::vector<float> continuedFraction; ///< per frame
    std::vector<double> statisticCounts; ///< cells whose D lies in [i/4 - 4, (i+1)/4 - 4) nat: the data's own histogram

    /// States of the chain, evenly spaced, from which a part of the run is gone through again: ≤ 32 MiB whatever is
    /// tracked; none of detectors that cannot tell their state.
    Checkpoints<ChainState> checkpoints;

    std::optional<WindowChoice> choice; ///< where the window was left to the recording (chooseWindow.h)
    /// There too: of the next longer window, whose steady lines are among `tracks` (steadyLines.h). Without pictures;
    /// null where none is longer.
    std::shared_ptr<const Analysis> longer;
    /// Where strong lines were subtracted: of the recording as it is, without pictures. The frames, and all that a run
    /// leaves behind, are of the rest; `tracks` has both (subtractLines.h). Null where nothing was.
    std::shared_ptr<const Analysis> unsubtracted;

    /// Whether it is what these settings ask for.
    bool answers(const AnalysisSettings &wanted) const
    {
        return settings == wanted || (choice && choice->asked == wanted);
    }
};

} // namespace faintline

#pragma once

#include "frames/NormalisedFrames.h"
#include "noise/NoiseBackground.h"
#include "plan/AnalysisSettings.h"
#include "plan/Calibration.h"
#include "plan/constants.h"

#include <memory>
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

    /// The statistic, in nats, above which a track is about a hundred times rarer on noise than specified.
    double sureStatistic() const { return threshold + sureMarginNats; }

    bool isBank() const { return !bank.empty(); }
    std::size_t modelCount() const { return isBank() ? bank.size() : 1; }
    const MarkovModel &modelAt(std::size_t number) const { return isBank() ? bank[number].model : model; }
    /// Offset subtracted from that model's statistic, nat.
    double offsetAt(std::size_t number) const { return isBank() ? bank[number].offset : 0.0; }
};

} // namespace faintline

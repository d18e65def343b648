#pragma once

#include "base/RunContext.h"
#include "calibrate/CalibrationDepth.h"
#include "calibrate/CalibrationEffort.h"
#include "calibrate/constants.h"
#include "plan/AnalysisSettings.h"
#include "plan/Calibration.h"

#include <memory>
#include <optional>
#include <string>

namespace faintline {

/// What a calibration is of. Two requests with the same key have the same calibration, and a key says all that is
/// needed to make it: shipped ones are made again from their keys.
struct CalibrationRequest {
    AnalysisSettings settings; ///< those on which the response to noise depends, others at their defaults
    CalibrationDepth depth = CalibrationDepth::Refined;
    Index bins = 0;                     ///< of a band with two ends; 0: a wide band
    std::optional<MarkovModel> model{}; ///< of independent cells, in place of a spectrogram
    double cellFrames = 0.0;            ///< of independent cells

    /// JSON on one line.
    std::string key() const;
};

/// The request with a key. Throws Error naming the cause.
CalibrationRequest requestOf(const std::string &key);

/// For frames of a recording. The key is in bins and frames: neither the sample rate nor the length of the window
/// splits it, nor what does not act on the causal chain. For channels, it has their number.
AnalysisSettings dimensionless(AnalysisSettings settings);

/// For ready-made frames, with a model of their own.
AnalysisSettings ofIndependentCells(AnalysisSettings settings);

/// Simulates the calibration that is requested. Null if it is a first estimate that would be too inaccurate. That of a
/// narrow band starts from the wide band's, which is cached.
std::shared_ptr<const Calibration> makeCalibration(const CalibrationRequest &request, const CalibrationEffort &effort,
                                                   const RunContext &context = {});

/// The same for a request with bins, and with a model.
std::shared_ptr<const Calibration> makeBandCalibration(const CalibrationRequest &request,
                                                       const CalibrationEffort &effort, const RunContext &context);
std::shared_ptr<const Calibration> makeIndependentCalibration(const CalibrationRequest &request,
                                                              const CalibrationEffort &effort,
                                                              const RunContext &context);

/// The calibration that is requested: cached, or made now with the effort of its depth and then cached. If a refined
/// one is cached, it serves as a first estimate, too. Null as above.
std::shared_ptr<const Calibration> requestedCalibration(const CalibrationRequest &request, const RunContext &context);

} // namespace faintline

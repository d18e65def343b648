#pragma once

#include "base/RunContext.h"
#include "calibrate/CalibrationDepth.h"
#include "plan/Calibration.h"

#include <memory>

namespace faintline {

/// Simulates white noise through spectrogram, normaliser and detector and measures the response. Depends only on the
/// dimensionless part of the settings (windows, overlaps, model, detector). This part is also the key under which
/// results are cached, for the life of the program and in the `CalibrationStore`. A refined one that is cached serves
/// as a first estimate, too.
std::shared_ptr<const Calibration> calibrate(const AnalysisSettings &settings, const RunContext &context = {},
                                             CalibrationDepth depth = CalibrationDepth::Refined);

/// The refined calibration that is cached or was shipped for these settings, or null; for callers that would rather do
/// something else than wait.
std::shared_ptr<const Calibration> knownCalibration(const AnalysisSettings &settings);

/// The same for a band of `bins` bins on one axis: paths leave it at its ends, and in a narrow band few of them last.
///
///   ln rate(T) = ln rate_wide(T) + ln S_band(T) - ln S_wide(T),   S: excursions per cell and frame, each by splitting
///
/// From 64 bins on (of bands of 256 bins or more with slopes of four bins, from 128 on) the loss at the ends falls as
/// 1/bins. From 256 times the steepest slope on, and for lines that stay in their bin and detectors without splitting,
/// the wide band's calibration is used.
std::shared_ptr<const Calibration> calibrateBand(const AnalysisSettings &settings, Index bins,
                                                 const RunContext &context = {},
                                                 CalibrationDepth depth = CalibrationDepth::Refined);

/// The same for the frames of a spectrogram, or of a family over it, with the spectrogram's actual window.
std::shared_ptr<const Calibration> calibrateBand(AnalysisSettings settings, const Spectrogram &spectrogram,
                                                 const RunContext &context = {},
                                                 CalibrationDepth depth = CalibrationDepth::Refined);

/// The model on a part of its grid that is large enough to measure its response to noise: above 20 000 cells, the
/// longest bounded axis is cut to about 5000 cells in total and made cyclic, so that no path leaves the part. A sonar's
/// bounded range axis loses such paths, hence its false alarms are 13 to 40 % fewer than predicted here.
MarkovModel calibrationSubgrid(const MarkovModel &model);

/// The same for ready-made frames: independent exponential cells on a grid of the model's shape, or on its
/// calibrationSubgrid.
std::shared_ptr<const Calibration> calibrateOnIndependentCells(const MarkovModel &model,
                                                               const AnalysisSettings &settings,
                                                               const RunContext &context = {}, double cellFrames = 4e7);

} // namespace faintline

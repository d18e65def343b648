#pragma once

#include "base/RunContext.h"
#include "calibrate/CalibrationEffort.h"
#include "calibrate/CalibrationRequest.h"
#include "plan/Calibration.h"

#include <memory>

namespace faintline {

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

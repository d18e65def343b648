#pragma once

#include "base/RunContext.h"
#include "plan/Calibration.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace faintline {

// Cache of calibrations: the memory of this program, those that were shipped with it, and the user's folder.

/// How long a program that makes a calibration may give no sign of life before others stop waiting for it: it may have
/// been suspended.
inline constexpr std::chrono::minutes longestSilence{2};

/// The calibration cached under a key, or else the result of `make`, which is then cached. If several threads and
/// programs need the same one at the same time, one makes it and the others wait, however long it takes: `make` gives a
/// sign of life with each checkpoint of its context. Null only if `make` returns null. Throws what `make` throws, and
/// Cancelled.
std::shared_ptr<const Calibration>
keptCalibration(const std::string &key,
                const std::function<std::shared_ptr<const Calibration>(const RunContext &)> &make,
                const RunContext &context, std::chrono::milliseconds silence = longestSilence);

/// The calibration cached under a key, or null.
std::shared_ptr<const Calibration> cachedCalibration(const std::string &key);

/// Caches a calibration for the life of the program, in place of any other under its key.
void rememberCalibration(const std::string &key, std::shared_ptr<const Calibration> calibration);

} // namespace faintline

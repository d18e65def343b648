#pragma once

#include "analysis/analyse.h"
#include "base/Error.h"

#include <QString>

namespace faintline {

// What is said of a threshold that is not the last word yet.

/// "Threshold 8.93 nat (first estimate, false alarms within a factor 1.5; being refined)".
QString firstEstimateSentence(const Analysis &analysis, bool isBusy);

/// "Threshold refined: 8.87 nat instead of 8.93. Events follow it."
QString refinedSentence(const Analysis &analysis, double firstEstimate);

/// Why nothing is exported yet: it would not be what the settings bring again.
Error firstEstimateError();

} // namespace faintline

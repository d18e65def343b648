#pragma once

#include "base/Error.h"
#include "plan/Analysis.h"

#include <QString>

namespace faintline {

// Texts for a preliminary threshold.

/// "Threshold 8.93 nat (first estimate, false alarms within a factor 1.5; being refined)".
QString firstEstimateSentence(const Analysis &analysis, bool isBusy);

/// "Threshold refined: 8.87 nat instead of 8.93. Events follow it."
QString refinedSentence(const Analysis &analysis, double firstEstimate);

/// Error on export with a preliminary threshold, because the settings would not reproduce the result.
Error firstEstimateError();

} // namespace faintline

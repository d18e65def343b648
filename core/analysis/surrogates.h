#pragma once

#include "analysis/analyse.h"
#include "base/Interval.h"

namespace faintline {

/// How many false alarms a recording's own noise gives, against how many were ordered.
struct SurrogateCount {
    int runs = 0;
    double hours = 0.0;        ///< of all runs together
    double orderPerHour = 0.0; ///< that was counted at: the order, or as much more as it takes to expect 30 events
    double threshold = 0.0;    ///< for that order
    double ordered = 0.0;      ///< events
    Index events = 0;          ///< found
    double ratio = 0.0;        ///< found over ordered …
    Interval interval;         ///< … and its 95 % interval, from the Poisson count
    /// To be added to a threshold so that as many come as were ordered: ln(ratio)/θ where the interval leaves out 1,
    /// else 0.
    double correction = 0.0;
};

/// Analyses `runs` surrogates of a recording (SurrogateRecording): white noise shaped by the estimated background,
/// through the whole front end and chain, counting events. What differs from the simulated noise of `calibrate`
/// (length, band, gaps, quantisation, the background's colour and changes) is in it; what a surrogate does not have
/// (tones, clicks, spread signals) is not. Throws Error, Cancelled. Cost: as many analyses.
SurrogateCount countOnSurrogates(RecordingPointer recording, const AnalysisSettings &settings, int runs,
                                 const RunContext &context = {});

} // namespace faintline

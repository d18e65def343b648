#pragma once

#include "base/Interval.h"
#include "base/RunContext.h"
#include "plan/Analysis.h"

namespace faintline {

/// Number of false alarms on a recording's own noise, compared with the number specified.
struct SurrogateCount {
    int runs = 0;
    double hours = 0.0;        ///< total over all runs
    double orderPerHour = 0.0; ///< rate used: the specified one, or more if needed to expect 30 events
    double threshold = 0.0;    ///< for that rate
    double ordered = 0.0;      ///< expected number of events
    Index events = 0;          ///< number found
    double ratio = 0.0;        ///< found over expected …
    Interval interval;         ///< … and its 95 % interval, from the Poisson count
    /// Correction to add to a threshold to get the specified number: ln(ratio)/θ if the interval excludes 1, else 0.
    double correction = 0.0;
};

/// Analyses `runs` surrogates of a recording (SurrogateRecording), white noise shaped by the estimated background, with
/// the whole front end and chain, and counts events. Includes differences from the simulated noise of `calibrate`
/// (length, band, gaps, quantisation, the background's colour and changes), but not what a surrogate lacks (tones,
/// clicks, spread signals). Throws Error, Cancelled. Cost: as many analyses.
SurrogateCount countOnSurrogates(RecordingPointer recording, const AnalysisSettings &settings, int runs,
                                 const RunContext &context = {});

} // namespace faintline

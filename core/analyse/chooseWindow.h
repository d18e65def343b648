#pragma once

#include "analyse/AnalysisRequest.h"
#include "base/Axis.h"
#include "base/RunContext.h"
#include "plan/Analysis.h"
#include "signal/Recording.h"

#include <span>

namespace faintline {

/// Whether these settings let the recording determine window and law of motion: T_FT = 0 and the default law of the
/// sequential Markov detector, with two-sided tracks.
bool leavesWindowToRecording(const AnalysisSettings &settings);

/// The settings with the window and law chosen for an analysis, if both leave them open; else unchanged.
AnalysisSettings inWindowOf(const Analysis &analysis, const AnalysisSettings &settings);

/// The settings with the window and law of motion of a trial.
AnalysisSettings inWindowOf(const WindowTrial &trial, AnalysisSettings settings);

/// Analyses a recording in a window that suits its signals. Precondition: leavesWindowToRecording(settings).
///
/// The automatic window T0 (Spectrogram::automaticWindowSeconds) is used first, with its pictures. Others, each four
/// times as long or short as the previous one, are tried for their tracks alone, and judged by the fraction k of the
/// energy along the shorter one's tracks that the longer one follows as well (energyKept; for tracks a hundred times
/// rarer on noise than specified):
///
///   shorter  while k < 1/3: signals move too fast for the longer one. Accepted only if k ≥ 1/3 is reached, because for
///            signals other than lines every shorter window follows more. Shorter windows use the law of fast signals
///            (laws::glide).
///   longer   while k ≥ 0.85: a window four times as long loses almost nothing, and fainter lines stand out of the
///            noise.
///
/// Windows have at least 24 cells in the band and 16 frames, and no more samples than any T0. On noise no track is sure
/// enough, and T0 is kept; at most five windows are compared. The result's `choice` lists the trials, and its `settings`
/// have the window and law used. If only the threshold or the tracks' settings change, the choice of `previous` is
/// kept, unless it was made with a first estimate.
///
/// If strong lines are subtracted, windows are tried on the unchanged recording, and lines are subtracted in the chosen
/// window and in the others.
///
/// The statistic is that of a second run with the chosen window.
///
/// The result's tracks are those of the chosen window and what the others know better (otherWindows.h): those that were
/// tried, T0 times ¼ and 4, the chosen one times ¼ and 4, and ½ if any has a sure track, and shorter ones as long as the
/// next would see better what the last one knew better, if that comes to an end, and each has more evidence of most
/// tracks of the last one.
std::shared_ptr<const Analysis> runInChosenWindow(const RecordingPointer &recording, const AnalysisSettings &settings,
                                                  const AnalysisRequest &request, const RunContext &context);

/// Smoothed tracks of one analysis, and the axes that convert their points to seconds and hertz.
struct TracksOnAxes {
    std::span<const Track> tracks; ///< with one smoothed point per point
    const Axis &time;
    const Axis &frequency;
    double cellHz = 0.0; ///< resolution 1/T_FT
};

/// Fraction of the energy followed by tracks of a shorter window that tracks of a longer window followed at the same
/// places:
///
///   E(X) = Σ r(t) over all tracks within X's path ± 1 cell of the shorter window, in X's time
///   share = E_longer(X)/E_shorter(X)
///
/// r is a signal's power over the noise's in one frame. Both sides have the same number of frames per window, so a
/// steady line has the same E in both: its r grows with T_FT as the number of frames falls. The power of a line that
/// moves by more than a cell within the longer window spreads over several cells, of which a path follows one. Returns
/// the median, weighted by duration, over the tracks X of at least `leastStatistic` that the longer window detected at
/// all; NaN without such tracks. All tracks must be two-sided (secondLook.h).
double energyKept(const TracksOnAxes &shorter, const TracksOnAxes &longer, double leastStatistic);

} // namespace faintline

#pragma once

#include "analysis/analyse.h"

namespace faintline {

/// Whether these settings leave window and law of motion to the recording: T_FT = 0 and the default law of the
/// sequential Markov detector, whose tracks are looked at from both ends.
bool leavesWindowToRecording(const AnalysisSettings &settings);

/// The settings with the window and law that were chosen for an analysis, if both leave them open; else as they are.
AnalysisSettings inWindowOf(const Analysis &analysis, const AnalysisSettings &settings);

/// The settings with the window and law of motion of a trial.
AnalysisSettings inWindowOf(const WindowTrial &trial, AnalysisSettings settings);

/// `analyse`, with the window that suits the signals of the recording where the settings leave it open.
///
/// The automatic window T0 (Spectrogram::automaticWindowSeconds) comes first, with its pictures. Others, four times as
/// long or short from one to the next, are tried for their tracks alone, and judged by the share k of the energy along
/// the shorter one's tracks that the longer one follows as well (energyKept; of tracks a hundred times rarer on noise
/// than ordered):
///
///   shorter  while k < 1/3: signals move too fast for the longer one. Taken only where k ≥ 1/3 is reached, for of what
///            is no line every shorter window has more. Shorter windows take the law of fast signals (laws::glide).
///   longer   while k ≥ 0.85: a window four times as long costs next to nothing, and fainter lines stand out of the
///            noise.
///
/// Windows have at least 24 cells in the band and 16 frames, and no more samples than any T0. On noise nothing is sure
/// enough to judge by, and T0 stays; at most five windows are tried. The answer's `choice` tells what was tried, its
/// `settings` the window and law used. A change of the threshold or the tracks' settings alone keeps the choice of
/// `previous`, unless that was made by a first estimate.
///
/// Where strong lines are subtracted, windows are tried on the recording as it is, and lines subtracted in the one that
/// is chosen and in the next longer one.
///
/// The answer's tracks are those of the window chosen and the steady lines that only the next longer one finds
/// (steadyLines.h), which may have as few as four frames.
std::shared_ptr<const Analysis> analyseInChosenWindow(RecordingPointer recording, const AnalysisSettings &settings,
                                                      const RunContext &context = {},
                                                      const Analysis *previous = nullptr,
                                                      const PictureSink &pictures = {},
                                                      CalibrationDepth calibrationDepth = CalibrationDepth::Refined,
                                                      AnalysisDepth depth = AnalysisDepth::Whole);

} // namespace faintline

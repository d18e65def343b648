#pragma once

#include "app/headless/RenderOptions.h"
#include "plan/AnalysisSettings.h"

namespace faintline {

class MainWindow;

/// Each function opens one kind of source in the window as a user would, with the settings of the options, and waits
/// until all computations have ended; the window is the same from run to run. Throws Error if the source cannot be
/// opened, or does not support the settings or views of the options.

/// A recording, a scenario of lines or pings, or a session, with the settings of A. Returns the settings without those
/// of A only.
AnalysisSettings openAndSettle(MainWindow &window, const RenderOptions &options);

/// The source opened with A's settings becomes A; then the settings change to B's.
void compareWithA(MainWindow &window, const AnalysisSettings &settings);

/// Radar scans: a run of their sequential test, at the stage of the cursor's time.
void testScans(MainWindow &window, const RenderOptions &options);

/// The window in the state of a lesson's step.
void goThroughLesson(MainWindow &window, const RenderOptions &options);

/// The table of a survey.
void openSurvey(MainWindow &window, const RenderOptions &options);

/// An experiment that is carried out, or results that are read; the curves are complete at the end.
void openExperiment(MainWindow &window, const RenderOptions &options);

} // namespace faintline

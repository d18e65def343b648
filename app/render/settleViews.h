#pragma once

#include <functional>

namespace faintline {

class MainWindow;

/// Each function fills a view of the window as a user would, and waits until all work is done; the result is the same
/// from run to run. Throws Error if the source does not support the view.

/// Waits for the end of all experiments.
void settleExperiments(MainWindow &window);
/// Runs a small experiment on lines like those of the papers and shows its curves.
void measureCurves(MainWindow &window);
/// Runs a small sweep of the threshold.
void sweepThreshold(MainWindow &window);
/// Explains why there is a detection at the cursor, or none.
void explainCursor(MainWindow &window);
void measureNoise(MainWindow &window);
/// Draws all channels of a recording.
void showChannels(MainWindow &window);
/// Fits the track of the strongest event.
void fitDoppler(MainWindow &window);
void cutStates(MainWindow &window);
void measureLatency(MainWindow &window);

/// Waits until the noise outside tracks has been checked.
void settleSpectrum(MainWindow &window);
void settleNoiseCheck(MainWindow &window);

/// Updates what depends on the size of a view after it was shown: its number of pixels or their size may have changed.
void settleLayers(MainWindow &window);
void settleCloseup(MainWindow &window);

/// Calls `start`, which starts a computation in the sequential panel, and waits for its end.
void testAndSettle(MainWindow &window, const std::function<void()> &start);

} // namespace faintline

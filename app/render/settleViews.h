#pragma once

#include <functional>

namespace faintline {

class MainWindow;

/// Puts into a window's views what a picture of them shows, as a person would, and waits until nothing is left to do:
/// the same from run to run. What cannot be had of this source throws Error.

/// A small experiment on lines such as the papers', as curves.
void measureCurves(MainWindow &window);
/// A small sweep of the threshold.
void sweepThreshold(MainWindow &window);
/// Why there is, or is no, detection at the cursor.
void explainCursor(MainWindow &window);
void measureNoise(MainWindow &window);
/// To the strongest event's track.
void fitDoppler(MainWindow &window);
void cutStates(MainWindow &window);
void measureLatency(MainWindow &window);

/// Until the noise outside tracks has been looked at.
void settleSpectrum(MainWindow &window);
void settleNoiseCheck(MainWindow &window);

/// What follows the size of a view that was shown: another one may have more pixels to fill, or smaller ones.
void settleLayers(MainWindow &window);
void settleCloseup(MainWindow &window);

/// Calls what starts something in the sequential panel.
void testAndSettle(MainWindow &window, const std::function<void()> &start);

} // namespace faintline

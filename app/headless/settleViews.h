#pragma once

#include "app/base/JobRunner.h"

#include <functional>
#include <optional>

namespace faintline {

class MainWindow;

/// Calls `start`, waits until nothing that it started in `part` runs, and throws the error that `part` signals.
template <class Part>
void runAndSettle(Part &part, const std::function<void()> &start)
{
    std::optional<Error> failure;
    const QObject scope;
    QObject::connect(&part, &Part::failed, &scope, [&](const Error &error) { failure = error; });
    start();
    settle(part);
    if (failure)
        throw *failure;
}

/// Each function fills a view of the window as a user would, and waits until all work is done; the result is the same
/// from run to run. Throws Error if the source does not support the view.

/// Brings the view's panel to the front, which computes once it is seen.
void showAndSettle(MainWindow &window, const QString &view);
/// Waits for the end of all experiments.
void settleExperiments(MainWindow &window);
/// Runs a small experiment on lines like those of the papers and shows its curves.
void measureCurves(MainWindow &window);
/// Runs a small sweep of the threshold.
void sweepThreshold(MainWindow &window);
void measureLatency(MainWindow &window);

/// Calls `start`, which starts a computation in the sequential panel, and waits for its end.
void testAndSettle(MainWindow &window, const std::function<void()> &start);

} // namespace faintline

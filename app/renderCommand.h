#pragma once

#include "analysis/AnalysisSettings.h"
#include "recording/openRecording.h"

#include <QImage>
#include <QStringList>

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// What `faintline render` is asked for.
struct RenderOptions {
    std::string source; ///< recording, scenario or session
    std::string out;    ///< PNG; with several views, their names go before the extension
    std::vector<std::string> views{"window"};
    QSize size{1600, 1000};
    double scale = 1.0; ///< device pixels per pixel: the picture has so many times the size
    std::optional<double> seconds; ///< where the cursor goes
    std::optional<double> hz;
    std::optional<double> range;   ///< of pings
    std::optional<double> bearing;
    std::string layer = "statistic"; ///< of the output (outputLayerNames)
    bool isLayerOver = false;        ///< over the statistic
    std::string theme = "light";
    std::string preset;
    std::vector<std::string> settings; ///< "name=value"
    std::string presetA;               ///< of "compare": what A starts from
    std::vector<std::string> settingsA; ///< of "compare": those of A alone
    OpenOptions opening;
    std::optional<int> channel;
    std::optional<int> step;   ///< of a lesson, counted from 1
    bool isFocused = true;     ///< the keys are the view's, which has a frame then
};

/// Opens the source (a lesson: at a step) in a window nobody sees, waits until it has settled, and writes the pictures: the same bytes from
/// run to run. Needs a QApplication. Throws Error.
void render(const RenderOptions &options);

/// A picture to be made again from what it tells of itself, or the numbers of a sequential test's chart from what stands beside them.
struct ReplayOptions {
    std::string picture;   ///< PNG that `render` wrote, or the window with what suffices for it; or .csv
    std::string recording; ///< where the recording is; empty: beside the picture
};

/// Whether it is the latter.
bool isChart(const ReplayOptions &options);

/// Device pixels per pixel that a picture says it was made with, else 1: Qt wants to know before its application begins.
double scaleOf(const QImage &picture);

/// Compares pixels, or bytes; prints whether they are the same. Throws Error where they are not, or where it cannot be made again.
void replay(const ReplayOptions &options);

/// The same for a report as one HTML page: the same bytes from run to run.
void report(const RenderOptions &options);

} // namespace faintline

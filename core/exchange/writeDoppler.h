#pragma once

#include "analyse/events.h"
#include "evaluate/experiments/Chart.h"
#include "inspect/doppler/DopplerPass.h"
#include "inspect/doppler/dopplerFit.h"

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// A fit with the events and points on which it is based.
struct DopplerReport {
    std::vector<Event> events;
    double centreHz = 0.0; ///< added to the frequencies of the frames
    DopplerTrack track;
    DopplerFit fit;
};

/// Frequency, in Hz, that corresponds to 0 Hz of an analysis's frames: 0, or for I/Q the centre frequency; nothing if
/// the recording does not give it.
std::optional<double> centreOfFrames(const AnalysisPlan &plan);

/// Fits events of an analysis, the pieces of one pass. `centreHz`: frequency, in Hz, that corresponds to 0 Hz of its
/// frames (centreOfFrames); `propagation`: speed of the waves, m/s, > 0. Throws Error if the events are not such pieces
/// or their tracks are too short (dopplerFit.h, dopplerFit.h).
DopplerReport dopplerReport(const Analysis &analysis, std::vector<Event> events, double centreHz, double propagation);

/// One parameter as displayed in tables.
struct DopplerRow {
    std::string name; ///< "rest frequency"
    std::string unit;
    double value = 0.0;
    DopplerBounds bounds;
};

/// Rest frequency, speed, range and time of closest approach (at the source), in this order.
std::vector<DopplerRow> dopplerRows(const DopplerFit &fit);

/// "12.3 … 14.0", to two digits of its width; "above 12.3", "below 14", or "open".
std::string boundsText(const DopplerBounds &bounds);
/// A value with as many digits as its bounds.
std::string valueText(double value, const DopplerBounds &bounds);

/// "3" or "3, 5".
std::string eventNumbers(const DopplerReport &report);
/// Quantities that cannot be determined, from track and fit.
std::vector<std::string> dopplerNotes(const DopplerReport &report);

/// Parameters with their intervals (null if open), residuals, and quantities that cannot be determined, as JSON.
std::string dopplerJson(const DopplerReport &report);
/// One row per point: t, f, deviation, fitted, residual, left_out (1: not used in the fit).
std::string dopplerCsv(const DopplerReport &report);

/// Writes JSON or CSV by the path's ending, .json or .csv. Throws Error.
void writeDoppler(const DopplerReport &report, const std::string &path);

/// Frequency against time with the fitted curve, and the residuals below. Bars show the frequencies' 5-95 % bands;
/// points that were left out form a separate curve.
std::vector<Chart> dopplerCharts(const DopplerReport &report);

} // namespace faintline

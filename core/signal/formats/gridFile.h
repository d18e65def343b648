#pragma once

#include "base/Grid.h"
#include "signal/RawPings.h"

#include <string>
#include <vector>

namespace faintline {

/// Grid and time axis of a stack of frames: { "axes": [ { "name", "unit", "first", "step", "count", "cyclic" } ],
/// "time": { "first", "step" }, "values": "normalised" | "power" | "magnitude" | "decibels" | "iq", "scale", "offset"
/// }; count is optional if the frames determine it. With "iq" the stack has a last axis of two, I and Q, that the grid
/// does not have. Throws Error.
struct GridFile {
    Grid grid;
    Axis time;
    bool isPower = false;                      ///< a spectrogram in its own unit that is not normalised yet
    PingValues values = PingValues::Automatic; ///< what the file says of the numbers; Automatic: nothing
    bool isIq = false;
    double scale = 1.0; ///< a number stands for scale · number + offset
    double offset = 0.0;
};
GridFile readGridFile(const std::string &path, const std::vector<Index> &shape);

/// The text of a grid file, as read by readGridFile.
std::string gridFileText(const GridFile &file);

/// Axes without units for a stack of which nothing is known but its shape.
GridFile plainGrid(const std::vector<Index> &shape);

} // namespace faintline

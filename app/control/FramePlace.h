#pragma once

#include "widgets/base/Viewport.h"
#include "widgets/pings/PingViewports.h"

#include <optional>
#include <vector>

namespace faintline {

class Document;

/// A place in a frame.
struct FramePlace {
    double seconds = 0.0;
    std::vector<double> position; ///< one per axis of the grid, in its unit
};

/// Where the cursor stands; nothing where there is none.
std::optional<FramePlace> cursorOf(const Viewport &lines);
std::optional<FramePlace> cursorOf(const PingViewports &pings);
/// In what is open.
std::optional<FramePlace> cursorOf(Document &document, const PingViewports &pings);

} // namespace faintline

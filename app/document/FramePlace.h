#pragma once

#include "widgets/base/Viewport.h"
#include "widgets/pings/PingViewports.h"

#include <optional>
#include <vector>

namespace faintline {

class Document;

/// A position in a frame.
struct FramePlace {
    double seconds = 0.0;
    std::vector<double> position; ///< one per axis of the grid, in its unit
    bool operator==(const FramePlace &) const = default;
};

/// Position of the cursor; nothing if there is none.
std::optional<FramePlace> cursorOf(const Viewport &lines);
std::optional<FramePlace> cursorOf(const PingViewports &pings);
/// For the open source.
std::optional<FramePlace> cursorOf(Document &document, const PingViewports &pings);

} // namespace faintline

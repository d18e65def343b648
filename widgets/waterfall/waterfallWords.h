#pragma once

#include "widgets/base/Viewport.h"
#include "widgets/waterfall/Sidebands.h"

#include <QString>

namespace faintline {

class WaterfallPicture;

/// What a WaterfallPicture says of the places one points at.

/// "Cursor at 12.3 s, 440.0 Hz, 8.1 dB", for who cannot see it; without a cursor how to get one.
QString cursorText(const WaterfallPicture &view);

/// Extents and slope of a box, then the levels in it.
QString boxText(const WaterfallPicture &view, const Viewport::Box &box);

/// Carrier, spacing and, at that time, the level of each order.
QString sidebandText(const WaterfallPicture &view, const Sidebands &lines, double seconds);

} // namespace faintline

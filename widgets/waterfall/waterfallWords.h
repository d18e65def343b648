#pragma once

#include "widgets/base/Viewport.h"
#include "widgets/waterfall/Sidebands.h"

#include <QString>

namespace faintline {

class WaterfallPicture;

/// Texts of a WaterfallPicture about places in it.

/// "Cursor at 12.3 s, 440.0 Hz, 8.1 dB", for accessibility; without a cursor, how to place one.
QString cursorText(const WaterfallPicture &view);

/// Extents and slope of a box, then the levels in it.
QString boxText(const WaterfallPicture &view, const Viewport::Box &box);

/// Carrier, spacing and the level of each order at that time.
QString sidebandText(const WaterfallPicture &view, const Sidebands &lines, double seconds);

} // namespace faintline

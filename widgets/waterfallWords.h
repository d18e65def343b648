#pragma once

#include "widgets/Sidebands.h"
#include "widgets/Viewport.h"

#include <QString>

namespace faintline {

class WaterfallView;

/// What a WaterfallView says of the places one points at.

/// "Cursor at 12.3 s, 440.0 Hz, 8.1 dB", for who cannot see it; without a cursor how to get one.
QString cursorText(const WaterfallView &view);

/// Extents and slope of a box, then the levels in it.
QString boxText(const WaterfallView &view, const Viewport::Box &box);

/// Carrier, spacing and, at that time, the level of each order.
QString sidebandText(const WaterfallView &view, const Sidebands &lines, double seconds);

} // namespace faintline

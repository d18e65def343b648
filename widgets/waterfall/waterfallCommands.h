#pragma once

class QKeyEvent;
class QMenu;

namespace faintline {

class MarkedWaterfall;

/// What a key does to a MarkedWaterfall that has a picture; whether it is one of its own.
///
/// Arrows move the cursor by a cell (with Ctrl by ten), Backspace goes back, 0 shows all, O turns, [ ] move the black
/// level and { } the white one, A is the automatic range, C the next colour map, `,` `.` move the threshold, M
/// measures, H shows harmonics, I sidebands (Alt with Left and Right changes their spacing by a bin), K goes to the
/// peak, Escape clears what was marked.
bool pressKey(MarkedWaterfall &view, const QKeyEvent &event);

/// The same as a menu, and what has no key: layers, colour maps by name.
void addCommands(QMenu &menu, MarkedWaterfall &view);

} // namespace faintline

#pragma once

class QKeyEvent;
class QMenu;

namespace faintline {

class MarkedWaterfall;

/// Handles a key on a MarkedWaterfall that has a picture; returns whether the key was used.
///
/// Arrows move the cursor by a cell (with Ctrl by ten), Backspace zooms back, 0 shows all, O changes the orientation, [
/// ] move the black level and { } the white one, A sets the automatic range, C the next colour map, `,` `.` move the
/// threshold, M measures, H shows harmonics, I sidebands (Alt with Left and Right changes their spacing by a bin), K
/// goes to the peak, Escape clears marks.
bool pressKey(MarkedWaterfall &view, const QKeyEvent &event);

/// The same as a menu, plus commands without a key: layers, colour maps by name.
void addCommands(QMenu &menu, MarkedWaterfall &view);

} // namespace faintline

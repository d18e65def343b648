#pragma once

class QWidget;

namespace faintline {

class WindowParts;

/// Asks for a line, and adds it to the open recording.
void injectLine(WindowParts &parts, QWidget &window);
void learnMotion(WindowParts &parts, QWidget &window);
/// Along the selected event's track, or the strongest's.
void straighten(WindowParts &parts, QWidget &window);

} // namespace faintline

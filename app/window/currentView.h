#pragma once

#include <QString>

class QWidget;

namespace faintline {

class WindowParts;

/// Name of the current view: the innermost one with the focus, else the one under the mouse, else the first one that
/// the window shows. Names are those of WindowViews::names, and "profile" and "regulation"; empty on the welcome page.
QString currentView(const QWidget &window, const WindowParts &parts);

} // namespace faintline

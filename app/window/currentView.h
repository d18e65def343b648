#pragma once

#include <QString>

class QWidget;

namespace faintline {

class WindowParts;

/// The view one is at: the innermost one that has the focus, else the one under the mouse, else what the window shows
/// first. Named as in WindowViews::names, besides them "profile" and "regulation"; empty on the welcome page.
QString currentView(const QWidget &window, const WindowParts &parts);

} // namespace faintline

#pragma once

#include <QString>

namespace faintline {

class MainWindow;

/// The view one is at: the innermost one that has the focus, else the one under the mouse, else what the window shows first. Named as in
/// WindowViews::names, besides them "profile" and "regulation"; empty on the welcome page.
QString currentView(MainWindow &window);

} // namespace faintline

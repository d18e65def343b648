#pragma once

#include <QIcon>

namespace faintline {

/// An icon of resources/icons by its name ("open", "run", "show-all" …), drawn in the colour of the palette's text, so
/// it follows a change of theme by itself.
QIcon icon(const QString &name);

/// The program's own icon, in its own colours.
QIcon programIcon();

} // namespace faintline

#pragma once

#include <QIcon>

namespace faintline {

/// An icon of resources/icons by name ("open", "run", "show-all" …), drawn in the palette's text colour, so that it
/// follows changes of the theme.
QIcon icon(const QString &name);

/// The program's own icon, in its own colours.
QIcon programIcon();

} // namespace faintline

#pragma once

#include <QCoreApplication>

namespace faintline {

/// A text of the window in the user's language, outside of QObject's classes.
inline QString tr(const char *text)
{
    return QCoreApplication::translate("faintline", text);
}

} // namespace faintline

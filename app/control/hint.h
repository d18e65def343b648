#pragma once

#include <QString>

namespace faintline {

class Document;

/// One sentence on what to try next, for the status bar. `isBusy`: whether something is being computed; `usual`: what
/// is said where there are events.
QString hint(const Document &document, bool isBusy, const QString &usual);

} // namespace faintline

#pragma once

#include <QString>

namespace faintline {

class Document;

/// One sentence on what to try next, for the status bar; `isBusy`: whether something is being computed.
QString hint(const Document &document, bool isBusy);

} // namespace faintline

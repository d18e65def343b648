#pragma once

#include <QString>

namespace faintline {

class Document;

/// One sentence on what to try next, for the status bar.
QString hint(const Document &document);

} // namespace faintline

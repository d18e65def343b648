#pragma once

#include <QString>

namespace faintline {

class Document;

/// A sentence for the status bar on what to try next. `isBusy`: whether a computation is running; `usual`: the sentence
/// if there are events.
QString hint(const Document &document, bool isBusy, const QString &usual);

} // namespace faintline

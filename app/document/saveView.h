#pragma once

#include <QString>

#include <string>

class QWidget;

namespace faintline {

/// Writes a view as displayed, in the format of the path's extension: .png, .svg or .pdf; or its numbers, .csv. Throws
/// Error.
///
/// `provenance`: JSON that is stored in the PNG's text "provenance", the SVG's description, a file attached to the PDF,
/// or in PATH.provenance.json beside the numbers.
void saveView(QWidget &view, const std::string &csv, const QString &path, const std::string &provenance = {});

/// File dialog filter of the extensions.
QString saveViewFilter();

} // namespace faintline

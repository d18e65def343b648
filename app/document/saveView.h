#pragma once

#include <QString>

#include <string>

class QWidget;

namespace faintline {

/// Writes a view as it is seen, by the path's extension: .png, .svg or .pdf; or its numbers, .csv. Throws Error.
///
/// `provenance`, JSON of what it was made from: in the PNG's text "provenance", the SVG's description, a file attached
/// to the PDF, and beside the numbers, PATH.provenance.json.
void saveView(QWidget &view, const std::string &csv, const QString &path, const std::string &provenance = {});

/// Extensions as a file dialogue's filter.
QString saveViewFilter();

} // namespace faintline

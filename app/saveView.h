#pragma once

#include <QString>

#include <string>

class QWidget;

namespace faintline {

/// Writes a view as it is seen, by the path's extension: .png, .svg or .pdf; or its numbers, .csv. Throws Error.
void saveView(QWidget &view, const std::string &csv, const QString &path);

/// Extensions as a file dialogue's filter.
QString saveViewFilter();

} // namespace faintline

#pragma once

#include <QString>

#include <vector>

namespace faintline {

/// The equation of a view, its symbols and source.
struct Equation {
    QString view; ///< as in WindowViews::names, or "profile" and "regulation"
    QString title;
    QString equation; ///< lines of Unicode
    QString symbols;  ///< one per line
    QString source;
};

/// One for each view. For the statistic, that of the detector of that name (detectorNames); for the layer of presence,
/// "presence".
const std::vector<Equation> &equations();
const Equation *equationOf(const QString &view, const QString &detector = QStringLiteral("smd"));

} // namespace faintline

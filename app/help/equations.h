#pragma once

#include <QString>

#include <vector>

namespace faintline {

/// What a view computes: its equation, what the symbols stand for, and where it is from.
struct Equation {
    QString view; ///< as in WindowViews::names, or "profile" and "regulation"
    QString title;
    QString equation; ///< lines of Unicode
    QString symbols;  ///< one a line
    QString source;
};

/// One for each view. Of the statistic, the one of the detector of that name (detectorNames).
const std::vector<Equation> &equations();
const Equation *equationOf(const QString &view, const QString &detector = QStringLiteral("smd"));

} // namespace faintline

#pragma once

#include "analysis/AnalysisSettings.h"

#include <QString>

namespace faintline {

/// What the chosen detector's statistic is measured in: "nat", "× noise".
inline QString statisticUnit(const AnalysisSettings &settings)
{
    const std::string_view unit = detectorUnits[settings.detector.index()];
    return QString::fromUtf8(unit.data(), qsizetype(unit.size()));
}

} // namespace faintline

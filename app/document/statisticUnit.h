#pragma once

#include "plan/AnalysisSettings.h"

#include <QString>

namespace faintline {

/// Unit of the selected detector's statistic: "nat", "× noise".
inline QString statisticUnit(const AnalysisSettings &settings)
{
    const std::string_view unit = detectorUnits[settings.detector.index()];
    return QString::fromUtf8(unit.data(), qsizetype(unit.size()));
}

} // namespace faintline

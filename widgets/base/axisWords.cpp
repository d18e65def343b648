#include "widgets/base/axisWords.h"

#include "widgets/base/labelText.h"

#include <algorithm>
#include <cmath>

namespace faintline {

FrequencyUnit shownUnit(const Axis &axis)
{
    if (axis.unit == "Hz")
        return frequencyUnit(std::max(std::abs(axis.first), std::abs(axis.last())));
    return {labelText(axis.unit, mostUnitLetters), 1.0};
}

QString titleOf(const Axis &axis)
{
    const QString name = capitalised(labelText(axis.name, mostUnitLetters));
    const QString unit = shownUnit(axis).name;
    return unit.isEmpty() ? name : QStringLiteral("%1 (%2)").arg(name, unit);
}

QString valueText(const Axis &axis, double value, double resolution)
{
    const QString number = numberText(value, decimalsFor(resolution));
    return axis.unit.empty() ? number : number + QLatin1Char(' ') + labelText(axis.unit, mostUnitLetters);
}

} // namespace faintline

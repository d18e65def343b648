#include "widgets/forms/fractionText.h"

#include <QStringList>

#include <cmath>

namespace faintline {

namespace {

    constexpr int largestDenominator = 30;
    constexpr double largestNumerator = 999.0; ///< 98761/8 is no easier to read than 12345.125
    constexpr std::size_t longestDecimal = 8;  ///< characters; longer decimals are written as fractions if possible

    QString textOf(double value)
    {
        const std::string decimal = formatNumber(value);
        for (int under = 3; decimal.size() > longestDecimal && under <= largestDenominator; ++under)
            if (const double over = std::round(value * under);
                over != 0.0 && std::abs(over) <= largestNumerator && over / under == value)
                return QStringLiteral("%1/%2").arg(over).arg(under);
        return QString::fromStdString(decimal);
    }

} // namespace

QString fractionText(const FieldValue &value)
{
    if (const auto *number = std::get_if<double>(&value))
        return textOf(*number);
    const auto *numbers = std::get_if<std::vector<double>>(&value);
    if (!numbers)
        return QString::fromStdString(formatFieldValue(value));
    QStringList words;
    for (const double number : *numbers)
        words << textOf(number);
    return words.join(QStringLiteral(", "));
}

} // namespace faintline

#include "widgets/base/quantities.h"

#include "base/driftWords.h"

#include <QRegularExpression>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr QChar minusSign(0x2212);

    QString pad(int number)
    {
        return QString::number(number).rightJustified(2, QLatin1Char('0'));
    }

} // namespace

int decimalsFor(double resolution)
{
    if (!(resolution > 0.0) || !std::isfinite(resolution))
        return 0;
    return std::clamp(int(std::ceil(-std::log10(resolution) - 1e-9)), 0, 9);
}

QString numberText(double value, int decimals)
{
    if (std::isnan(value))
        return QStringLiteral("–");
    if (std::isinf(value))
        return value > 0.0 ? QStringLiteral("∞") : QString(minusSign) + QStringLiteral("∞");
    QString text = QString::number(std::abs(value), 'f', decimals);
    const bool isZero = text.toDouble() == 0.0;
    return value < 0.0 && !isZero ? minusSign + text : text;
}

QString clockText(double seconds, int decimals, bool withHours)
{
    const double scale = std::pow(10.0, decimals);
    const double units = std::round(std::abs(seconds) * scale); // so that 59.99 s becomes 1:00, not 0:60
    const auto whole = static_cast<long long>(units / scale);
    const double fraction = units / scale - double(whole);
    QString text = withHours ? QString::number(whole / 3600) + QLatin1Char(':') + pad(int(whole / 60 % 60))
                             : QString::number(whole / 60);
    text += QLatin1Char(':') + pad(int(whole % 60));
    if (decimals > 0)
        text += QString::number(fraction, 'f', decimals).mid(1);
    return seconds < 0.0 && units > 0.0 ? minusSign + text : text;
}

QString secondsText(double seconds, double resolution)
{
    const int decimals = decimalsFor(resolution);
    if (std::abs(seconds) < clockFromSeconds)
        return numberText(seconds, decimals) + QStringLiteral(" s");
    return clockText(seconds, decimals, true);
}

ColumnTimes::ColumnTimes(double longest, double resolution)
    : m_areClockTimes(longest >= clockFromSeconds), m_decimals(decimalsFor(resolution))
{
}

QString ColumnTimes::text(double seconds) const
{
    return m_areClockTimes ? clockText(seconds, m_decimals, true) : numberText(seconds, m_decimals);
}

QString ColumnTimes::heading(const QString &name) const
{
    return m_areClockTimes ? name : QStringLiteral("%1 (s)").arg(name);
}

FrequencyUnit frequencyUnit(double largestHz)
{
    if (std::abs(largestHz) >= 1e7)
        return {QStringLiteral("MHz"), 1e6};
    if (std::abs(largestHz) >= 1e4)
        return {QStringLiteral("kHz"), 1e3};
    return {QStringLiteral("Hz"), 1.0};
}

QString hertzText(double hz, double resolution)
{
    const FrequencyUnit unit = frequencyUnit(hz);
    return numberText(hz / unit.hz, decimalsFor(resolution / unit.hz)) + QLatin1Char(' ') + unit.name;
}

QString capitalised(QString words)
{
    if (!words.isEmpty())
        words[0] = words[0].toUpper();
    return words;
}

QString powerOfTenText(int exponent)
{
    static const QString superscripts = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
    QString text = QStringLiteral("10");
    if (exponent < 0)
        text += QChar(0x207b);
    for (const QChar digit : QString::number(std::abs(exponent)))
        text += superscripts[digit.digitValue()];
    return text;
}

QString powerText(double value, int digits)
{
    if (value == 0.0 || !std::isfinite(value))
        return numberText(value, 0);
    const QString scientific =
        QString::number(std::abs(value), 'e', digits - 1); // rounds, and carries into the exponent
    const int exponent = scientific.section(QLatin1Char('e'), 1).toInt();
    const bool isShort = exponent >= -3 && exponent < 5;
    QString text = isShort ? QString::number(std::abs(value), 'f', std::max(digits - 1 - exponent, 0))
                           : scientific.section(QLatin1Char('e'), 0, 0);
    static const QRegularExpression trailing(QStringLiteral("\\.?0+$"));
    if (text.contains(QLatin1Char('.')))
        text.remove(trailing);
    if (value < 0.0)
        text.prepend(minusSign);
    return isShort ? text : text + QStringLiteral("·") + powerOfTenText(exponent);
}

FrequencyUnit rateUnit(double largestHzPerSecond)
{
    const DriftUnit unit = driftUnit(largestHzPerSecond);
    return {QString::fromUtf8(unit.name), unit.hzPerSecond};
}

QString rateText(double hzPerSecond)
{
    const FrequencyUnit unit = rateUnit(std::abs(hzPerSecond));
    return powerText(hzPerSecond / unit.hz, 3) + QLatin1Char(' ') + unit.name;
}

} // namespace faintline

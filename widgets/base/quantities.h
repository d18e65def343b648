#pragma once

#include <QString>

namespace faintline {

/// Numbers for display: true minus sign, a space before the unit, and no more digits than the resolution justifies.

/// Number of decimals with which two values `resolution` apart look different; 0 … 9.
int decimalsFor(double resolution);

/// Fixed decimals, with − as minus sign, never "−0".
QString numberText(double value, int decimals);

/// Times in a recording of that length or more, s, are given as h:min:s.
inline constexpr double clockFromSeconds = 600.0;

/// "83.25 s", or for ten minutes and more "1:02:30.5" (h:min:s).
QString secondsText(double seconds, double resolution);

/// The form of a column's times, the longest of which is given: seconds, or from ten minutes on h:min:s in all rows.
class ColumnTimes
{
public:
    ColumnTimes(double longest, double resolution);
    QString text(double seconds) const;         ///< without a unit
    QString heading(const QString &name) const; ///< "Onset (s)", "Onset"

private:
    bool m_areClockTimes;
    int m_decimals;
};

/// h:min:s or min:s, without a unit: "1:02:30", "12:05".
QString clockText(double seconds, int decimals, bool withHours);

/// The unit of a frequency axis.
struct FrequencyUnit {
    QString name;
    double hz = 1.0;
};

/// Hz below 10 kHz, kHz below 10 MHz, MHz above.
FrequencyUnit frequencyUnit(double largestHz);

/// "440.0 Hz", "14.0956 kHz", "14.074 MHz".
QString hertzText(double hz, double resolution);

/// "3·10⁻⁷", or "0.25" if that is short.
QString powerText(double value, int digits = 2);

/// A drift: "−1.2 Hz/s", "0.38 mHz/s", "19 µHz/s".
QString rateText(double hzPerSecond);

/// The unit in which drifts of that size are written, such as "mHz/s", and its size in Hz/s.
FrequencyUnit rateUnit(double largestHzPerSecond);

/// "Frequency" from "frequency".
QString capitalised(QString words);

/// "10⁻⁷" from -7.
QString powerOfTenText(int exponent);

} // namespace faintline

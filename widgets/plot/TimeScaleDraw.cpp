#include "widgets/plot/TimeScaleDraw.h"

#include "widgets/base/quantities.h"
#include "widgets/base/scaleTicks.h"

#include <qwt_text.h>

#include <QObject>

#include <cmath>

namespace faintline {

void TimeScaleDraw::setTimes(const Span &whole, std::optional<double> startUnixSeconds)
{
    m_isClock = whole.high > clockFromSeconds || startUnixSeconds;
    m_startUnixSeconds = startUnixSeconds;
}

QString TimeScaleDraw::title() const
{
    return m_startUnixSeconds ? QObject::tr("Time (UTC)")
           : m_isClock        ? QObject::tr("Time (h:min:s)")
                              : QObject::tr("Time (s)");
}

QwtText TimeScaleDraw::label(double seconds) const
{
    const int decimals = decimalsFor(majorStep(scaleDiv()));
    if (m_startUnixSeconds) {
        constexpr double day = 86400.0;
        const double digits = std::pow(10.0, decimals); // rounded first: 24:00:00 becomes 0:00:00
        const double rounded = std::round((*m_startUnixSeconds + seconds) * digits) / digits;
        return clockText(rounded - day * std::floor(rounded / day), decimals, true);
    }
    return m_isClock ? clockText(seconds, decimals, true) : numberText(seconds, decimals);
}

QString TimeScaleDraw::widestLabel(const Span &full) const
{
    if (m_startUnixSeconds) {
        const int decimals = decimalsFor(majorStep(scaleDiv()));
        return clockText(20.0 * 3600.0, decimals, true).replace(QLatin1Char('2'), QLatin1Char('0'));
    }
    return label(std::max(std::abs(full.low), std::abs(full.high))).text().replace(QLatin1Char('1'), QLatin1Char('0'));
}

} // namespace faintline

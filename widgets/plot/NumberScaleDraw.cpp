#include "widgets/plot/NumberScaleDraw.h"

#include "widgets/base/quantities.h"
#include "widgets/base/scaleTicks.h"

#include <qwt_text.h>

namespace faintline {

QwtText NumberScaleDraw::label(double value) const
{
    const int decimals = decimalsFor(majorStep(scaleDiv()) / m_unit);
    QString text = numberText((value + m_origin) / m_unit, decimals);
    while (m_isLogarithmic && text.contains(QLatin1Char('.'))
           && (text.endsWith(QLatin1Char('0')) || text.endsWith(QLatin1Char('.'))))
        text.chop(1);
    return text;
}

QString NumberScaleDraw::widestLabel(const Span &full) const
{
    QString low = label(full.low).text(), high = label(full.high).text();
    return (low.size() > high.size() ? low : high).replace(QLatin1Char('1'), QLatin1Char('0'));
}

} // namespace faintline

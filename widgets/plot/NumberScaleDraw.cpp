#include "widgets/plot/NumberScaleDraw.h"

#include "widgets/base/quantities.h"
#include "widgets/base/scaleTicks.h"

#include <qwt_text.h>

namespace faintline {

QwtText NumberScaleDraw::label(double value) const
{
    return numberText(value / m_unit, decimalsFor(majorStep(scaleDiv()) / m_unit));
}

QString NumberScaleDraw::widestLabel(const Span &full) const
{
    QString low = label(full.low).text(), high = label(full.high).text();
    return (low.size() > high.size() ? low : high).replace(QLatin1Char('1'), QLatin1Char('0'));
}

} // namespace faintline

#include "widgets/plot/TimeScaleDraw.h"

#include "widgets/base/quantities.h"
#include "widgets/base/scaleTicks.h"

#include <qwt_text.h>

#include <cmath>

namespace faintline {

QwtText TimeScaleDraw::label(double seconds) const
{
    const int decimals = decimalsFor(majorStep(scaleDiv()));
    return m_isClock ? clockText(seconds, decimals, true) : numberText(seconds, decimals);
}

QString TimeScaleDraw::widestLabel(const Span &full) const
{
    return label(std::max(std::abs(full.low), std::abs(full.high))).text().replace(QLatin1Char('1'), QLatin1Char('0'));
}

} // namespace faintline

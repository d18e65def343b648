#include "widgets/plot/PowerScaleDraw.h"

#include "widgets/base/quantities.h"

#include <qwt_text.h>

#include <cmath>

namespace faintline {

QwtText PowerScaleDraw::label(double exponent) const
{
    const double nearest = std::round(exponent);
    if (std::abs(exponent - nearest) > 1e-6)
        return QString();
    return nearest >= 0.0 && nearest <= 3.0 ? QString::number(std::pow(10.0, nearest)) : powerOfTenText(int(nearest));
}

} // namespace faintline

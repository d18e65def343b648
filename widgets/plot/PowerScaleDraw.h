#pragma once

#include <qwt_scale_draw.h>

namespace faintline {

/// Powers of ten of a logarithmic ordinate that is kept as log10: -7 → 10⁻⁷.
class PowerScaleDraw : public QwtScaleDraw
{
public:
    QwtText label(double exponent) const override;
};

} // namespace faintline

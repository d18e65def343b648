#pragma once

#include "widgets/base/Span.h"

#include <qwt_scale_draw.h>

namespace faintline {

/// Labels of a quantity plus its origin, divided by `unit`, with as many decimals as the ticks need and a true minus
/// sign. On a logarithmic scale each label has as many decimals as it needs itself.
class NumberScaleDraw : public QwtScaleDraw
{
public:
    void setUnit(double unit) { m_unit = unit; }
    void setOrigin(double origin) { m_origin = origin; }
    void setLogarithmic(bool isLogarithmic) { m_isLogarithmic = isLogarithmic; }
    QwtText label(double value) const override;
    QString widestLabel(const Span &full) const;

private:
    double m_unit = 1.0;
    double m_origin = 0.0;
    bool m_isLogarithmic = false;
};

} // namespace faintline

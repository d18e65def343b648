#pragma once

#include "widgets/base/Span.h"

#include <qwt_scale_draw.h>

namespace faintline {

/// Labels in seconds, or as h:min:s where the recording is long.
class TimeScaleDraw : public QwtScaleDraw
{
public:
    void setClock(bool isClock) { m_isClock = isClock; }
    bool isClock() const { return m_isClock; }
    QwtText label(double seconds) const override;

    /// Room for the longest label of a span, so that the canvas keeps its place while one scrolls.
    QString widestLabel(const Span &full) const;

private:
    bool m_isClock = false;
};

} // namespace faintline

#pragma once

#include "widgets/base/Span.h"

#include <qwt_scale_draw.h>

#include <optional>

namespace faintline {

/// Labels in seconds, in h:min:s for long recordings, or as UTC time of day.
class TimeScaleDraw : public QwtScaleDraw
{
public:
    void setClock(bool isClock) { m_isClock = isClock; }
    bool isClock() const { return m_isClock; }
    /// Time of second 0, since 1970; if set, labels are times of day.
    void setStartUnixSeconds(std::optional<double> start) { m_startUnixSeconds = start; }
    QwtText label(double seconds) const override;

    /// The longest label of a span, for reserving room so that the canvas does not move while scrolling.
    QString widestLabel(const Span &full) const;

private:
    bool m_isClock = false;
    std::optional<double> m_startUnixSeconds;
};

} // namespace faintline

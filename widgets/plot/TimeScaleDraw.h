#pragma once

#include "widgets/base/Span.h"

#include <qwt_scale_draw.h>

#include <optional>

namespace faintline {

/// Labels in seconds, as h:min:s where the recording is long, or as the UTC time of day.
class TimeScaleDraw : public QwtScaleDraw
{
public:
    void setClock(bool isClock) { m_isClock = isClock; }
    bool isClock() const { return m_isClock; }
    /// Of second 0, from 1970 on: labels are times of day from then on.
    void setStartUnixSeconds(std::optional<double> start) { m_startUnixSeconds = start; }
    QwtText label(double seconds) const override;

    /// Room for the longest label of a span, so that the canvas keeps its place while one scrolls.
    QString widestLabel(const Span &full) const;

private:
    bool m_isClock = false;
    std::optional<double> m_startUnixSeconds;
};

} // namespace faintline

#pragma once

#include "widgets/base/Span.h"

#include <qwt_scale_draw.h>

#include <optional>

namespace faintline {

/// Labels in seconds, in h:min:s for long recordings, or as UTC time of day.
class TimeScaleDraw : public QwtScaleDraw
{
public:
    /// `whole`: all that can be seen. `startUnixSeconds`: of second 0; if given, labels are times of day.
    void setTimes(const Span &whole, std::optional<double> startUnixSeconds);
    bool isClock() const { return m_isClock; }
    QString title() const; ///< of the axis: "Time (s)", "Time (h:min:s)", "Time (UTC)"
    QwtText label(double seconds) const override;

    /// The longest label of a span, for reserving room so that the canvas does not move while scrolling.
    QString widestLabel(const Span &full) const;

private:
    bool m_isClock = false;
    std::optional<double> m_startUnixSeconds;
};

} // namespace faintline

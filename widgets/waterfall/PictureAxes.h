#pragma once

#include "base/Axis.h"
#include "widgets/base/TimeDirection.h"
#include "widgets/base/Viewport.h"

#include <qwt_axis_id.h>

#include <QString>

#include <optional>

class QwtPlot;

namespace faintline {

class NumberScaleDraw;
class TimeScaleDraw;

/// The axes of a picture over time and frequency, or over any two axes, whose own names then label them: scales, labels
/// and titles, which have the room of the plot's canvas.
class PictureAxes
{
public:
    struct Content {
        Axis time;             ///< the picture's; seconds if it has neither name nor unit
        Axis frequency;        ///< of its cells
        Viewport::Box full;    ///< all that can be seen
        double originHz = 0.0; ///< of the frequency axis's labels
        bool isLogarithmic = false;
        std::optional<double> startUnixSeconds{}; ///< UTC of second 0; none: labels are seconds
    };

    PictureAxes(QwtPlot &plot, const TimeDirection &direction) : m_plot(plot), m_direction(direction) {}

    QwtAxisId timeAxis() const { return m_direction.isVertical() ? QwtAxis::YLeft : QwtAxis::XBottom; }
    QwtAxisId hzAxis() const { return m_direction.isVertical() ? QwtAxis::XBottom : QwtAxis::YLeft; }
    bool hasTime() const; ///< as the picture's own axis

    void setContent(const Content &content);
    void fitTitles();
    /// Ticks of the part that is seen.
    void show(const Viewport::Box &visible, const Viewport::Box &full);

private:
    QwtPlot &m_plot;
    const TimeDirection &m_direction;
    Content m_content;
    QString m_timeTitle; ///< whole
    QString m_hzTitle;
    TimeScaleDraw *m_timeDraw = nullptr;     ///< owned by the plot; null if the picture's own axis is not time,
    NumberScaleDraw *m_numberDraw = nullptr; ///< which then uses this one
};

} // namespace faintline

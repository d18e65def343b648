#include "widgets/waterfall/PictureAxes.h"

#include "widgets/base/axisWords.h"
#include "widgets/base/fittingTitle.h"
#include "widgets/base/quantities.h"
#include "widgets/base/scaleTicks.h"
#include "widgets/base/steadyAxes.h"
#include "widgets/plot/NumberScaleDraw.h"
#include "widgets/plot/TimeScaleDraw.h"

#include <qwt_plot.h>
#include <qwt_scale_engine.h>
#include <qwt_text.h>

#include <QWidget>

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

bool PictureAxes::hasTime() const
{
    const Axis &axis = m_content.time;
    return axis.unit == "s" || (axis.unit.empty() && (axis.name.empty() || axis.name == "time"));
}

void PictureAxes::setContent(const Content &content)
{
    m_content = content;
    m_timeDraw = nullptr;
    m_numberDraw = nullptr;
    if (hasTime()) {
        m_timeDraw = new TimeScaleDraw;
        m_timeDraw->setTimes(content.full.time, content.startUnixSeconds);
        m_plot.setAxisScaleDraw(timeAxis(), m_timeDraw);
        m_timeTitle = m_timeDraw->title();
    } else {
        m_numberDraw = new NumberScaleDraw;
        m_plot.setAxisScaleDraw(timeAxis(), m_numberDraw);
        m_timeTitle = titleOf(content.time);
    }
    auto *hzDraw = new NumberScaleDraw;
    const Axis &frequency = content.frequency;
    const double largestHz = std::max(std::abs(frequency.first), std::abs(frequency.last()));
    const FrequencyUnit unit =
        content.originHz != 0.0 ? frequencyUnit(std::abs(content.originHz) + largestHz) : shownUnit(frequency);
    hzDraw->setUnit(unit.hz);
    hzDraw->setOrigin(content.originHz);
    hzDraw->setLogarithmic(content.isLogarithmic);
    m_plot.setAxisScaleEngine(timeAxis(), new QwtLinearScaleEngine);
    m_plot.setAxisScaleEngine(hzAxis(), content.isLogarithmic ? static_cast<QwtScaleEngine *>(new QwtLogScaleEngine)
                                                              : new QwtLinearScaleEngine);
    m_plot.setAxisScaleDraw(hzAxis(), hzDraw);
    m_hzTitle = content.originHz != 0.0 ? QObject::tr("Radio frequency (%1)").arg(unit.name) : titleOf(frequency);
    m_plot.setAxisTitle(timeAxis(), m_timeTitle);
    m_plot.setAxisTitle(hzAxis(), m_hzTitle);
}

void PictureAxes::fitTitles()
{
    const QSize room = m_plot.canvas()->size();
    for (const auto &[axis, whole] : {std::pair(timeAxis(), m_timeTitle), std::pair(hzAxis(), m_hzTitle)}) {
        QwtText own = m_plot.axisTitle(axis);
        own.setText(fittingTitle(whole, own.font(), axis == QwtAxis::XBottom ? room.width() : room.height()));
        if (own != m_plot.axisTitle(axis))
            m_plot.setAxisTitle(axis, own);
    }
}

void PictureAxes::show(const Viewport::Box &visible, const Viewport::Box &full)
{
    const bool isTimeVertical = m_direction.isVertical();
    const QSize size = m_plot.canvas()->contentsRect().size();
    const int along = isTimeVertical ? size.height() : size.width();
    const int across = isTimeVertical ? size.width() : size.height();
    const int timeSpacing = isTimeVertical ? 42 : m_timeDraw && m_timeDraw->isClock() ? 90 : 60;
    const int timeTicks = std::clamp(along / timeSpacing, 1, 12);
    const QwtScaleDiv timeDiv = m_timeDraw
                                    ? timeScaleDiv(visible.time, timeTicks, m_content.startUnixSeconds.value_or(0.0))
                                    : linearScaleDiv(visible.time, timeTicks);
    const bool isInverted = m_direction.orientation() == TimeDirection::Orientation::OldestOnTop;
    m_plot.setAxisScaleDiv(timeAxis(), isInverted ? timeDiv.inverted() : timeDiv);
    const int hzSpacing = !isTimeVertical ? 42 : m_content.originHz != 0.0 ? 110 : 60;
    const int hzTicks = std::clamp(across / hzSpacing, 1, 12);
    m_plot.setAxisScaleDiv(hzAxis(), m_content.isLogarithmic
                                         ? logarithmicScaleDiv(visible.frequency, hzTicks)
                                         : linearScaleDiv(visible.frequency, hzTicks, m_content.originHz));

    const auto *hzDraw = static_cast<const NumberScaleDraw *>(m_plot.axisScaleDraw(hzAxis()));
    const QString timeLabel = m_timeDraw ? m_timeDraw->widestLabel(full.time) : m_numberDraw->widestLabel(full.time);
    const QString hzLabel = hzDraw->widestLabel(full.frequency);
    steadyAxes(m_plot, isTimeVertical ? timeLabel : hzLabel, isTimeVertical ? hzLabel : timeLabel);
}

} // namespace faintline

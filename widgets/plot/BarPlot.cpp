#include "widgets/plot/BarPlot.h"

#include "widgets/base/Theme.h"
#include "widgets/plot/CurveKey.h"

#include <qwt_plot_item.h>
#include <qwt_scale_map.h>

#include <QPainter>

#include <algorithm>
#include <cmath>

namespace faintline {

/// Paints the bars.
class BarPlot::BarItem : public QwtPlotItem
{
public:
    explicit BarItem(const BarPlot &owner) : m_owner(owner) { setZ(20.0); }

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap, const QRectF &) const override
    {
        const Theme::Colours &colours = Theme::colours(m_owner);
        const double share = m_owner.m_isWide ? 1.0 : 1.0 / double(m_owner.series().size());
        constexpr double width = 0.8; // relative to the place
        for (std::size_t s = 0; s < m_owner.series().size(); ++s) {
            const Series &series = m_owner.series()[s];
            for (std::size_t i = 0; i < series.values.size(); ++i) {
                if (!(series.values[i] > 0.0))
                    continue;
                const int place = m_owner.m_first + int(i);
                const double left = place - 0.5 * width + (m_owner.m_isWide ? 0.0 : width * share * double(s));
                QColor colour = colours.curves[series.colour];
                if (m_owner.m_selected >= m_owner.m_first && place != m_owner.m_selected)
                    colour.setAlpha(170);
                const QPointF low(xMap.transform(left), yMap.transform(0.0));
                const QPointF high(xMap.transform(left + width * share), yMap.transform(series.values[i]));
                painter->fillRect(QRectF(low, high).normalized(), colour);
            }
        }
    }

private:
    const BarPlot &m_owner;
};

BarPlot::BarPlot(QWidget *parent)
    : MarkedPlot(parent), m_item(new BarItem(*this)), m_key(new CurveKey(Qt::AlignTop | Qt::AlignRight))
{
    m_item->attach(this);
    m_key->attach(this);
    BarPlot::restyle();
}

void BarPlot::setBars(std::vector<Series> series, int first, bool isWide)
{
    m_series = std::move(series);
    m_first = first;
    m_isWide = isWide;
    BarPlot::restyle();
    layOut();
}

void BarPlot::setLeastHeight(double height)
{
    m_leastHeight = height;
    layOut();
}

void BarPlot::setSelected(int place)
{
    m_selected = place;
    replot();
}

void BarPlot::layOut()
{
    m_places = 0;
    double highest = m_leastHeight;
    for (const Series &series : m_series) {
        m_places = std::max(m_places, int(series.values.size()));
        for (const double value : series.values)
            highest = std::max(highest, value);
    }
    setSpans({m_first - 0.6, m_first + m_places - 0.4}, {0.0, highest > 0.0 ? 1.25 * highest : 1.0});
    setEmpty(m_places == 0);
    m_key->setVisible(m_places > 0);
}

void BarPlot::restyle()
{
    MarkedPlot::restyle();
    const Theme::Colours &colours = Theme::colours(*this);
    m_key->follow(colours);
    m_key->entries.clear();
    for (const Series &series : m_series)
        m_key->entries.push_back({series.name, QPen(colours.curves[series.colour], 1.0), true});
    setMarksTop(m_key->height());
    replot();
}

void BarPlot::clicked(const QPointF &canvas)
{
    MarkedPlot::clicked(canvas);
    const int place = int(std::lround(invTransform(QwtAxis::XBottom, canvas.x())));
    if (place >= m_first && place < m_first + m_places)
        emit barActivated(place);
}

} // namespace faintline

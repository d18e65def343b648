#include "widgets/waterfall/SliceMarks.h"

#include "widgets/waterfall/WaterfallView.h"

#include <qwt_plot_curve.h>
#include <qwt_symbol.h>

namespace faintline {

namespace {

    constexpr double seam = 4.0; // pixels
    constexpr double markWidth = 1.8;

    std::vector<QwtPlotCurve *> makeMarks(WaterfallView &view, QwtSymbol::Style style, int size)
    {
        std::vector<QwtPlotCurve *> marks;
        for (const auto &[colour, width] :
             {std::pair(QColor(0, 0, 0, 170), seam), std::pair(QColor(255, 255, 255), markWidth)}) {
            auto *curve = new QwtPlotCurve;
            curve->setStyle(QwtPlotCurve::NoCurve);
            curve->setSymbol(new QwtSymbol(style, Qt::NoBrush, QPen(colour, width), {size, size}));
            curve->setRenderHint(QwtPlotItem::RenderAntialiased);
            curve->setZ(60.0);
            curve->attach(&view);
            marks.push_back(curve);
        }
        return marks;
    }

} // namespace

SliceMarks::SliceMarks(WaterfallView &view)
    : QObject(&view), m_view(view), m_rings(makeMarks(view, QwtSymbol::Ellipse, 15)),
      m_diamonds(makeMarks(view, QwtSymbol::Diamond, 9))
{
    connect(&view.direction(), &TimeDirection::changed, this, &SliceMarks::place);
}

void SliceMarks::set(const std::optional<Best> &best, std::vector<Viewport::Point> paths)
{
    m_best = best;
    m_paths = std::move(paths);
    place();
}

void SliceMarks::place()
{
    const bool isUpright = m_view.isTimeVertical();
    const auto at = [&](double row, double column) { return isUpright ? QPointF(column, row) : QPointF(row, column); };
    QVector<QPointF> ring;
    if (m_best)
        ring << at(m_best->row, m_best->column);
    QVector<QPointF> diamonds;
    for (const Viewport::Point &path : m_paths)
        diamonds << at(path.seconds, path.hz);
    for (QwtPlotCurve *curve : m_rings)
        curve->setSamples(ring);
    for (QwtPlotCurve *curve : m_diamonds)
        curve->setSamples(diamonds);
    m_view.replot();
}

} // namespace faintline

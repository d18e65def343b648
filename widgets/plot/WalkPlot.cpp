#include "widgets/plot/WalkPlot.h"

#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"
#include "widgets/plot/CurveKey.h"

#include <qwt_plot_item.h>
#include <qwt_scale_map.h>

#include <QKeyEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double reach = 24.0;           ///< px from the mouse to a walk
    constexpr std::size_t mostPoints = 4000; ///< maximum number of points drawn per walk

    bool isWrong(const WalkPlot::Walk &walk)
    {
        return walk.hasTarget && walk.decision != SprtDecision::Undecided
               && (walk.decision == SprtDecision::H1) != *walk.hasTarget;
    }

    QColor colourOf(const WalkPlot::Walk &walk, const Theme::Colours &colours)
    {
        return walk.hasTarget ? colours.curves[*walk.hasTarget ? 1 : 0] : colours.curves[2];
    }

    /// H1 points up, H0 down; a square marks the cut-off.
    void drawDecision(QPainter &painter, const QPointF &at, const WalkPlot::Walk &walk, const QColor &colour,
                      double radius)
    {
        if (walk.decision == SprtDecision::Undecided)
            return;
        painter.setPen(Qt::NoPen);
        painter.setBrush(colour);
        const double up = walk.decision == SprtDecision::H1 ? -radius : radius;
        if (walk.isForced)
            painter.drawRect(QRectF(at.x() - 0.8 * radius, at.y() - 0.8 * radius, 1.6 * radius, 1.6 * radius));
        else
            painter.drawPolygon(
                QPolygonF{{at.x(), at.y() + up}, {at.x() - radius, at.y() - up}, {at.x() + radius, at.y() - up}});
    }

} // namespace

/// Paints the walks.
class WalkPlot::WalkItem : public QwtPlotItem
{
public:
    explicit WalkItem(const WalkPlot &owner) : m_owner(owner) { setZ(20.0); }

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap, const QRectF &canvas) const override
    {
        painter->save();
        painter->setRenderHint(QPainter::Antialiasing);
        for (std::size_t i = 0; i < m_owner.walks().size(); ++i)
            if (int(i) != m_owner.selected())
                drawWalk(*painter, m_owner.walks()[i], xMap, yMap, canvas, false);
        if (m_owner.selected() >= 0)
            drawWalk(*painter, m_owner.walks()[std::size_t(m_owner.selected())], xMap, yMap, canvas, true);
        painter->restore();
    }

private:
    void drawWalk(QPainter &painter, const Walk &walk, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                  const QRectF &canvas, bool isSelected) const
    {
        const Theme::Colours &colours = Theme::colours(m_owner);
        QColor line = colourOf(walk, colours);
        const std::size_t every = walk.lnLambda.size() / mostPoints + 1;
        QPolygonF points{QPointF(xMap.transform(0.0), yMap.transform(0.0))};
        for (std::size_t i = 0; i < walk.lnLambda.size(); ++i)
            if (i % every == 0 || i + 1 == walk.lnLambda.size()) {
                const double y = yMap.transform(walk.lnLambda[i]);
                points << QPointF(xMap.transform(double(i + 1)),
                                  std::clamp(y, canvas.top() - 1e4, canvas.bottom() + 1e4));
            }
        if (!isSelected && m_owner.walks().size() > 1)
            line.setAlpha(m_owner.walks().size() > 40 ? 62 : 110);
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(line, isSelected ? 2.6 : 1.0));
        painter.drawPolyline(points);
        if (isSelected && walk.lnLambda.size() <= 60) {
            painter.setPen(QPen(colours.canvas, 1.0));
            painter.setBrush(line);
            for (const QPointF &point : points)
                painter.drawEllipse(point, 3.4, 3.4);
        }
        // A walk may jump far beyond its boundary: its end is then marked at the edge.
        QPointF end = points.last();
        end.setY(std::clamp(end.y(), canvas.top() + 5.0, canvas.bottom() - 5.0));
        const double radius = isSelected ? 6.0 : 3.5;
        line.setAlpha(isSelected ? 255 : 190);
        drawDecision(painter, end, walk, line, radius);
        if (isWrong(walk)) {
            painter.setPen(QPen(colours.error, 1.6));
            painter.setBrush(Qt::NoBrush);
            painter.drawEllipse(end, radius + 3.0, radius + 3.0);
        }
    }

    const WalkPlot &m_owner;
};

WalkPlot::WalkPlot(QWidget *parent)
    : MarkedPlot(parent), m_item(new WalkItem(*this)), m_key(new CurveKey(Qt::AlignTop | Qt::AlignRight))
{
    m_item->attach(this);
    m_key->attach(this);
    setTitles(tr("stage"), tr("ln Λ (nat)"));
    setAccessibleName(tr("Log-likelihood ratio of the sequential tests"));
    WalkPlot::restyle();
}

void WalkPlot::setTest(const SprtSettings &settings, std::optional<Index> fixedSize)
{
    m_settings = settings;
    m_fixedSize = fixedSize;
    layOut();
}

void WalkPlot::setWalks(std::vector<Walk> walks)
{
    m_walks = std::move(walks);
    if (m_selected >= int(m_walks.size()))
        m_selected = -1;
    WalkPlot::restyle();
    layOut();
}

void WalkPlot::setSelected(int walk)
{
    m_selected = walk < int(m_walks.size()) ? walk : -1;
    replot();
}

void WalkPlot::layOut()
{
    const SprtBoundaries at = sprtBoundaries(m_settings);
    const double height = at.lnUpper - at.lnLower;
    constexpr int leastStages = 4;
    constexpr int mostStages = 1000; // a later cut-off would compress the walks too much
    auto longest =
        std::size_t(std::max(leastStages, m_settings.cutOffStage <= mostStages ? m_settings.cutOffStage : 0));
    for (const Walk &walk : m_walks)
        longest = std::max(longest, walk.lnLambda.size());
    if (m_fixedSize)
        longest = std::max(longest, std::size_t(*m_fixedSize));
    setSpans({0.0, 1.03 * double(longest)}, {at.lnLower - 0.22 * height, at.lnUpper + 0.36 * height});

    std::vector<Mark> marks{{at.lnUpper, false, tr("ln γ₁ = %1: a target").arg(numberText(at.lnUpper, 2)), false},
                            {at.lnLower, false, tr("ln γ₀ = %1: noise only").arg(numberText(at.lnLower, 2)), false}};
    if (m_fixedSize)
        marks.push_back({double(*m_fixedSize), true, tr("fixed size: about %1").arg(*m_fixedSize)});
    if (m_settings.cutOffStage > 0 && std::size_t(m_settings.cutOffStage) <= longest)
        marks.push_back({double(m_settings.cutOffStage), true, tr("cut-off: %1").arg(m_settings.cutOffStage)});
    setMarks(std::move(marks));
    setEmpty(m_walks.empty());
    m_key->setVisible(!m_walks.empty());
}

void WalkPlot::restyle()
{
    MarkedPlot::restyle();
    const Theme::Colours &colours = Theme::colours(*this);
    m_key->follow(colours);
    m_key->entries.clear();
    const auto has = [this](std::optional<bool> kind) {
        return std::any_of(m_walks.begin(), m_walks.end(), [&](const Walk &walk) { return walk.hasTarget == kind; });
    };
    if (has(false))
        m_key->entries.push_back({tr("H0, noise only"), QPen(colours.curves[0], 1.6), false});
    if (has(true))
        m_key->entries.push_back({tr("H1, a target"), QPen(colours.curves[1], 1.6), false});
    setMarksTop(m_key->height());
    replot();
}

QPointF WalkPlot::position(int walk, Index stage) const
{
    const double value = stage == 0 ? 0.0 : m_walks[std::size_t(walk)].lnLambda[std::size_t(stage - 1)];
    QPointF at = canvasPosition(double(stage), value);
    at.setY(std::clamp(at.y(), 0.0, double(canvas()->height())));
    return at;
}

void WalkPlot::clicked(const QPointF &canvas)
{
    int best = -1;
    double shortest = reach;
    for (int walk = 0; walk < int(m_walks.size()); ++walk) {
        const auto stages = Index(m_walks[std::size_t(walk)].lnLambda.size());
        // Only stages next to the pointer can be near it.
        const auto middle = Index(std::lround(invTransform(QwtAxis::XBottom, canvas.x())));
        for (Index stage = std::max<Index>(1, middle - 2); stage <= std::min(stages, middle + 2); ++stage) {
            const QPointF gap = position(walk, stage) - canvas;
            if (const double distance = std::hypot(gap.x(), gap.y()); distance < shortest) {
                shortest = distance;
                best = walk;
            }
        }
    }
    if (best >= 0)
        emit walkActivated(best);
    MarkedPlot::clicked(canvas);
}

void WalkPlot::keyPressEvent(QKeyEvent *event)
{
    const int count = int(m_walks.size());
    if (count > 0 && (event->key() == Qt::Key_Up || event->key() == Qt::Key_Down))
        return emit walkActivated(std::clamp(m_selected + (event->key() == Qt::Key_Down ? 1 : -1), 0, count - 1));
    MarkedPlot::keyPressEvent(event);
}

} // namespace faintline

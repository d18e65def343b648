#pragma once

#include "base/Axis.h"
#include "widgets/plot/MarkedPlot.h"

#include <QColor>
#include <QPointF>

#include <vector>

namespace faintline {

class CurveKey;

/// A small picture of values on two axes with a colour bar, and paths and rings over it, such as a posterior law by
/// stage, or a scan.
///
/// A pixel shows the largest of its cells, so that a single bright one remains visible.
class CellPicture : public MarkedPlot
{
    Q_OBJECT

public:
    struct Path {
        enum class Kind { Line, Dashes, Rings, Crosses };
        QString name;
        Kind kind = Kind::Line;
        QColor colour;
        std::vector<QPointF> points; ///< in the axes' values
    };

    explicit CellPicture(QWidget *parent = nullptr);

    /// x.count × y.count values, with y varying fastest; `range`: values at the ends of the colour scale; `title`: of
    /// the colour bar, with unit.
    void setPicture(const Axis &x, const Axis &y, std::vector<float> values, const Span &range, const QString &title);
    void setPaths(std::vector<Path> paths);
    void clear();

    const Axis &yAxis() const { return m_yAxis; }
    const std::vector<float> &values() const { return m_values; }

protected:
    void restyle() override;

private:
    class PictureItem;

    Axis m_xAxis;
    Axis m_yAxis;
    std::vector<float> m_values;
    Span m_range{0.0, 1.0};
    QString m_title;
    std::vector<Path> m_paths;
    PictureItem *m_item;
    CurveKey *m_key;
};

} // namespace faintline

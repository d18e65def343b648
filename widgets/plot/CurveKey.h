#pragma once

#include "widgets/base/Theme.h"

#include <qwt_plot_item.h>

#include <QPen>
#include <QString>

#include <vector>

namespace faintline {

/// The key to a plot's curves in a corner of the canvas: a sample of each line and its name.
class CurveKey : public QwtPlotItem
{
public:
    struct Entry {
        QString name;
        QPen pen;
        bool isArea = false;
    };

    explicit CurveKey(Qt::Alignment corner);

    std::vector<Entry> entries;
    QColor textColour;
    QColor plate; ///< behind the key

    void follow(const Theme::Colours &colours, int opacity = 215);
    double height() const; ///< with what is around it, px

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;

private:
    Qt::Alignment m_corner;
};

} // namespace faintline

#include "app/window/scaleText.h"

#include <QApplication>
#include <QFont>
#include <QVariant>
#include <QWidget>

#include <cmath>

namespace faintline {

namespace {

    constexpr const char *usualSize = "usualTextSize";

    bool isInPlot(const QWidget &widget)
    {
        for (const QWidget *each = &widget; each; each = each->parentWidget())
            if (each->inherits("QwtPlot") || each->inherits("faintline::ChartPlot"))
                return true;
        return false;
    }

    void scaleOwnFont(QWidget &widget, double scale)
    {
        if (!widget.property(usualSize).isValid())
            widget.setProperty(usualSize, widget.font().pixelSize());
        QFont font = widget.font();
        font.setPixelSize(int(std::lround(widget.property(usualSize).toInt() * scale)));
        widget.setFont(font);
    }

} // namespace

void scaleText(QWidget &panel, double scale)
{
    QFont inherited = QApplication::font();
    inherited.setPixelSize(int(std::lround(inherited.pixelSize() * scale)));
    panel.setFont(scale == 1.0 ? QFont() : inherited);
    for (QWidget *widget : panel.findChildren<QWidget *>())
        if (widget->testAttribute(Qt::WA_SetFont) && !isInPlot(*widget))
            scaleOwnFont(*widget, scale);
}

} // namespace faintline

#pragma once

#include "widgets/plot/MarkedPlot.h"

#include <QString>

#include <limits>
#include <vector>

namespace faintline {

class CurveKey;

/// Bars of one or more series over integers: side by side, or one series per place.
class BarPlot : public MarkedPlot
{
    Q_OBJECT

public:
    struct Series {
        QString name;
        int colour = 0;             ///< of the theme's curves
        std::vector<double> values; ///< at `first`, first + 1, …
        bool operator==(const Series &) const = default;
    };

    explicit BarPlot(QWidget *parent = nullptr);

    /// `isWide`: each place has a bar of one series only, which gets the full width.
    void setBars(std::vector<Series> series, int first, bool isWide = false);
    const std::vector<Series> &series() const { return m_series; }
    /// Minimum height of the ordinate, to keep a level line on the canvas.
    void setLeastHeight(double height);
    /// The highlighted place; less than `first`: none.
    void setSelected(int place);

signals:
    void barActivated(int place);

protected:
    void restyle() override;
    void clicked(const QPointF &canvas) override;

private:
    class BarItem;
    void layOut();

    std::vector<Series> m_series;
    int m_first = 0;
    int m_places = 0; ///< of the longest series
    bool m_isWide = false;
    double m_leastHeight = 0.0;
    int m_selected = std::numeric_limits<int>::min();
    BarItem *m_item;
    CurveKey *m_key;
};

} // namespace faintline

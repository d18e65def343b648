#pragma once

#include "evaluate/experiments/Chart.h"
#include "widgets/base/Span.h"
#include "widgets/plot/ChartMarks.h"

#include <QSet>
#include <QWidget>

#include <optional>
#include <vector>

class QBoxLayout;
class QLabel;
class QwtPlot;
class QwtPlotGrid;
class QwtPlotItem;
class QwtPlotMarker;

namespace faintline {

class CanvasSentence;
class ChartItems;
class ChartKey;

/// An interactive view of a core `Chart`, drawn with `ChartItems`. The key beside it has boxes that show and hide
/// curves; the line below describes the value under the mouse.
///
/// A click on a measured point, or arrow keys and Enter, emit `pointActivated`.
class ChartPlot : public QWidget
{
    Q_OBJECT

public:
    explicit ChartPlot(QWidget *parent = nullptr);
    ~ChartPlot() override;

    /// Replaces the chart; curves that were hidden by name stay hidden.
    void setChart(const Chart &chart);
    const Chart &chart() const { return m_chart; }

    /// Shown while there are no curves: how to get some.
    void setEmptySentence(const QString &sentence);
    /// Describes the effect of a click on a point, after its value: "click to open one of its trials". Empty: points
    /// cannot be clicked.
    void setInvitation(const QString &invitation);

    /// Print mode: no boxes and no read-out.
    void setPrinted(bool isPrinted);

    /// Named positions on the x axis, in ascending order. They do not affect the axes.
    void setMarks(std::vector<ChartMark> marks);
    const std::vector<ChartMark> &marks() const { return m_marks->marks; }

    /// Includes this span in the y axis, so that charts side by side can have the same one.
    void setLeastOrdinates(std::optional<Span> span);

    bool isShown(std::size_t curve) const;
    void setShown(std::size_t curve, bool isShown);

    /// Canvas position of a point.
    QPointF canvasPosition(std::size_t curve, std::size_t point) const;
    QwtPlot *plot() const { return m_plot; }
    QString readOut() const;

    QSize sizeHint() const override { return {520, 260}; }
    QSize minimumSizeHint() const override { return {260, 130}; }

signals:
    void pointActivated(std::size_t curve, std::size_t point);

protected:
    void keyPressEvent(QKeyEvent *event) override;
    void changeEvent(QEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;
    void focusInEvent(QFocusEvent *event) override;
    void focusOutEvent(QFocusEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    struct Place {
        std::size_t curve = 0;
        std::size_t point = 0;
        bool operator==(const Place &) const = default;
    };

    void restyle();
    void rebuild();
    void addCurve(std::size_t index);
    void rebuildKey();
    void layAxes();
    void showPlace(const std::optional<Place> &place);
    void move(int points, int curves);
    QPointF onCanvas(const QPointF &coordinates) const;
    std::optional<Place> nearest(const QPointF &canvas) const;
    ChartItems items() const;

    Chart m_chart;
    std::optional<Span> m_leastOrdinates;
    QSet<QString> m_hidden; ///< by name
    std::optional<Place> m_place;
    int m_resizing = 0; ///< nesting depth of canvas resizing caused by its own layout
    QString m_invitation;
    bool m_isPrinted = false;

    QwtPlot *m_plot;
    QwtPlotGrid *m_grid;
    QwtPlotMarker *m_ring; ///< around the point in the read-out
    ChartMarks *m_marks;
    CanvasSentence *m_sentence;
    QBoxLayout *m_row; ///< plot and key
    ChartKey *m_key;
    QLabel *m_readOut;
    std::vector<QwtPlotItem *> m_curves;               ///< attached to the plot, like the details
    std::vector<std::vector<QwtPlotItem *>> m_details; ///< intervals and labels of each curve
};

} // namespace faintline

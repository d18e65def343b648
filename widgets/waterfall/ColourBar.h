#pragma once

#include "frames/PeakPyramid.h"
#include "widgets/base/ColourScale.h"
#include "widgets/base/Span.h"
#include "widgets/plot/ColourMap.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QPointer>
#include <QWidget>

#include <optional>
#include <vector>

namespace faintline {

/// The legend of a waterfall: colours with their numbers and unit, a histogram of the values, and two draggable ends.
///
/// Keys: Up and Down move the white end, with Shift the black one. Double-click: automatic range.
class ColourBar : public QWidget
{
    Q_OBJECT

public:
    explicit ColourBar(QWidget *parent = nullptr);

    /// Shows and controls that view's range; replaces the setters and signals below.
    void attach(WaterfallView *view);
    /// The view with an attached bar on its right.
    static QWidget *pane(WaterfallView *view);

    void setColourMap(const ColourMap &map);
    void setRange(double low, double high);
    void setUnit(const QString &unit);
    /// Counts per byte of the scale.
    void setHistogram(const ByteScale &scale, const std::vector<double> &counts);
    /// A marked value, such as the threshold.
    void setMarker(std::optional<double> value);

    const Span &range() const { return m_range; }
    Span places() const { return colours().places(m_range); } ///< of the range on the scale of colours

    QSize sizeHint() const override { return {usualWidth(), 240}; }
    QSize minimumSizeHint() const override { return {usualWidth(), 120}; }

signals:
    void rangeRequested(double low, double high);
    void automaticRequested();

protected:
    void paintEvent(QPaintEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void mouseReleaseEvent(QMouseEvent *event) override;
    void mouseDoubleClickEvent(QMouseEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void changeEvent(QEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    enum class Grip { None, Low, High, Both };

    static int usualWidth();
    QRectF barRect() const;
    double yOf(double value) const;
    ColourScale colours() const;
    double placeAt(double y) const; ///< on the scale of colours
    std::pair<QList<double>, int> ticks() const;
    void chooseScale();
    Grip gripAt(double y) const;
    void request(const Span &range);
    void paintBar(QPainter &painter) const;
    void paintHistogram(QPainter &painter) const;
    void paintTicks(QPainter &painter) const;
    void paintGrips(QPainter &painter) const;
    void paintMarker(QPainter &painter) const;

    const ColourMap *m_map;
    Span m_range{0.0, 1.0};
    Span m_scale{0.0, 1.0}; ///< places at the widget's lower and upper ends
    QString m_unit;
    ByteScale m_byteScale;
    std::vector<double> m_counts;
    std::optional<double> m_marker;
    QPointer<WaterfallView> m_view; ///< the bar is aligned with its canvas
    Grip m_grip = Grip::None;
    double m_gripPlace = 0.0;
    Span m_gripRange; ///< places
};

} // namespace faintline

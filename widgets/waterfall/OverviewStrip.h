#pragma once

#include "analyse/events.h"
#include "base/Axis.h"
#include "frames/PeakPyramid.h"
#include "plan/Analysis.h"
#include "widgets/base/Viewport.h"
#include "widgets/plot/ColourMap.h"

#include <QImage>
#include <QPointer>
#include <QWidget>

#include <memory>
#include <vector>

namespace faintline {

/// The whole recording in one thin picture, time from left to right, with the visible part as a box.
///
/// Has its own black and white levels, because a pixel is the maximum of many more cells than in the waterfall. Drag
/// the box to scroll, its sides to zoom; click elsewhere to go there; wheel zooms in time; double-click shows all.
/// Arrow keys scroll by a tenth of the visible part, + and - zoom.
class OverviewStrip : public QWidget
{
    Q_OBJECT

public:
    explicit OverviewStrip(QWidget *parent = nullptr);

    void setViewport(Viewport *viewport);
    void setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency);
    void setColourMap(const ColourMap &map);
    /// Events are marked along the lower edge.
    void setEvents(const std::vector<Event> &events);

    QSize sizeHint() const override { return {800, 56}; }
    QSize minimumSizeHint() const override { return {200, 44}; }

protected:
    void paintEvent(QPaintEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void mouseReleaseEvent(QMouseEvent *event) override;
    void mouseDoubleClickEvent(QMouseEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void changeEvent(QEvent *event) override;

private:
    enum class Grip { None, Box, Low, High };

    QRectF pictureRect() const;
    double xOf(double seconds) const;
    double secondsAt(double x) const;
    QRectF boxRect() const;
    Grip gripAt(const QPointF &position) const;
    void renew();
    void render();
    void paintTicks(QPainter &painter) const;
    void paintBox(QPainter &painter) const;
    void paintEvents(QPainter &painter) const;

    QPointer<Viewport> m_viewport;
    std::shared_ptr<const PeakPyramid> m_picture;
    Axis m_frequency;
    const ColourMap *m_map;
    std::vector<Event> m_events;
    QImage m_image;
    bool m_isStale = false;
    Grip m_grip = Grip::None;
    double m_gripSeconds = 0.0;
    Span m_gripSpan;
};

} // namespace faintline

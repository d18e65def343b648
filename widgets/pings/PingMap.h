#pragma once

#include "widgets/pings/PingMarks.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QWidget>

class QStackedWidget;

namespace faintline {

class ColourBar;
class PingOverlayItem;
class PolarView;

/// One ping, range × bearing: as a plane (B-scan) or from above, with colour bar and marks.
class PingMap : public QWidget
{
    Q_OBJECT

public:
    using Axis = faintline::Axis;

    /// `viewport`: range in place of time, bearing in place of frequency. `display`, `direction`: as of a WaterfallView.
    PingMap(const QString &heading, Viewport &viewport, PictureDisplay *display = nullptr,
            TimeDirection *direction = nullptr);

    WaterfallView *plane() const { return m_plane; }
    PolarView *polar() const { return m_polar; }
    bool isPolar() const;

    /// Sets the next ping; null shows the empty sentence.
    void setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &bearing);
    void setMarks(const PingMarks &marks);
    void setSelectedTrack(int id);
    void setFaintTracks(const std::vector<int> &ids); ///< rejected ones

    /// The track whose mark or tail lies under a place, within pointing accuracy; 0 if there is none.
    int trackAt(const PingMarks::Place &place) const;

    /// Whether the colour bar is shown.
    void setColourBarShown(bool isShown);

signals:
    void hovered(double range, double bearing);
    void hoverEnded();

protected:
    void changeEvent(QEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;

private:
    void follow();
    void followProjection();
    PingOverlayItem *overlays(int i) const;

    Viewport &m_viewport;
    QStackedWidget *m_pages;
    ColourBar *m_bar;
    WaterfallView *m_plane;
    PolarView *m_polar;
    PingOverlayItem *m_overlay; ///< of the plane
};

} // namespace faintline

#include "widgets/pings/PingMap.h"

#include "widgets/pings/PingOverlayItem.h"
#include "widgets/pings/PolarView.h"
#include "widgets/waterfall/ColourBar.h"

#include <qwt_scale_map.h>

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineF>
#include <QStackedWidget>

namespace faintline {

PingMap::PingMap(const QString &heading, Viewport &viewport, PictureDisplay *display, TimeDirection *direction)
    : m_viewport(viewport), m_pages(new QStackedWidget), m_bar(new ColourBar),
      m_plane(new WaterfallView(heading, display, direction)),
      m_overlay(new PingOverlayItem([this](const PingMarks::Place &place, const QwtScaleMap &x, const QwtScaleMap &y) {
          return m_plane->isTimeVertical() ? QPointF(x.transform(place.across), y.transform(place.along))
                                           : QPointF(x.transform(place.along), y.transform(place.across));
      }))
{
    m_plane->setViewport(&viewport);
    m_overlay->attach(m_plane);
    m_polar = new PolarView(*m_plane);
    m_pages->addWidget(m_plane);
    m_pages->addWidget(m_polar);
    m_bar->attach(m_plane);
    QSizePolicy policy = m_bar->sizePolicy();
    policy.setRetainSizeWhenHidden(true); // maps side by side keep the same size
    m_bar->setSizePolicy(policy);
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_pages, 1);
    layout->addWidget(m_bar);
    connect(&m_plane->display(), &PictureDisplay::layersChanged, this, &PingMap::follow);
    connect(&viewport, &Viewport::cursorChanged, this, &PingMap::follow);
    connect(m_plane, &WaterfallView::hovered, this,
            [this](double range, double bearing) { emit hovered(range, bearing); });
    connect(m_polar, &PolarView::hovered, this, &PingMap::hovered);
    connect(m_plane, &WaterfallView::hoverEnded, this, &PingMap::hoverEnded);
    connect(m_polar, &PolarView::hoverEnded, this, &PingMap::hoverEnded);
    connect(&m_plane->display(), &PictureDisplay::projectionChanged, this, &PingMap::followProjection);
    followProjection();
    follow();
}

PingOverlayItem *PingMap::overlays(int i) const
{
    return i == 0 ? m_overlay : &m_polar->overlay();
}

bool PingMap::isPolar() const
{
    return m_pages->currentWidget() == m_polar;
}

void PingMap::setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &bearing)
{
    m_overlay->turn = bearing.cyclic ? bearing.step * double(bearing.count) : 0.0;
    m_overlay->setVisible(picture != nullptr);
    if (picture && m_plane->picture() && m_plane->frequencyAxis() == bearing)
        m_plane->setNextPicture(std::move(picture));
    else
        m_plane->setPicture(std::move(picture), bearing);
    m_polar->followPicture();
}

void PingMap::setMarks(const PingMarks &marks)
{
    for (int i = 0; i < 2; ++i)
        overlays(i)->marks = marks;
    follow();
}

void PingMap::setSelectedTrack(int id)
{
    if (id == m_overlay->selectedTrack)
        return;
    for (int i = 0; i < 2; ++i)
        overlays(i)->selectedTrack = id;
    follow();
}

void PingMap::setFaintTracks(const std::vector<int> &ids)
{
    for (int i = 0; i < 2; ++i)
        overlays(i)->faintTracks = ids;
    follow();
}

int PingMap::trackAt(const PingMarks::Place &place) const
{
    constexpr double reach = 14.0; // pixels
    const auto on = [this](const PingMarks::Place &where) {
        return isPolar() ? m_polar->positionOf(where) : m_plane->positionOf({where.along, where.across});
    };
    int nearest = 0;
    double least = reach;
    for (const PingMarks::Trail &trail : m_overlay->marks.tracks)
        for (const PingMarks::Place &where : trail.places)
            if (const double distance = QLineF(on(where), on(place)).length(); distance <= least) {
                least = distance;
                nearest = trail.id;
            }
    return nearest;
}

void PingMap::setColourBarShown(bool isShown)
{
    m_bar->setVisible(isShown);
}

void PingMap::followProjection()
{
    const bool hadFocus = m_pages->currentWidget()->hasFocus();
    m_pages->setCurrentWidget(m_plane->display().isPolar() ? static_cast<QWidget *>(m_polar) : m_plane);
    if (hadFocus)
        m_pages->currentWidget()->setFocus();
}

void PingMap::follow()
{
    const PictureDisplay &display = m_plane->display();
    m_overlay->hasTracks = display.shows(PictureDisplay::TrackLayer);
    m_overlay->hasTruth = display.shows(PictureDisplay::TruthLayer);
    m_overlay->hasEvents = display.shows(PictureDisplay::EventLayer);
    for (int i = 0; i < 2; ++i) {
        overlays(i)->hasBoxes = display.shows(PictureDisplay::InhibitionLayer);
        overlays(i)->hasConventional = display.shows(PictureDisplay::ConventionalLayer);
    }
    // The plane has its own crosshair.
    const auto &cursor = m_viewport.cursor();
    m_polar->overlay().cursor = cursor && display.shows(PictureDisplay::CursorLayer)
                                    ? std::optional(PingMarks::Place{cursor->seconds, cursor->hz})
                                    : std::nullopt;
    m_overlay->colours = m_polar->overlay().colours = Theme::colours(*this);
    m_plane->replot();
    m_polar->replot();
}

void PingMap::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange)
        follow();
}

void PingMap::keyPressEvent(QKeyEvent *event)
{
    if (event->key() == Qt::Key_P && !(event->modifiers() & ~Qt::ShiftModifier))
        return m_plane->display().setPolar(!isPolar());
    QWidget::keyPressEvent(event);
}

} // namespace faintline

#pragma once

#include "widgets/waterfall/WaterfallView.h"

#include <QPointF>
#include <QWidget>

#include <optional>
#include <vector>

class QBoxLayout;

namespace faintline {

class ColourBar;
class TimeStack;

/// Several pictures on the same axes: side by side, or, if time runs from left to right, above each other on one time
/// axis. They share viewport, orientation, colour map and one range of colours with its bar; the automatic range is the
/// union of the pictures' own. Pictures that do not fit are reached by scrolling.
class LinkedPictures : public QWidget
{
    Q_OBJECT

public:
    explicit LinkedPictures(Viewport &viewport, QWidget *parent = nullptr);

    /// Number of pictures shown; those that are no longer shown are emptied.
    void setCount(int count);
    int count() const { return m_count; }
    WaterfallView &at(int place) const { return *m_views[std::size_t(place)]; }

public slots:
    void setOrientation(faintline::WaterfallPicture::Orientation orientation);
    void setColourMap(const QString &name);

signals:
    void chosen(int place); ///< clicked, or Return pressed
    void orientationChanged(faintline::WaterfallPicture::Orientation orientation);
    void colourMapChanged(const QString &name);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override; ///< clicks and Return

private:
    void addView();
    void watchMouse(const QMouseEvent &event, int place);
    void followRange(const WaterfallView &from);
    void followHistogram();
    void spreadAutomaticRange();
    void spread(const Span &range);

    Viewport &m_viewport;
    QWidget *m_holder;
    QBoxLayout *m_line; ///< of the pictures
    ColourBar *m_bar;
    TimeStack *m_stack;
    std::vector<WaterfallView *> m_views; ///< created when they are first needed
    int m_count = 0;
    WaterfallPicture::Orientation m_orientation = WaterfallPicture::Orientation::NewestOnTop;
    QString m_colourMap;
    bool m_isAutomatic = true;
    bool m_isSpreading = false;
    std::optional<QPointF> m_pressed; ///< where, on the canvas
};

} // namespace faintline

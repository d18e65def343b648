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
/// axis. They share viewport, display, direction and one range of colours with its bar; the automatic range is the union
/// of the pictures' own. Pictures that do not fit are reached by scrolling.
class LinkedPictures : public QWidget
{
    Q_OBJECT

public:
    /// The three are not owned, and may be shared with other pictures.
    LinkedPictures(Viewport &viewport, PictureDisplay &display, TimeDirection &direction, QWidget *parent = nullptr);

    /// Number of pictures shown; those that are no longer shown are emptied.
    void setCount(int count);
    int count() const { return m_count; }
    WaterfallView &at(int place) const { return *m_views[std::size_t(place)]; }

signals:
    void chosen(int place); ///< clicked, or Return pressed

protected:
    bool eventFilter(QObject *watched, QEvent *event) override; ///< clicks and Return

private:
    void addView();
    void arrange();
    void watchMouse(const QMouseEvent &event, int place);
    void followRange(const WaterfallView &from);
    void followHistogram();
    void spreadAutomaticRange();
    void spread(const Span &range);

    Viewport &m_viewport;
    PictureDisplay &m_display;
    TimeDirection &m_direction;
    QWidget *m_holder;
    QBoxLayout *m_line; ///< of the pictures
    ColourBar *m_bar;
    TimeStack *m_stack;
    std::vector<WaterfallView *> m_views; ///< created when they are first needed
    int m_count = 0;
    bool m_isAutomatic = true;
    bool m_isSpreading = false;
    std::optional<QPointF> m_pressed; ///< where, on the canvas
};

} // namespace faintline

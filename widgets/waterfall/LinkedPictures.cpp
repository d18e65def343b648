#include "widgets/waterfall/LinkedPictures.h"

#include "widgets/base/TimeStack.h"
#include "widgets/waterfall/ColourBar.h"

#include <QBoxLayout>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QScopedValueRollback>
#include <QScrollArea>

#include <algorithm>

namespace faintline {

namespace {

    constexpr QSize leastPicture(180, 110); ///< pixels; below, the pictures scroll
    constexpr double clickSlop = 4.0;       ///< pixels that a click may move

} // namespace

LinkedPictures::LinkedPictures(Viewport &viewport, PictureDisplay &display, TimeDirection &direction, QWidget *parent)
    : QWidget(parent), m_viewport(viewport), m_display(display), m_direction(direction), m_holder(new QWidget),
      m_line(new QBoxLayout(QBoxLayout::LeftToRight)), m_bar(new ColourBar), m_stack(new TimeStack(this))
{
    m_holder->setLayout(m_line);
    m_line->setContentsMargins(0, 0, 0, 0);
    m_line->setSpacing(0);
    auto *area = new QScrollArea;
    area->setWidget(m_holder);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setFocusPolicy(Qt::NoFocus);
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(area, 1);
    layout->addWidget(m_bar);
    m_bar->setUnit(tr("dB"));
    m_bar->hide();
    connect(m_bar, &ColourBar::rangeRequested, this, [this](double low, double high) {
        m_isAutomatic = false;
        spread({low, high});
    });
    connect(m_bar, &ColourBar::automaticRequested, this, &LinkedPictures::spreadAutomaticRange);
    const auto followColours = [this] { m_bar->setColourMap(m_display.colourMap()); };
    connect(&display, &PictureDisplay::coloursChanged, this, followColours);
    connect(&direction, &TimeDirection::changed, this, &LinkedPictures::arrange);
    followColours();
    arrange();
}

void LinkedPictures::setCount(int count)
{
    while (std::ssize(m_views) < count)
        addView();
    m_count = count;
    for (int place = 0; place < int(std::ssize(m_views)); ++place) {
        at(place).setVisible(place < count);
        if (place >= count)
            at(place).setPicture(nullptr, {});
    }
    m_bar->setVisible(count > 0);
}

void LinkedPictures::addView()
{
    auto *view = new WaterfallView(QString(), &m_display, &m_direction);
    const int place = int(std::ssize(m_views));
    m_views.push_back(view);
    view->setMinimumSize(leastPicture);
    view->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    view->setViewport(&m_viewport);
    view->setProperty("place", place);
    view->installEventFilter(this);
    view->canvas()->setProperty("place", place);
    view->canvas()->installEventFilter(this);
    m_line->addWidget(view, 1);
    m_stack->add(*view, *view);
    connect(view, &WaterfallView::rangeChanged, this, [this, view] { followRange(*view); });
    connect(view, &WaterfallView::histogramChanged, this, &LinkedPictures::followHistogram);
}

void LinkedPictures::arrange()
{
    const bool isStacked = !m_direction.isVertical();
    m_line->setDirection(isStacked ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
    m_stack->setOn(isStacked);
}

// ---- the range of colours ------------------------------------------------------------------------------------------

void LinkedPictures::followRange(const WaterfallView &from)
{
    if (m_isSpreading)
        return;
    if (from.isRangeAutomatic())
        return spreadAutomaticRange();
    m_isAutomatic = false;
    spread(from.range());
}

/// The bar shows the values of all pictures.
void LinkedPictures::followHistogram()
{
    std::vector<double> sum;
    const PeakPyramid *any = nullptr;
    for (int place = 0; place < m_count; ++place) {
        const std::vector<double> &counts = at(place).histogram();
        if (!at(place).picture())
            continue;
        any = at(place).picture().get();
        sum.resize(std::max(sum.size(), counts.size()));
        for (std::size_t i = 0; i < counts.size(); ++i)
            sum[i] += counts[i];
    }
    m_bar->setHistogram(any ? any->scale() : ByteScale(), sum);
    if (m_isAutomatic && !m_isSpreading)
        spreadAutomaticRange();
}

void LinkedPictures::spreadAutomaticRange()
{
    m_isAutomatic = true;
    std::optional<Span> range;
    for (int place = 0; place < m_count; ++place) {
        if (!at(place).picture())
            continue;
        const Span own = at(place).automaticRange();
        range = range ? Span{std::min(range->low, own.low), std::max(range->high, own.high)} : own;
    }
    if (range)
        spread(*range);
}

void LinkedPictures::spread(const Span &range)
{
    const QScopedValueRollback spreading(m_isSpreading, true);
    for (WaterfallView *view : m_views)
        if (view->isRangeAutomatic() || view->range() != range)
            view->setRange(range.low, range.high);
    m_bar->setRange(range.low, range.high);
}

// ---- choosing a picture --------------------------------------------------------------------------------------------

bool LinkedPictures::eventFilter(QObject *watched, QEvent *event)
{
    const int place = watched->property("place").toInt();
    const bool isCanvas = watched == at(place).canvas();
    if (isCanvas && (event->type() == QEvent::MouseButtonPress || event->type() == QEvent::MouseButtonRelease))
        watchMouse(*static_cast<QMouseEvent *>(event), place);
    if (!isCanvas && event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent *>(event)->key();
        if (key == Qt::Key_Return || key == Qt::Key_Enter) {
            emit chosen(place);
            return true;
        }
    }
    return QWidget::eventFilter(watched, event);
}

void LinkedPictures::watchMouse(const QMouseEvent &event, int place)
{
    if (event.button() != Qt::LeftButton)
        return;
    if (event.type() == QEvent::MouseButtonPress) {
        m_pressed = event.position();
        return;
    }
    const bool isClick = m_pressed && (event.position() - *m_pressed).manhattanLength() < clickSlop;
    m_pressed.reset();
    if (isClick)
        emit chosen(place);
}

} // namespace faintline

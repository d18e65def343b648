#include "widgets/plot/ChartPlot.h"

#include "widgets/base/CanvasSentence.h"
#include "widgets/base/Theme.h"
#include "widgets/base/fittingTitle.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/base/scaleTicks.h"
#include "widgets/plot/ChartItems.h"
#include "widgets/plot/ChartKey.h"
#include "widgets/plot/NumberScaleDraw.h"
#include "widgets/plot/PowerScaleDraw.h"
#include "widgets/plot/chartSpans.h"

#include <qwt_plot.h>
#include <qwt_plot_curve.h>
#include <qwt_plot_grid.h>
#include <qwt_plot_marker.h>
#include <qwt_symbol.h>

#include <QBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QScopedValueRollback>

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

namespace faintline {

namespace {

    constexpr double reach = 24.0; ///< px from the mouse to a point

    QString words(const std::string &text)
    {
        return labelText(text);
    }

    QString valueText(double value)
    {
        return std::abs(value) >= 1e-3 && std::abs(value) < 1e4
                   ? QString::number(value, 'g', 3).replace(QLatin1Char('-'), QChar(0x2212))
                   : powerText(value, 2);
    }

} // namespace

ChartPlot::ChartPlot(QWidget *parent)
    : QWidget(parent), m_plot(new QwtPlot), m_grid(new QwtPlotGrid), m_ring(new QwtPlotMarker), m_marks(new ChartMarks),
      m_sentence(new CanvasSentence), m_row(new QBoxLayout(QBoxLayout::LeftToRight)), m_key(new ChartKey),
      m_readOut(plainLabel())
{
    m_grid->attach(m_plot);
    m_ring->setZ(60.0);
    m_ring->attach(m_plot);
    m_marks->attach(m_plot);
    m_sentence->attach(m_plot);
    m_plot->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    m_plot->setMinimumSize(120, 90);
    m_plot->setFocusPolicy(Qt::NoFocus);
    m_plot->canvas()->setFocusPolicy(Qt::NoFocus);
    m_plot->canvas()->setMouseTracking(true);
    m_plot->canvas()->installEventFilter(this);
    m_plot->installEventFilter(this);
    setFocusPolicy(Qt::StrongFocus);

    connect(m_key, &ChartKey::toggled, this, &ChartPlot::setShown);
    m_readOut->setTextFormat(Qt::PlainText);
    m_readOut->setContentsMargins(8, 0, 8, 3);
    m_readOut->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);

    m_row->setSpacing(0);
    m_row->addWidget(m_plot, 1);
    m_row->addWidget(m_key);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(m_row, 1);
    layout->addWidget(m_readOut);
    restyle();
}

ChartPlot::~ChartPlot()
{
    m_plot->canvas()->removeEventFilter(this); // they outlive objects that the filter uses
    m_plot->removeEventFilter(this);
}

void ChartPlot::setChart(const Chart &chart)
{
    m_chart = chart;
    if (m_place
        && (m_place->curve >= chart.curves.size() || m_place->point >= chart.curves[m_place->curve].points.size()))
        m_place.reset();
    restyle();
}

void ChartPlot::setMarks(std::vector<ChartMark> marks)
{
    if (m_marks->marks == marks)
        return;
    m_marks->marks = std::move(marks);
    m_plot->replot();
}

void ChartPlot::setLeastOrdinates(std::optional<Span> span)
{
    m_leastOrdinates = span;
    layAxes();
}

void ChartPlot::setEmptySentence(const QString &sentence)
{
    m_sentence->text = sentence;
    m_plot->replot();
}

void ChartPlot::setInvitation(const QString &invitation)
{
    m_invitation = invitation;
}

void ChartPlot::setPrinted(bool isPrinted)
{
    m_isPrinted = isPrinted;
    m_ring->setVisible(false);
    m_key->setPrinted(isPrinted);
    rebuild();
}

bool ChartPlot::isShown(std::size_t curve) const
{
    return !m_hidden.contains(words(m_chart.curves[curve].name));
}

void ChartPlot::setShown(std::size_t curve, bool isShown)
{
    const QString name = words(m_chart.curves[curve].name);
    isShown ? void(m_hidden.remove(name)) : void(m_hidden.insert(name));
    m_key->setShown(curve, isShown);
    m_curves[curve]->setVisible(isShown);
    for (QwtPlotItem *detail : m_details[curve])
        detail->setVisible(isShown);
    if (m_place && m_place->curve == curve && !isShown)
        showPlace({});
    layAxes();
}

QPointF ChartPlot::canvasPosition(std::size_t curve, std::size_t point) const
{
    return onCanvas(items().place(m_chart.curves[curve].points[point]));
}

QPointF ChartPlot::onCanvas(const QPointF &coordinates) const
{
    return {m_plot->transform(QwtAxis::XBottom, coordinates.x()), m_plot->transform(QwtAxis::YLeft, coordinates.y())};
}

QString ChartPlot::readOut() const
{
    return m_readOut->text();
}

ChartItems ChartPlot::items() const
{
    return {m_chart, Theme::colours(*this)};
}

void ChartPlot::restyle()
{
    const Theme::Colours &colours = Theme::colours(*this);
    m_plot->setAxisScaleDraw(QwtAxis::XBottom, m_chart.isLogarithmicX ? static_cast<QwtScaleDraw *>(new PowerScaleDraw)
                                                                      : new NumberScaleDraw);
    m_plot->setAxisScaleDraw(QwtAxis::YLeft, m_chart.isLogarithmicY ? static_cast<QwtScaleDraw *>(new PowerScaleDraw)
                                                                    : new NumberScaleDraw);
    m_plot->setAxisTitle(QwtAxis::XBottom, words(m_chart.xLabel));
    m_plot->setAxisTitle(QwtAxis::YLeft, words(m_chart.yLabel));
    Theme::style(*m_plot);
    m_grid->setPen(colours.grid, 1.0);
    m_sentence->colour = colours.faintText;
    m_marks->colour = colours.text;
    m_marks->plate = colours.canvas;
    QPalette faint = palette();
    faint.setColor(QPalette::WindowText, colours.faintText);
    m_readOut->setPalette(faint);
    m_readOut->setFont(Theme::font(12));
    m_ring->setSymbol(new QwtSymbol(QwtSymbol::Ellipse, Qt::NoBrush, QPen(colours.text, 1.6), QSize(13, 13)));
    setAccessibleName(m_chart.title.empty() ? tr("Chart") : words(m_chart.title));
    rebuild();
}

void ChartPlot::rebuild()
{
    for (const std::vector<QwtPlotItem *> &details : m_details)
        qDeleteAll(details);
    qDeleteAll(m_curves);
    m_curves.clear();
    m_details.assign(m_chart.curves.size(), {});
    for (std::size_t i = 0; i < m_chart.curves.size(); ++i)
        addCurve(i);
    rebuildKey();
    const bool isEmpty = m_chart.curves.empty();
    m_sentence->setVisible(isEmpty);
    m_grid->setVisible(!isEmpty);
    m_marks->setVisible(!isEmpty);
    m_plot->setAxisVisible(QwtAxis::XBottom, !isEmpty);
    m_plot->setAxisVisible(QwtAxis::YLeft, !isEmpty);
    m_readOut->setVisible(!isEmpty && !m_isPrinted);
    showPlace(m_place);
    layAxes();
}

void ChartPlot::addCurve(std::size_t index)
{
    const ChartItems items = this->items();
    const auto add = [&](std::unique_ptr<QwtPlotItem> item) {
        item->setVisible(isShown(index));
        item->attach(m_plot);
        return item.release();
    };
    if (auto intervals = items.intervals(index))
        m_details[index].push_back(add(std::move(intervals)));
    for (auto &label : items.labels(index))
        m_details[index].push_back(add(std::move(label)));
    m_curves.push_back(add(items.curve(index)));
}

void ChartPlot::rebuildKey()
{
    const ChartItems items = this->items();
    std::vector<ChartKey::Entry> entries;
    for (std::size_t i = 0; i < m_chart.curves.size(); ++i)
        entries.push_back({words(m_chart.curves[i].name), items.sample(i, devicePixelRatioF()), isShown(i)});
    m_key->setEntries(entries);
    m_key->placeIn(*m_row, size());
}

void ChartPlot::resizeEvent(QResizeEvent *event)
{
    QWidget::resizeEvent(event);
    m_key->placeIn(*m_row, size());
}

void ChartPlot::layAxes()
{
    const auto [x, y] = chartSpans(
        m_chart, items(), [this](std::size_t curve) { return isShown(curve); }, m_leastOrdinates);
    const QSize size = m_plot->canvas()->contentsRect().size();
    m_plot->setAxisScaleDiv(QwtAxis::XBottom, m_chart.isLogarithmicX
                                                  ? digitScaleDiv(x)
                                                  : linearScaleDiv(x, std::clamp(size.width() / 60, 2, 12)));
    m_plot->setAxisScaleDiv(QwtAxis::YLeft, m_chart.isLogarithmicY
                                                ? digitScaleDiv(y)
                                                : linearScaleDiv(y, std::clamp(size.height() / 30, 2, 10)));
    for (const auto &[axis, whole, room] : {std::tuple(QwtAxis::XBottom, m_chart.xLabel, size.width()),
                                            std::tuple(QwtAxis::YLeft, m_chart.yLabel, size.height())}) {
        QwtText title = m_plot->axisTitle(axis);
        title.setText(fittingTitle(words(whole), title.font(), room));
        if (title != m_plot->axisTitle(axis))
            m_plot->setAxisTitle(axis, title);
    }
    m_plot->replot();
}

std::optional<ChartPlot::Place> ChartPlot::nearest(const QPointF &canvas) const
{
    const ChartItems items = this->items();
    std::optional<Place> best;
    double shortest = reach;
    for (std::size_t c = 0; c < m_chart.curves.size(); ++c) {
        if (!isShown(c) || m_chart.curves[c].kind == Curve::Kind::Theory)
            continue;
        for (std::size_t p = 0; p < m_chart.curves[c].points.size(); ++p) {
            const QPointF gap = onCanvas(items.place(m_chart.curves[c].points[p])) - canvas;
            const double distance = std::hypot(gap.x(), gap.y());
            if (distance < shortest) {
                shortest = distance;
                best = Place{c, p};
            }
        }
    }
    return best;
}

void ChartPlot::showPlace(const std::optional<Place> &place)
{
    m_place = place;
    m_ring->setVisible(place.has_value());
    if (!place) {
        m_readOut->setText(m_invitation.isEmpty() ? tr("Point at a marker to read its value.")
                                                  : tr("Point at a marker to read its value; %1.").arg(m_invitation));
        m_plot->replot();
        return;
    }
    const ChartItems items = this->items();
    const Curve &curve = m_chart.curves[place->curve];
    const Curve::Point &point = curve.points[place->point];
    m_ring->setValue(items.place(point));
    const QString name = curve.name.empty() ? QString() : words(curve.name) + QStringLiteral(":  ");
    QString text = tr("%1%2 = %3  →  %4").arg(name, words(m_chart.xLabel), valueText(point.x), valueText(point.y));
    if (!point.label.empty())
        text.prepend(words(point.label) + QStringLiteral(":  "));
    if (point.interval.low < point.interval.high)
        text += tr("  (95 %: %1 … %2)").arg(valueText(point.interval.low), valueText(point.interval.high));
    if (!m_invitation.isEmpty() && items.isMeasured(place->curve))
        text += QStringLiteral("  ·  ") + m_invitation;
    m_readOut->setText(text);
    setAccessibleDescription(text);
    m_plot->replot();
}

void ChartPlot::move(int points, int curves)
{
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < m_chart.curves.size(); ++i)
        if (isShown(i) && m_chart.curves[i].kind != Curve::Kind::Theory && !m_chart.curves[i].points.empty())
            shown.push_back(i);
    if (shown.empty())
        return;
    if (!m_place)
        return showPlace(Place{shown.front(), 0});
    const auto at = std::find(shown.begin(), shown.end(), m_place->curve) - shown.begin();
    const auto next = std::clamp<std::ptrdiff_t>(at + curves, 0, std::ssize(shown) - 1);
    Place place{shown[std::size_t(next)], m_place->point};
    const auto last = std::ssize(m_chart.curves[place.curve].points) - 1;
    place.point = std::size_t(std::clamp<std::ptrdiff_t>(std::ptrdiff_t(place.point) + points, 0, last));
    showPlace(place);
}

void ChartPlot::keyPressEvent(QKeyEvent *event)
{
    switch (event->key()) {
    case Qt::Key_Left:
        return move(-1, 0);
    case Qt::Key_Right:
        return move(1, 0);
    case Qt::Key_Up:
        return move(0, -1);
    case Qt::Key_Down:
        return move(0, 1);
    case Qt::Key_Return:
    case Qt::Key_Enter:
        if (m_place && items().isMeasured(m_place->curve))
            emit pointActivated(m_place->curve, m_place->point);
        return;
    default:
        QWidget::keyPressEvent(event);
    }
}

bool ChartPlot::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == m_plot && event->type() == QEvent::PaletteChange)
        restyle(); // the plot receives a new theme's palette after the chart
    if (watched != m_plot->canvas())
        return QWidget::eventFilter(watched, event);
    // The width of labels depends on the ticks, and the ticks depend on the width. If this does not converge, the third
    // attempt is used.
    constexpr int mostTries = 3;
    if (event->type() == QEvent::Resize && m_resizing < mostTries) {
        const QScopedValueRollback nested(m_resizing, m_resizing + 1);
        layAxes();
    }
    if (event->type() == QEvent::MouseMove) {
        const auto place = nearest(static_cast<QMouseEvent *>(event)->position());
        if (place != m_place)
            showPlace(place);
        const bool canBeClicked = place && items().isMeasured(place->curve) && !m_invitation.isEmpty();
        m_plot->canvas()->setCursor(canBeClicked ? Qt::PointingHandCursor : Qt::ArrowCursor);
    }
    if (event->type() == QEvent::MouseButtonPress && static_cast<QMouseEvent *>(event)->button() == Qt::LeftButton) {
        setFocus(Qt::MouseFocusReason);
        const auto place = nearest(static_cast<QMouseEvent *>(event)->position());
        showPlace(place);
        if (place && items().isMeasured(place->curve))
            emit pointActivated(place->curve, place->point);
    }
    return QWidget::eventFilter(watched, event);
}

void ChartPlot::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::StyleChange)
        restyle();
}

void ChartPlot::focusInEvent(QFocusEvent *event)
{
    QWidget::focusInEvent(event);
    Theme::frame(*m_plot, hasFocus());
}

void ChartPlot::focusOutEvent(QFocusEvent *event)
{
    QWidget::focusOutEvent(event);
    Theme::frame(*m_plot, hasFocus());
}

} // namespace faintline

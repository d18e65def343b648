#include "widgets/plot/ChartPlot.h"

#include "widgets/base/CanvasSentence.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/base/scaleTicks.h"
#include "widgets/plot/NumberScaleDraw.h"
#include "widgets/plot/PowerScaleDraw.h"

#include <qwt_interval_symbol.h>
#include <qwt_plot.h>
#include <qwt_plot_curve.h>
#include <qwt_plot_grid.h>
#include <qwt_plot_intervalcurve.h>
#include <qwt_plot_marker.h>
#include <qwt_scale_map.h>
#include <qwt_symbol.h>
#include <qwt_text.h>

#include <QBoxLayout>
#include <QCheckBox>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QScopedValueRollback>
#include <QScrollArea>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace faintline {

namespace {

    constexpr std::size_t mostBars = 24;    ///< more points than that: a band
    constexpr std::size_t mostMarkers = 60; ///< more points than that: a line alone
    constexpr double reach = 24.0;          ///< px from the mouse to a point

    constexpr std::array<QwtSymbol::Style, 8> symbols{QwtSymbol::Ellipse,   QwtSymbol::Rect,      QwtSymbol::Diamond,
                                                      QwtSymbol::UTriangle, QwtSymbol::DTriangle, QwtSymbol::Hexagon,
                                                      QwtSymbol::LTriangle, QwtSymbol::RTriangle};

    QString words(const std::string &text)
    {
        return labelText(text);
    }

    std::unique_ptr<QwtSymbol> symbolOf(Curve::Kind kind, std::size_t style, const QColor &colour, const QColor &canvas)
    {
        const bool isHollow = kind == Curve::Kind::Paper;
        return std::make_unique<QwtSymbol>(symbols[style % symbols.size()], QBrush(isHollow ? canvas : colour),
                                           QPen(colour, 1.4), QSize(7, 7));
    }

    QPen penOf(Curve::Kind kind, const QColor &colour)
    {
        return QPen(colour, 1.6, kind == Curve::Kind::Theory ? Qt::DashLine : Qt::SolidLine);
    }

    Span spanOf(const std::vector<double> &values)
    {
        if (values.empty())
            return {0.0, 1.0};
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        return {*low, *high};
    }

    /// A little air on both sides; a single value in the middle.
    Span aired(Span span, double share)
    {
        const double air = span.high > span.low ? share * (span.high - span.low) : 0.5;
        return {span.low - air, span.high + air};
    }

    QwtScaleDiv decades(const Span &span)
    {
        QList<double> major;
        QList<double> minor;
        for (double exponent = std::floor(span.low); exponent <= std::ceil(span.high); exponent += 1.0) {
            major << exponent;
            for (int digit = 2; digit <= 9; ++digit)
                minor << exponent + std::log10(digit);
        }
        return QwtScaleDiv(span.low, span.high, minor, {}, major);
    }

    QString valueText(double value)
    {
        return std::abs(value) >= 1e-3 && std::abs(value) < 1e4
                   ? QString::number(value, 'g', 3).replace(QLatin1Char('-'), QChar(0x2212))
                   : powerText(value, 2);
    }

} // namespace

ChartPlot::ChartPlot(QWidget *parent)
    : QWidget(parent), m_plot(new QwtPlot), m_grid(new QwtPlotGrid), m_ring(new QwtPlotMarker),
      m_sentence(new CanvasSentence), m_row(new QBoxLayout(QBoxLayout::LeftToRight)), m_keyArea(new QScrollArea),
      m_key(new QWidget), m_keyLayout(new QVBoxLayout(m_key)), m_readOut(plainLabel())
{
    m_grid->attach(m_plot);
    m_ring->setZ(60.0);
    m_ring->attach(m_plot);
    m_sentence->attach(m_plot);
    m_plot->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    m_plot->setMinimumSize(120, 90);
    m_plot->setFocusPolicy(Qt::NoFocus);
    m_plot->canvas()->setFocusPolicy(Qt::NoFocus);
    m_plot->canvas()->setMouseTracking(true);
    m_plot->canvas()->installEventFilter(this);
    setFocusPolicy(Qt::StrongFocus);

    m_keyLayout->setContentsMargins(4, 6, 8, 6);
    m_keyLayout->setSpacing(3);
    m_keyArea->setWidget(m_key);
    m_keyArea->setWidgetResizable(true);
    m_keyArea->setFrameShape(QFrame::NoFrame);
    m_keyArea->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_keyArea->setFocusPolicy(Qt::NoFocus);
    m_readOut->setTextFormat(Qt::PlainText);
    m_readOut->setContentsMargins(8, 0, 8, 3);
    m_readOut->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);

    m_row->setSpacing(0);
    m_row->addWidget(m_plot, 1);
    m_row->addWidget(m_keyArea);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(m_row, 1);
    layout->addWidget(m_readOut);
    restyle();
}

ChartPlot::~ChartPlot()
{
    m_plot->canvas()->removeEventFilter(this); // it outlives what the filter looks at
}

void ChartPlot::setChart(const Chart &chart)
{
    m_chart = chart;
    if (m_place
        && (m_place->curve >= chart.curves.size() || m_place->point >= chart.curves[m_place->curve].points.size()))
        m_place.reset();
    restyle();
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
    m_key->setStyleSheet(isPrinted ? QStringLiteral("QCheckBox::indicator { width: 0px; height: 0px; }") : QString());
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
    m_boxes[curve]->setChecked(isShown);
    m_curves[curve]->setVisible(isShown);
    for (QwtPlotItem *detail : m_details[curve])
        detail->setVisible(isShown);
    if (m_place && m_place->curve == curve && !isShown)
        showPlace({});
    layAxes();
}

QPointF ChartPlot::canvasPosition(std::size_t curve, std::size_t point) const
{
    const Curve::Point &at = m_chart.curves[curve].points[point];
    return {m_plot->transform(QwtAxis::XBottom, abscissa(at.x)), m_plot->transform(QwtAxis::YLeft, ordinate(at.y))};
}

QString ChartPlot::readOut() const
{
    return m_readOut->text();
}

bool ChartPlot::isMeasured(std::size_t curve) const
{
    return m_chart.curves[curve].kind == Curve::Kind::Measured;
}

double ChartPlot::abscissa(double x) const
{
    return m_chart.isLogarithmicX ? std::log10(std::max(x, std::numeric_limits<double>::min())) : x;
}

double ChartPlot::ordinate(double y) const
{
    return m_chart.isLogarithmicY ? std::log10(std::max(y, std::numeric_limits<double>::min())) : y;
}

/// Colour and symbol: measured curves are counted, what belongs to one follows it; nothing for what belongs to none.
std::optional<std::size_t> ChartPlot::styleOf(std::size_t curve) const
{
    const auto countBefore = [this](std::size_t end) {
        return std::size_t(std::count_if(m_chart.curves.begin(), m_chart.curves.begin() + std::ptrdiff_t(end),
                                         [](const Curve &c) { return c.kind == Curve::Kind::Measured; }));
    };
    if (isMeasured(curve))
        return countBefore(curve);
    std::size_t longest = 0;
    std::optional<std::size_t> owner;
    for (std::size_t i = 0; i < m_chart.curves.size(); ++i) {
        const std::string &name = m_chart.curves[i].name;
        if (isMeasured(i) && name.size() >= longest && m_chart.curves[curve].name.starts_with(name)) {
            longest = name.size();
            owner = i;
        }
    }
    return owner ? std::optional(countBefore(*owner)) : std::nullopt;
}

QColor ChartPlot::colourOf(std::size_t curve) const
{
    const Theme::Colours &colours = Theme::colours(*this);
    const auto style = styleOf(curve);
    return style ? colours.curves[*style % std::size(colours.curves)] : colours.text;
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
    m_plot->detachItems(QwtPlotItem::Rtti_PlotCurve);
    m_plot->detachItems(QwtPlotItem::Rtti_PlotIntervalCurve);
    for (QwtPlotMarker *label : m_labels)
        delete label;
    m_labels.clear();
    m_curves.clear();
    m_details.assign(m_chart.curves.size(), {});
    for (std::size_t i = 0; i < m_chart.curves.size(); ++i)
        addCurve(i);
    rebuildKey();
    const bool isEmpty = m_chart.curves.empty();
    m_sentence->setVisible(isEmpty);
    m_grid->setVisible(!isEmpty);
    m_plot->setAxisVisible(QwtAxis::XBottom, !isEmpty);
    m_plot->setAxisVisible(QwtAxis::YLeft, !isEmpty);
    m_readOut->setVisible(!isEmpty && !m_isPrinted);
    showPlace(m_place);
    layAxes();
}

void ChartPlot::addCurve(std::size_t index)
{
    const Curve &curve = m_chart.curves[index];
    const Theme::Colours &colours = Theme::colours(*this);
    const std::size_t style = styleOf(index).value_or(0);
    const QColor colour = colourOf(index);
    addIntervals(index, colour);
    addLabels(index);

    auto *item = new QwtPlotCurve(words(curve.name));
    item->setRenderHint(QwtPlotItem::RenderAntialiased);
    item->setPen(penOf(curve.kind, colour));
    item->setZ(curve.kind == Curve::Kind::Theory ? 20.0 : 30.0);
    if (curve.kind == Curve::Kind::Paper)
        item->setStyle(QwtPlotCurve::NoCurve);
    if (curve.kind != Curve::Kind::Theory && curve.points.size() <= mostMarkers)
        item->setSymbol(symbolOf(curve.kind, style, colour, colours.canvas).release());
    QPolygonF samples;
    for (const Curve::Point &point : curve.points)
        samples << QPointF(abscissa(point.x), ordinate(point.y));
    item->setSamples(samples);
    item->setVisible(isShown(index));
    item->attach(m_plot);
    m_curves.push_back(item);
}

/// Above the points, or below those at the top: where there is room.
void ChartPlot::addLabels(std::size_t index)
{
    double highest = 0.0;
    for (const Curve::Point &point : m_chart.curves[index].points)
        highest = std::max(highest, point.y);
    for (const Curve::Point &point : m_chart.curves[index].points) {
        if (point.label.empty())
            continue;
        QwtText text(words(point.label), QwtText::PlainText);
        text.setFont(Theme::plotFont());
        text.setColor(Theme::colours(*this).text);
        auto *item = new QwtPlotMarker;
        item->setLabel(text);
        item->setLabelAlignment(Qt::AlignRight | (point.y > 0.85 * highest ? Qt::AlignBottom : Qt::AlignTop));
        item->setSpacing(4);
        item->setValue(abscissa(point.x), ordinate(point.y));
        item->setZ(25.0);
        item->setVisible(isShown(index));
        item->attach(m_plot);
        m_details[index].push_back(item);
        m_labels.push_back(item);
    }
}

void ChartPlot::addIntervals(std::size_t index, const QColor &colour)
{
    const Curve &curve = m_chart.curves[index];
    QVector<QwtIntervalSample> samples;
    for (const Curve::Point &point : curve.points)
        if (point.interval.low < point.interval.high)
            samples << QwtIntervalSample(abscissa(point.x), ordinate(point.interval.low),
                                         ordinate(point.interval.high));
    if (samples.isEmpty())
        return;
    auto *item = new QwtPlotIntervalCurve;
    item->setRenderHint(QwtPlotItem::RenderAntialiased);
    item->setSamples(samples);
    item->setPen(QPen(Qt::NoPen));
    item->setZ(10.0);
    if (curve.points.size() > mostBars) {
        QColor band = colour;
        band.setAlpha(46);
        item->setStyle(QwtPlotIntervalCurve::Tube);
        item->setBrush(band);
    } else {
        item->setStyle(QwtPlotIntervalCurve::NoCurve);
        auto *bar = new QwtIntervalSymbol(QwtIntervalSymbol::Bar);
        bar->setWidth(5);
        bar->setPen(QPen(colour, 1.0));
        item->setSymbol(bar);
    }
    item->setVisible(isShown(index));
    item->attach(m_plot);
    m_details[index].push_back(item);
}

QPixmap ChartPlot::sample(std::size_t index) const
{
    const Curve &curve = m_chart.curves[index];
    const Theme::Colours &colours = Theme::colours(*this);
    const std::size_t style = styleOf(index).value_or(0);
    const QColor colour = colourOf(index);
    QPixmap pixmap(QSize(26, 12) * devicePixelRatioF());
    pixmap.setDevicePixelRatio(devicePixelRatioF());
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(penOf(curve.kind, colour));
    if (curve.kind != Curve::Kind::Paper)
        painter.drawLine(QPointF(1, 6), QPointF(25, 6));
    if (curve.kind != Curve::Kind::Theory)
        symbolOf(curve.kind, style, colour, colours.canvas)->drawSymbol(&painter, QPointF(13, 6));
    return pixmap;
}

void ChartPlot::rebuildKey()
{
    // While a curve grows, its box stays the same: whoever is about to press it must not lose it.
    const bool isSame = m_boxes.size() == m_chart.curves.size()
                        && std::equal(m_boxes.begin(), m_boxes.end(), m_chart.curves.begin(),
                                      [](const QCheckBox *box, const Curve &curve) {
                                          return box->text() == buttonText(words(curve.name));
                                      });
    if (!isSame) {
        while (QLayoutItem *item = m_keyLayout->takeAt(0)) {
            delete item->widget();
            delete item;
        }
        m_boxes.clear();
        for (std::size_t i = 0; i < m_chart.curves.size(); ++i) {
            auto *box = new QCheckBox(buttonText(words(m_chart.curves[i].name)));
            box->setToolTip(tr("Show or hide this curve"));
            box->setChecked(isShown(i));
            box->setIconSize({26, 12});
            box->setFont(Theme::font(12));
            connect(box, &QCheckBox::toggled, this, [this, i](bool isOn) { setShown(i, isOn); });
            m_keyLayout->addWidget(box);
            m_boxes.push_back(box);
        }
        m_keyLayout->addStretch(1);
    }
    for (std::size_t i = 0; i < m_boxes.size(); ++i) {
        m_boxes[i]->setIcon(QIcon(sample(i)));
        m_boxes[i]->setVisible(!m_isPrinted || isShown(i));
    }
    placeKey();
}

/// Beside the plot, or below it where that would take too much of its width and there is height to spare.
void ChartPlot::placeKey()
{
    int widest = 0;
    for (const QCheckBox *box : m_boxes)
        widest = std::max(widest, box->sizeHint().width() + 26);
    const int heightBelow = std::min(76, 8 + 24 * int(m_boxes.size()));
    const bool isNarrow = 3 * widest > width(), isVeryNarrow = 2 * widest > width();
    const bool isBelow = (isNarrow && height() > 4 * 76) || (isVeryNarrow && height() > 90 + 2 * heightBelow);
    m_row->setDirection(isBelow ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
    m_keyArea->setMinimumSize(isBelow ? 0 : widest, isBelow ? heightBelow : 0);
    m_keyArea->setMaximumSize(isBelow ? QWIDGETSIZE_MAX : widest, isBelow ? heightBelow : QWIDGETSIZE_MAX);
    const bool isNameless = m_chart.curves.size() == 1 && m_chart.curves.front().name.empty(); // the only one
    constexpr int leastBeside = 170; // px: the curves are worth more than their names, which the read-out tells
    const bool hasRoom = isBelow || width() - widest >= leastBeside;
    m_keyArea->setVisible(!m_boxes.empty() && !isNameless && hasRoom);
}

void ChartPlot::resizeEvent(QResizeEvent *event)
{
    QWidget::resizeEvent(event);
    placeKey();
}

void ChartPlot::layAxes()
{
    std::vector<double> xs;
    std::vector<double> ys;
    bool areShares = true; // probabilities get all of 0 … 1
    for (std::size_t i = 0; i < m_chart.curves.size(); ++i) {
        for (const Curve::Point &point : m_chart.curves[i].points) {
            areShares = areShares && point.y >= 0.0 && point.y <= 1.0;
            xs.push_back(abscissa(point.x));
            if (!isShown(i) || (m_chart.isLogarithmicY && point.y <= 0.0))
                continue;
            ys.push_back(ordinate(point.y));
            if (point.interval.low < point.interval.high && !(m_chart.isLogarithmicY && point.interval.low <= 0.0)) {
                ys.push_back(ordinate(point.interval.low));
                ys.push_back(ordinate(point.interval.high));
            }
        }
    }
    const QSize size = m_plot->canvas()->contentsRect().size();
    const Span x = aired(spanOf(xs), 0.03);
    const Span y = areShares && !m_chart.isLogarithmicY ? Span{-0.02, 1.02} : aired(spanOf(ys), 0.05);
    m_plot->setAxisScaleDiv(QwtAxis::XBottom, m_chart.isLogarithmicX
                                                  ? decades(x)
                                                  : linearScaleDiv(x, std::clamp(size.width() / 60, 2, 12)));
    m_plot->setAxisScaleDiv(
        QwtAxis::YLeft, m_chart.isLogarithmicY ? decades(y) : linearScaleDiv(y, std::clamp(size.height() / 30, 2, 10)));
    m_plot->replot();
}

std::optional<ChartPlot::Place> ChartPlot::nearest(const QPointF &canvas) const
{
    std::optional<Place> best;
    double shortest = reach;
    for (std::size_t c = 0; c < m_chart.curves.size(); ++c) {
        if (!isShown(c) || m_chart.curves[c].kind == Curve::Kind::Theory)
            continue;
        for (std::size_t p = 0; p < m_chart.curves[c].points.size(); ++p) {
            const QPointF gap = canvasPosition(c, p) - canvas;
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
    const Curve &curve = m_chart.curves[place->curve];
    const Curve::Point &point = curve.points[place->point];
    m_ring->setValue(abscissa(point.x), ordinate(point.y));
    const QString name = curve.name.empty() ? QString() : words(curve.name) + QStringLiteral(":  ");
    QString text = tr("%1%2 = %3  →  %4").arg(name, words(m_chart.xLabel), valueText(point.x), valueText(point.y));
    if (!point.label.empty())
        text.prepend(words(point.label) + QStringLiteral(":  "));
    if (point.interval.low < point.interval.high)
        text += tr("  (95 %: %1 … %2)").arg(valueText(point.interval.low), valueText(point.interval.high));
    if (!m_invitation.isEmpty() && isMeasured(place->curve))
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
        if (m_place && isMeasured(m_place->curve))
            emit pointActivated(m_place->curve, m_place->point);
        return;
    default:
        QWidget::keyPressEvent(event);
    }
}

bool ChartPlot::eventFilter(QObject *watched, QEvent *event)
{
    if (watched != m_plot->canvas())
        return QWidget::eventFilter(watched, event);
    // Labels take room by the ticks there are, and there are ticks for the room: where the two never agree, the third
    // try stands.
    constexpr int mostTries = 3;
    if (event->type() == QEvent::Resize && m_resizing < mostTries) {
        const QScopedValueRollback nested(m_resizing, m_resizing + 1);
        layAxes();
    }
    if (event->type() == QEvent::MouseMove) {
        const auto place = nearest(static_cast<QMouseEvent *>(event)->position());
        if (place != m_place)
            showPlace(place);
        const bool canBeClicked = place && isMeasured(place->curve) && !m_invitation.isEmpty();
        m_plot->canvas()->setCursor(canBeClicked ? Qt::PointingHandCursor : Qt::ArrowCursor);
    }
    if (event->type() == QEvent::MouseButtonPress && static_cast<QMouseEvent *>(event)->button() == Qt::LeftButton) {
        setFocus(Qt::MouseFocusReason);
        const auto place = nearest(static_cast<QMouseEvent *>(event)->position());
        showPlace(place);
        if (place && isMeasured(place->curve))
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

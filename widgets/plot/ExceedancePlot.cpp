#include "widgets/plot/ExceedancePlot.h"

#include "widgets/base/CanvasSentence.h"
#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"
#include "widgets/base/scaleTicks.h"
#include "widgets/base/steadyAxes.h"
#include "widgets/plot/CurveKey.h"
#include "widgets/plot/LineLabel.h"
#include "widgets/plot/NumberScaleDraw.h"
#include "widgets/plot/PowerScaleDraw.h"
#include "widgets/plot/exceedanceCurves.h"

#include <qwt_plot_curve.h>
#include <qwt_plot_grid.h>
#include <qwt_plot_histogram.h>
#include <qwt_plot_marker.h>
#include <qwt_scale_map.h>
#include <qwt_text.h>

#include <QActionGroup>
#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    QwtPlotCurve *makeCurve(QwtPlot *plot, double z)
    {
        auto *curve = new QwtPlotCurve;
        curve->setRenderHint(QwtPlotItem::RenderAntialiased);
        curve->setZ(z);
        curve->attach(plot);
        return curve;
    }

} // namespace

ExceedancePlot::ExceedancePlot(QWidget *parent)
    : ThemedPlot(parent), m_grid(new QwtPlotGrid), m_histogram(new QwtPlotHistogram),
      m_simulated(makeCurve(this, 20.0)), m_tail(makeCurve(this, 19.0)), m_closedForm(makeCurve(this, 21.0)),
      m_measured(makeCurve(this, 18.0)), m_selection(makeCurve(this, 18.5)), m_line(new QwtPlotMarker),
      m_label(new LineLabel), m_sentence(new CanvasSentence), m_key(new CurveKey(Qt::AlignRight | Qt::AlignTop))
{
    m_grid->attach(this);
    m_histogram->setYAxis(QwtAxis::YRight);
    m_histogram->setStyle(QwtPlotHistogram::Outline);
    m_histogram->setZ(5.0);
    m_histogram->attach(this);
    m_line->setLineStyle(QwtPlotMarker::VLine);
    m_line->setZ(40.0);
    m_line->attach(this);
    m_label->attach(this);
    m_sentence->text = tr("The exceedance on noise appears here after the calibration.");
    m_sentence->attach(this);
    m_key->attach(this);
    setAxisScaleDraw(QwtAxis::XBottom, new NumberScaleDraw);
    setAxisScaleDraw(QwtAxis::YLeft, new PowerScaleDraw);
    setAxisScaleDraw(QwtAxis::YRight, new PowerScaleDraw);
    setAxisTitle(QwtAxis::YRight, tr("Cells per bin of width ¼"));
    canvas()->setMouseTracking(true);
    setAccessibleName(tr("Threshold: exceedance of the statistic on noise"));
    setToolTip(tr("Drag the line to move the threshold, or press comma or full stop to move it by a quarter of its "
                  "unit. Right-click to choose the unit; per cell, the plot adds the closed form, this recording and "
                  "the box measured with M."));
    restyle();
}

ExceedancePlot::~ExceedancePlot() = default;

void ExceedancePlot::setCalibration(std::shared_ptr<const Calibration> calibration, double cellFramesPerHour)
{
    m_calibration = std::move(calibration);
    m_cellFramesPerHour = cellFramesPerHour;
    restyle();
}

void ExceedancePlot::setHistogram(const std::vector<double> &counts)
{
    m_counts = counts;
    updateCurves();
}

void ExceedancePlot::setClosedForm(const QPolygonF &points)
{
    m_closedFormPoints = points;
    restyle();
}

void ExceedancePlot::setSelectionExceedance(const QPolygonF &points)
{
    if (points == m_selectionPoints)
        return;
    m_selectionPoints = points;
    updateCurves();
}

void ExceedancePlot::setStatisticUnit(const QString &unit)
{
    if (unit == m_statisticUnit)
        return;
    m_statisticUnit = unit;
    restyle();
}

void ExceedancePlot::setOwnNoise(const OwnNoise &noise)
{
    if (noise == m_ownNoise)
        return;
    m_ownNoise = noise;
    updateThresholdLine();
}

void ExceedancePlot::setThreshold(double nats)
{
    if (nats == m_threshold)
        return;
    m_threshold = nats;
    if (m_isDragging)
        updateThresholdLine();
    else
        updateCurves();
}

void ExceedancePlot::setUnit(Unit unit)
{
    if (unit == m_unit)
        return;
    m_unit = unit;
    restyle();
}

double ExceedancePlot::ordinate(double nats) const
{
    if (!m_calibration)
        return smallestExponent;
    return log10OrFloor(isRate() ? m_calibration->eventRateAt(nats) * m_cellFramesPerHour
                                 : m_calibration->exceedanceAt(nats));
}

QString ExceedancePlot::thresholdText() const
{
    const QString nats = numberText(m_threshold, 2) + QLatin1Char(' ') + m_statisticUnit;
    if (!m_calibration || m_unit == Unit::Nats)
        return nats;
    if (m_unit == Unit::PfaPerCell)
        return tr("Pfa %1 per cell").arg(powerText(m_calibration->exceedanceAt(m_threshold)));
    const QString rate = powerText(m_calibration->eventRateAt(m_threshold) * m_cellFramesPerHour);
    return rate == QLatin1String("1") ? tr("1 false alarm/h") : tr("%1 false alarms/h").arg(rate);
}

QString ExceedancePlot::ownNoiseText() const
{
    if (!m_calibration || !isRate() || m_ownNoise == OwnNoise())
        return {};
    if (!m_ownNoise.ratio)
        return tr("this noise: %1").arg(m_ownNoise.words);
    const double perHour = m_calibration->eventRateAt(m_threshold) * m_cellFramesPerHour * *m_ownNoise.ratio;
    return tr("this noise: about %1/h").arg(powerText(perHour));
}

QString ExceedancePlot::labelText() const
{
    const QString own = ownNoiseText();
    QStringList lines{own.isEmpty() ? thresholdText() : tr("%1 on noise").arg(thresholdText())};
    if (!own.isEmpty())
        lines << own;
    if (m_unit != Unit::Nats)
        lines << numberText(m_threshold, 2) + QLatin1Char(' ') + m_statisticUnit;
    return lines.join(QLatin1Char('\n'));
}

Span ExceedancePlot::natSpan() const
{
    return exceedanceSpan(m_calibration.get(), m_counts, m_threshold);
}

void ExceedancePlot::restyle()
{
    const Theme::Colours &colours = Theme::colours(*this);
    setAxisTitle(QwtAxis::XBottom, tr("Statistic D (%1)").arg(m_statisticUnit));
    setAxisTitle(QwtAxis::YLeft, isRate() ? tr("False alarms/h") : tr("P(D > T) per cell"));
    Theme::style(*this);
    m_grid->setPen(colours.grid, 1.0);
    QColor area = colours.faintText;
    area.setAlpha(60);
    m_histogram->setPen(QPen(Qt::NoPen));
    m_histogram->setBrush(area);
    m_simulated->setPen(colours.curves[0], 2.0);
    m_tail->setPen(colours.curves[0], 1.2, Qt::DashLine);
    m_closedForm->setPen(colours.curves[2], 1.4, Qt::DotLine);
    m_measured->setPen(colours.curves[1], 1.4);
    m_selection->setPen(colours.curves[3], 1.8);
    m_line->setLinePen(colours.threshold, 2.0);
    m_sentence->colour = colours.faintText;
    m_key->follow(colours);
    m_label->colour = colours.threshold;
    m_label->plate = m_key->plate;
    const bool isEmpty = !m_calibration;
    m_sentence->setVisible(isEmpty);
    m_grid->setVisible(!isEmpty);
    m_line->setVisible(!isEmpty);
    m_label->setVisible(!isEmpty);
    setAxisVisible(QwtAxis::XBottom, !isEmpty);
    setAxisVisible(QwtAxis::YLeft, !isEmpty);
    canvas()->setCursor(isEmpty ? Qt::ArrowCursor : Qt::SplitHCursor);
    updateCurves();
}

void ExceedancePlot::updateCurves()
{
    drawNoise();
    drawRecording();
    nameCurves();
    layAxes();
}

void ExceedancePlot::drawNoise()
{
    QPolygonF simulated, tail, closedForm, selection;
    if (m_calibration) {
        if (!isRate())
            simulated = simulatedCurve(*m_calibration);
        // The fitted law of events only holds in the tail.
        const double anchor = simulated.isEmpty() ? m_calibration->anchorNats : simulated.back().x();
        for (const double nats : {anchor, natSpan().high})
            tail << QPointF(nats, ordinate(nats));
        if (!isRate()) {
            closedForm = logarithmic(m_closedFormPoints);
            selection = logarithmic(m_selectionPoints);
        }
    }
    m_selection->setSamples(selection);
    m_simulated->setSamples(simulated);
    m_tail->setSamples(tail);
    m_closedForm->setSamples(closedForm);
}

void ExceedancePlot::drawRecording()
{
    m_measured->setSamples(m_calibration && !isRate() ? recordedCurve(m_counts) : QPolygonF());
    m_histogram->setBaseline(-0.3);
    m_histogram->setSamples(m_calibration ? recordedCells(m_counts, natSpan().high) : QList<QwtIntervalSample>());
}

void ExceedancePlot::nameCurves()
{
    m_key->entries.clear();
    const auto name = [this](QwtPlotCurve &curve, const QString &text) {
        curve.setTitle(text);
        if (curve.dataSize() > 0)
            m_key->entries.push_back({text, curve.pen()});
    };
    name(*m_simulated, tr("noise, simulated"));
    name(*m_tail, isRate() ? tr("noise, fitted law") : tr("exponential tail"));
    name(*m_closedForm, tr("closed form"));
    name(*m_measured, tr("this recording"));
    name(*m_selection, tr("the measured box"));
    m_histogram->setTitle(tr("recorded cells"));
    if (m_histogram->dataSize() > 0)
        m_key->entries.push_back({tr("recorded cells"), QPen(m_histogram->brush().color()), true});
}

void ExceedancePlot::layAxes()
{
    constexpr int enoughForAll = 150;   // pixels
    constexpr int enoughForTitle = 190; // of the whole plot; below, the label of the threshold names the unit
    setAxisTitle(QwtAxis::XBottom, height() < enoughForTitle ? QString() : tr("Statistic D (%1)").arg(m_statisticUnit));
    setAxisTitle(QwtAxis::YRight,
                 canvas()->height() < enoughForAll ? tr("Cells per bin") : tr("Cells per bin of width ¼"));
    const Span span = natSpan();
    const QSize size = canvas()->contentsRect().size();
    setAxisScaleDiv(QwtAxis::XBottom, linearScaleDiv(span, std::clamp(size.width() / 60, 2, 10)));
    Span exponents{-6.0, 0.0};
    if (m_calibration) {
        const double top = isRate() ? ordinate(m_calibration->anchorNats) : 0.0;
        exponents = {std::floor(ordinate(span.high)), std::ceil(top + 0.05)};
        exponents.low = std::clamp(exponents.low, exponents.high + smallestExponent, exponents.high - 2.0);
    }
    setAxisScaleDiv(QwtAxis::YLeft, decadeScaleDiv(exponents, std::clamp(size.height() / 26, 2, 8)));
    double most = 1.0;
    for (const double count : m_counts)
        most = std::max(most, count);
    setAxisScaleDiv(QwtAxis::YRight,
                    decadeScaleDiv({-0.3, std::log10(most) + 0.6}, std::clamp(size.height() / 26, 2, 6)));
    setAxisVisible(QwtAxis::YRight, m_calibration && most > 1.0);
    steadyAxes(*this, powerOfTenText(-10), QStringLiteral("00.0"));
    updateThresholdLine();
}

void ExceedancePlot::updateThresholdLine()
{
    m_line->setXValue(m_threshold);
    m_label->x = m_threshold;
    m_label->text = labelText();
    setAccessibleDescription(tr("Threshold at %1").arg(thresholdText()));
    replot();
}

void ExceedancePlot::dragTo(double canvasX)
{
    const Span span{axisScaleDiv(QwtAxis::XBottom).lowerBound(), axisScaleDiv(QwtAxis::XBottom).upperBound()};
    const double nats = std::clamp(invTransform(QwtAxis::XBottom, canvasX), span.low, span.high);
    setThreshold(std::round(nats * 100.0) / 100.0);
    emit thresholdRequested(m_threshold);
}

void ExceedancePlot::step(int quarterNats)
{
    setThreshold(m_threshold + quarterNats * countedNats);
    emit thresholdRequested(m_threshold);
    emit thresholdCommitted(m_threshold);
}

bool ExceedancePlot::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == canvas() && m_calibration) {
        const auto mouse = [event] { return static_cast<QMouseEvent *>(event); };
        if (event->type() == QEvent::MouseButtonPress && mouse()->button() == Qt::LeftButton) {
            setFocus(Qt::MouseFocusReason);
            m_isDragging = true;
            dragTo(mouse()->position().x());
            return true;
        }
        if (event->type() == QEvent::MouseMove && m_isDragging) {
            dragTo(mouse()->position().x());
            return true;
        }
        if (event->type() == QEvent::MouseButtonRelease && m_isDragging) {
            m_isDragging = false;
            updateCurves();
            emit thresholdCommitted(m_threshold);
            return true;
        }
    }
    return ThemedPlot::eventFilter(watched, event);
}

void ExceedancePlot::keyPressEvent(QKeyEvent *event)
{
    if (m_calibration && (event->key() == Qt::Key_Comma || event->key() == Qt::Key_Left))
        step(-1);
    else if (m_calibration && (event->key() == Qt::Key_Period || event->key() == Qt::Key_Right))
        step(1);
    else
        ThemedPlot::keyPressEvent(event);
}

void ExceedancePlot::contextMenuEvent(QContextMenuEvent *event)
{
    QMenu menu(this);
    auto *group = new QActionGroup(&menu);
    const std::pair<Unit, QString> rows[] = {
        {Unit::FalseAlarmsPerHour, tr("False alarms per hour")},
        {Unit::PfaPerCell, tr("False-alarm probability per cell")},
        {Unit::Nats, m_statisticUnit == QLatin1String("nat") ? tr("Nats") : tr("Statistic, %1").arg(m_statisticUnit)}};
    for (const auto &[unit, text] : rows) {
        QAction *action = group->addAction(menu.addAction(text));
        action->setCheckable(true);
        action->setChecked(unit == m_unit);
        connect(action, &QAction::triggered, this, [this, unit = unit] { emit unitRequested(unit); });
    }
    emit contextMenuRequested(&menu);
    menu.exec(event->globalPos());
}

} // namespace faintline

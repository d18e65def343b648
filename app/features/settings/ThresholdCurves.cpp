#include "app/features/settings/ThresholdCurves.h"

#include "app/document/AnalysisController.h"
#include "app/document/Document.h"
#include "app/document/statisticUnit.h"
#include "evaluate/theory/theory.h"
#include "widgets/plot/ExceedancePlot.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    QPolygonF polygonOf(const std::vector<ExceedancePoint> &points)
    {
        QPolygonF polygon;
        for (const ExceedancePoint &point : points)
            polygon << QPointF(point.level, point.probability);
        return polygon;
    }

    constexpr std::pair<ExceedancePlot::Unit, DecideSettings::By> units[]{
        {ExceedancePlot::Unit::Nats, DecideSettings::By::Nats},
        {ExceedancePlot::Unit::PfaPerCell, DecideSettings::By::PfaPerCell},
        {ExceedancePlot::Unit::FalseAlarmsPerHour, DecideSettings::By::FalseAlarmsPerHour}};

} // namespace

ThresholdCurves::ThresholdCurves(Document &document, AnalysisController &controller, ExceedancePlot &plot,
                                 QObject *parent)
    : QObject(parent), m_document(document), m_plot(plot)
{
    connect(&document, &Document::opened, this, [this] {
        m_plot.setHistogram({});
        m_plot.setCalibration({}, 0.0);
    });
    connect(&document, &Document::analysisChanged, this, [this] {
        showPlan();
        m_plot.setHistogram(m_document.analysis()->statisticCounts);
        showClosedForm();
        showSelection();
    });
    connect(&document, &Document::livePlanChanged, this, &ThresholdCurves::showPlan);
    connect(&document, &Document::opened, this, &ThresholdCurves::showUnit);
    connect(&document, &Document::settingsChanged, this, &ThresholdCurves::showUnit);
    connect(&document, &Document::shownThresholdChanged, this,
            [this] { m_plot.setThreshold(m_document.shownThreshold()); });
    connect(&document.viewport(), &Viewport::selectionChanged, this, &ThresholdCurves::showSelection);
    connect(&plot, &ExceedancePlot::thresholdRequested, &controller, &AnalysisController::previewThreshold);
    connect(&plot, &ExceedancePlot::thresholdCommitted, &controller, &AnalysisController::commitThreshold);
    connect(&plot, &ExceedancePlot::unitRequested, &controller, [&controller](ExceedancePlot::Unit unit) {
        controller.setThresholdUnit(
            std::ranges::find(units, unit, [](const auto &both) { return both.first; })->second);
    });
}

void ThresholdCurves::showPlan()
{
    const AnalysisPlan &plan = *m_document.plan();
    m_plot.setStatisticUnit(statisticUnit(plan.settings));
    m_plot.setCalibration(plan.calibration, plan.cellFramesPerHour);
}

/// That of the settings: a plan may be older.
void ThresholdCurves::showUnit()
{
    m_plot.setUnit(
        std::ranges::find(units, m_document.settings().decide.by, [](const auto &both) { return both.second; })->first);
}

void ThresholdCurves::showClosedForm()
{
    const Analysis &analysis = *m_document.analysis();
    m_plot.setClosedForm(analysis.recording ? polygonOf(closedFormExceedance(analysis.settings, *analysis.calibration))
                                            : QPolygonF());
}

void ThresholdCurves::showSelection()
{
    const auto &analysis = m_document.analysis();
    const auto box = m_document.box();
    if (!analysis || !box)
        return m_plot.setSelectionExceedance({});
    const Axis &time = analysis->time();
    const Axis &frequency = analysis->grid().axes.front();
    const auto first = [](const Axis &axis, double value) { return Index(std::ceil(axis.position(value))); };
    m_plot.setSelectionExceedance(
        polygonOf(boxExceedance(*analysis->statistic, first(time, box->time.low), first(time, box->time.high),
                                first(frequency, box->frequency.low), first(frequency, box->frequency.high))));
}

} // namespace faintline

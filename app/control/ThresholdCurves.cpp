#include "app/control/ThresholdCurves.h"

#include "app/document/Document.h"
#include "evaluate/theory/closedForm.h"
#include "widgets/plot/ExceedancePlot.h"

#include <cmath>

namespace faintline {

namespace {

    QPolygonF polygonOf(const std::vector<ExceedancePoint> &points)
    {
        QPolygonF polygon;
        for (const ExceedancePoint &point : points)
            polygon << QPointF(point.level, point.probability);
        return polygon;
    }

} // namespace

ThresholdCurves::ThresholdCurves(Document &document, ExceedancePlot &plot, QObject *parent)
    : QObject(parent), m_document(document), m_plot(plot)
{
    connect(&document, &Document::analysisChanged, this, &ThresholdCurves::showClosedForm);
    connect(&document, &Document::analysisChanged, this, &ThresholdCurves::showSelection);
    connect(&document.viewport(), &Viewport::selectionChanged, this, &ThresholdCurves::showSelection);
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

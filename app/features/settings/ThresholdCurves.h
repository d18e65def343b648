#pragma once

#include <QObject>

namespace faintline {

class AnalysisController;
class Document;
class ExceedancePlot;

/// Shows the document's threshold, its statistic and its calibration in a plot, with the closed form for noise, if there
/// is one, and the exceedance in the measured box of this recording, which should be a stretch of noise; and takes what
/// is dragged there.
class ThresholdCurves : public QObject
{
    Q_OBJECT

public:
    ThresholdCurves(Document &document, AnalysisController &controller, ExceedancePlot &plot,
                    QObject *parent = nullptr);

private:
    void showPlan();
    void showUnit();
    void showClosedForm();
    void showSelection();

    Document &m_document;
    ExceedancePlot &m_plot;
};

} // namespace faintline

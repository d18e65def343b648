#pragma once

#include <QObject>

namespace faintline {

class Document;
class ExceedancePlot;

/// Supplies the threshold's plot with the closed form for noise, if there is one, and with the exceedance in the
/// measured box of this recording, which should be a stretch of noise.
class ThresholdCurves : public QObject
{
    Q_OBJECT

public:
    ThresholdCurves(Document &document, ExceedancePlot &plot, QObject *parent = nullptr);

private:
    void showClosedForm();
    void showSelection();

    Document &m_document;
    ExceedancePlot &m_plot;
};

} // namespace faintline

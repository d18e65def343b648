#pragma once

#include <QObject>

namespace faintline {

class Document;
class ExceedancePlot;

/// Feeds the threshold's plot with what noise does by theory, where there is one, and in the box that is measured in
/// this recording: a stretch of noise, if whoever draws it chooses well.
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

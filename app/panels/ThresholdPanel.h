#pragma once

#include <QWidget>

class QLabel;
class QPushButton;

namespace faintline {

class AnalysisController;
class ExceedancePlot;
class RecordingCheck;

/// The threshold's plot. If the recording's noise is not the noise of the calibration, a sentence below offers a
/// button: first to count the false alarms on such noise, then to correct the threshold.
class ThresholdPanel : public QWidget
{
    Q_OBJECT

public:
    ThresholdPanel(ExceedancePlot &plot, AnalysisController &controller, RecordingCheck &check,
                   QWidget *parent = nullptr);

private:
    void refresh();
    void say(const QString &sentence, const QString &cure = {});
    void cure();

    ExceedancePlot &m_plot;
    AnalysisController &m_controller;
    RecordingCheck &m_check;
    QWidget *m_row;
    QLabel *m_sentence;
    QPushButton *m_cure;
};

} // namespace faintline

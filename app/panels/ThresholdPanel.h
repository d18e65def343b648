#pragma once

#include <QWidget>

class QLabel;
class QPushButton;

namespace faintline {

class AnalysisController;
class ExceedancePlot;
class RecordingCheck;

/// The threshold's plot, and below it, where the recording's noise is not what the threshold was calibrated for, a
/// sentence with the button that helps: first to count the false alarms on noise like this, then to correct the
/// threshold.
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

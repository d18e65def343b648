#pragma once

#include <QWidget>

class QLabel;
class QPushButton;

namespace faintline {

class AnalysisController;
class ExceedancePlot;
class MainSettings;
class RecordingCheck;

/// The threshold's plot, and the main settings while the pipeline's form is not visible. If the recording's noise is
/// not the noise of the calibration, a sentence below offers a button: first to count the false alarms on such noise,
/// then to correct the threshold.
class ThresholdPanel : public QWidget
{
    Q_OBJECT

public:
    ThresholdPanel(ExceedancePlot &plot, MainSettings &main, AnalysisController &controller, RecordingCheck &check,
                   QWidget *parent = nullptr);

    /// The main settings are shown if there is room for them.
    void setMainSettingsWanted(bool areWanted);

    QSize minimumSizeHint() const override;

protected:
    void resizeEvent(QResizeEvent *event) override;

private:
    void showWhatFits();
    void refresh();
    void say(const QString &sentence, const QString &cure = {});
    void cure();

    ExceedancePlot &m_plot;
    MainSettings &m_main;
    bool m_areMainWanted = true; ///< until the form is seen
    AnalysisController &m_controller;
    RecordingCheck &m_check;
    QWidget *m_row;
    QLabel *m_sentence;
    QPushButton *m_cure;
};

} // namespace faintline

#pragma once

#include "inspect/surrogates.h"

#include <QWidget>

class QLabel;
class QProgressBar;
class QPushButton;

namespace faintline {

class AnalysisController;
class Document;
class RecordingCheck;

/// Checks whether the threshold gives the specified rate of false alarms in the open recording.
///
/// Shows a sentence if the recording's noise is not the noise of the calibration, and each advice on the settings.
/// "Count on noise like this recording's" gives the number of false alarms per specified one, and offers a button that
/// corrects the threshold accordingly; the count can be stopped.
class NoiseCheck : public QWidget
{
    Q_OBJECT

public:
    NoiseCheck(const Document &document, AnalysisController &controller, RecordingCheck &check,
               QWidget *parent = nullptr);

    /// Starts or stops counting.
    void toggle();
    /// Shows the result of a count and offers the correction.
    void show(const SurrogateCount &count);
    using QWidget::show;

private:
    void refresh();
    void showWarning();
    void showCount();
    void showProgress();

    const Document &m_document;
    AnalysisController &m_controller;
    RecordingCheck &m_check;
    QLabel *m_warning;
    QPushButton *m_button;
    QProgressBar *m_progress;
    QLabel *m_result;
    QPushButton *m_correct;
};

} // namespace faintline

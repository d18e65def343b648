#pragma once

#include "analysis/surrogates.h"

#include <QWidget>

class QLabel;
class QProgressBar;
class QPushButton;

namespace faintline {

class AnalysisController;
class Document;
class RecordingCheck;

/// Whether the threshold gives the specified rate of false alarms in the recording that is open.
///
/// A sentence stands here where the recording's noise is not what the threshold was calibrated for, and each advice on
/// the settings. "Count on noise like this recording's" says how many false alarms came for one ordered, and moves the
/// threshold by a click so that as many come as were ordered; the count can be stopped.
class NoiseCheck : public QWidget
{
    Q_OBJECT

public:
    NoiseCheck(const Document &document, AnalysisController &controller, RecordingCheck &check,
               QWidget *parent = nullptr);

    bool isBusy() const;

    /// Counts, or stops counting.
    void toggle();
    /// Says what a count came to, and offers the correction.
    void show(const SurrogateCount &count);
    using QWidget::show;

signals:
    /// Nothing is being counted or looked at any more.
    void settled();

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

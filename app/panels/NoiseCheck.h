#pragma once

#include "analysis/surrogates.h"
#include "app/base/JobRunner.h"

#include <QWidget>

#include <optional>

class QLabel;
class QProgressBar;
class QPushButton;

namespace faintline {

class AnalysisController;
class Document;

/// Whether the threshold keeps its promise in the recording that is open.
///
/// After each analysis the noise outside its tracks is looked at (`checkNoiseLaw`), and a sentence stands here where it
/// is not what the threshold was calibrated for. "Count on noise like this recording's" sends surrogates of the
/// recording through the whole chain (`countOnSurrogates`), says how many false alarms came for one ordered, and moves
/// the threshold by a click so that as many come as were ordered. Both run behind the window; the count can be stopped.
class NoiseCheck : public QWidget
{
    Q_OBJECT

public:
    NoiseCheck(const Document &document, AnalysisController &controller, QWidget *parent = nullptr);

    bool isBusy() const { return m_runner.isRunning() || m_lawRunner.isRunning(); }

    /// Counts, or stops counting.
    void toggle();
    /// Says what a count came to, and offers the correction.
    void show(const SurrogateCount &count);
    using QWidget::show;

signals:
    /// Nothing is being counted or looked at any more.
    void settled();

private:
    void follow();
    void lookAtTheLaw();
    void count();
    void correct();
    void end();

    const Document &m_document;
    AnalysisController &m_controller;
    QLabel *m_warning;
    QPushButton *m_button;
    QProgressBar *m_progress;
    QLabel *m_result;
    QPushButton *m_correct;
    double m_correctedNats = 0.0;
    JobRunner m_lawRunner;
    JobRunner m_runner; ///< last, so that its jobs end first
};

} // namespace faintline

#pragma once

#include "app/base/JobRunner.h"
#include "inspect/learnMotion.h"

#include <QDialog>

#include <optional>

class QLabel;
class QProgressBar;
class QPushButton;

namespace faintline {

class AnalysisController;

/// The law of motion learned from an analysis' own tracks (`learnMotion`), compared with the present one, and its gain;
/// applied only on request.
class LearnMotionDialog : public QDialog
{
    Q_OBJECT

public:
    LearnMotionDialog(std::shared_ptr<const Analysis> analysis, AnalysisController &controller,
                      QWidget *parent = nullptr);

    bool isBusy() const { return m_runner.isRunning(); }

signals:
    /// The law is available, or the reason why there is none.
    void settled();

private:
    void show(const LearnedMotion &motion);
    void apply();

    std::shared_ptr<const Analysis> m_analysis;
    AnalysisController &m_controller;
    std::optional<LearnedMotion> m_motion;
    QLabel *m_words;
    QProgressBar *m_progress;
    QPushButton *m_apply;
    JobRunner m_runner; ///< last, so that its job ends first
};

} // namespace faintline

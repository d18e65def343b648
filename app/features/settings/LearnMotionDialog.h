#pragma once

#include "app/base/Inquiry.h"
#include "inspect/learnMotion.h"

#include <QDialog>

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

private:
    void show(const LearnedMotion *motion);
    void apply();

    std::shared_ptr<const Analysis> m_analysis;
    AnalysisController &m_controller;
    QLabel *m_words;
    QProgressBar *m_progress;
    QPushButton *m_apply;
    Inquiry<LearnedMotion, std::shared_ptr<const Analysis>> m_motion;
};

} // namespace faintline

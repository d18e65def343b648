#pragma once

#include "app/base/JobRunner.h"
#include "app/features/evaluate/Experiments.h"
#include "evaluate/experiments/showTrial.h"

#include <QObject>

#include <memory>

class QWidget;

namespace faintline {

class TrialWindow;

/// Shows the trials behind a point of a curve: computes one again on a worker and opens it in a separate window.
class TrialViewer : public QObject
{
    Q_OBJECT

public:
    TrialViewer(const Experiments &experiments, QWidget *window);
    ~TrialViewer() override;

    /// Opens the first trial behind that point; a repeated call for the same point opens the next.
    void open(int experiment, std::size_t detector, std::size_t snr);
    JobRunner &runner() { return m_runner; }
    TrialWindow *window() const { return m_window.get(); } ///< null until a trial has been opened

signals:
    void shown();
    void failed(const faintline::Error &error);

private:
    void step(int trials, bool onlyMissed);
    void start();
    void show(const ShownTrial &trial);

    const Experiments &m_experiments;
    QWidget *m_parent;
    std::unique_ptr<TrialWindow> m_window;
    int m_experiment = 0;
    std::size_t m_detector = 0;
    std::size_t m_snr = 0;
    std::ptrdiff_t m_trial = 0;
    JobRunner m_runner{this}; ///< last, so that its jobs end first
};

} // namespace faintline

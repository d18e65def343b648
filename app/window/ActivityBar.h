#pragma once

#include <QTimer>
#include <QWidget>

class QLabel;
class QProgressBar;

namespace faintline {

class JobRunner;

/// Name and progress of the running computation, and a button to cancel it. Visible only if it takes longer than 0.2 s.
class ActivityBar : public QWidget
{
    Q_OBJECT

public:
    explicit ActivityBar(QWidget *parent = nullptr);

    /// Shows its jobs, and lets them be cancelled.
    void follow(JobRunner &runner);

signals:
    void cancelRequested();

private:
    void setBusy(bool isBusy);

    QLabel *m_what;
    QProgressBar *m_progress;
    QTimer m_delay;
};

} // namespace faintline

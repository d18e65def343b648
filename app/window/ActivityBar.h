#pragma once

#include <QTimer>
#include <QWidget>

class QLabel;
class QProgressBar;

namespace faintline {

/// Name and progress of the running computation, and a button to cancel it. Visible only if it takes longer than 0.2 s.
class ActivityBar : public QWidget
{
    Q_OBJECT

public:
    explicit ActivityBar(QWidget *parent = nullptr);

public slots:
    void setBusy(bool isBusy);
    void setProgress(double fraction, const QString &what);

signals:
    void cancelRequested();

private:
    QLabel *m_what;
    QProgressBar *m_progress;
    QTimer m_delay;
};

} // namespace faintline

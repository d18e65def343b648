#pragma once

#include <QTimer>
#include <QWidget>

class QLabel;
class QProgressBar;

namespace faintline {

/// What is being computed, how far it is, and a button to stop it. Seen only where it takes longer than 0.2 s.
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

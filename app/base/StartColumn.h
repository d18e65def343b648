#pragma once

#include <QWidget>

class QLabel;
class QProgressBar;
class QPushButton;
class QVBoxLayout;

namespace faintline {

/// The left column of a panel that runs experiments or tests: the form, buttons to start and cancel, and progress.
class StartColumn : public QWidget
{
    Q_OBJECT

public:
    StartColumn(QWidget *form, const QString &progressName, const QString &startToolTip, const QString &start = {});

    /// Below those that start and cancel.
    void addButton(QPushButton *button);
    void setStartable(bool isStartable);
    void setCancellable(bool isCancellable);
    void showProgress(double fraction, const QString &words);
    /// Above the form, of what is shown beside it; nothing hides it.
    void setNote(const QString &words);
    void clearState(); ///< nothing is shown

signals:
    void startRequested();
    void cancelRequested();

private:
    QPushButton *m_start;
    QPushButton *m_cancel;
    QVBoxLayout *m_status;
    QProgressBar *m_progress;
    QLabel *m_state;
    QLabel *m_note;
};

} // namespace faintline

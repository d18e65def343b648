#pragma once

#include "app/control/Experiments.h"

#include <QWidget>

#include <optional>

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
    void showState(const Experiments::Entry &entry);
    /// Says what is shown if it is not what the form would start. `ofForm`: nothing if the form is incomplete.
    void compare(const Experiments::Entry &shown, const std::optional<Experiment> &ofForm);
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

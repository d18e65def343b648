#pragma once

#include "evaluate/sequential/ScanTest.h"
#include "widgets/forms/FieldForm.h"

class QLabel;
class QProgressBar;
class QPushButton;

namespace faintline {

class SequentialTests;

/// The column that starts sequential tests: the form of a test's settings, the buttons that start and cancel tests, on
/// radar scans or on the visible part of the recording, and their progress.
class SequentialControls : public QWidget
{
    Q_OBJECT

public:
    explicit SequentialControls(SequentialTests &tests, QWidget *parent = nullptr);

    FieldForm<ScanTest> &form() { return *m_form; }
    /// Whether a test can run on the visible part of the recording.
    void setOnSelectionEnabled(bool isEnabled);

signals:
    void runRequested();         ///< on radar scans, with the form's settings
    void onSelectionRequested(); ///< on the visible part

private:
    void showBusy(bool isBusy);

    SequentialTests &m_tests;
    FieldForm<ScanTest> *m_form;
    QPushButton *m_cancel;
    QPushButton *m_onSelection;
    QProgressBar *m_progress;
    QLabel *m_state;
};

} // namespace faintline

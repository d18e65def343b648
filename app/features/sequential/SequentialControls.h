#pragma once

#include "app/base/StartColumn.h"
#include "evaluate/sequential/ScanTest.h"
#include "widgets/forms/FieldForm.h"

namespace faintline {

class SequentialTests;

/// The column that starts sequential tests, on radar scans or on the visible part of the recording: the form is that of
/// a test's settings.
class SequentialControls : public StartColumn
{
    Q_OBJECT

public:
    explicit SequentialControls(SequentialTests &tests);

    FieldForm<ScanTest> &form() { return *m_form; }
    /// Whether a test can run on the visible part of the recording.
    void setOnSelectionEnabled(bool isEnabled);

signals:
    void onSelectionRequested(); ///< on the visible part

private:
    SequentialControls(SequentialTests &tests, FieldForm<ScanTest> *form);
    void showBusy(bool isBusy);

    SequentialTests &m_tests;
    FieldForm<ScanTest> *m_form;
    QPushButton *m_onSelection;
};

} // namespace faintline

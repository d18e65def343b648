#include "app/features/sequential/SequentialControls.h"

#include "app/features/sequential/SequentialTests.h"

#include <QPushButton>

namespace faintline {

SequentialControls::SequentialControls(SequentialTests &tests)
    : SequentialControls(tests, new FieldForm<ScanTest>(tr("Test")))
{
}

SequentialControls::SequentialControls(SequentialTests &tests, FieldForm<ScanTest> *form)
    : StartColumn(form, tr("Progress of the sequential tests"),
                  tr("Run tests on simulated radar scans with these settings, in the background"), tr("Run")),
      m_tests(tests), m_form(form), m_onSelection(new QPushButton(tr("Test the visible part")))
{
    constexpr int width = 290; // pixels
    setFixedWidth(width);
    m_form->setAccessibleName(tr("Settings of the sequential test"));
    m_onSelection->setToolTip(tr("Run one test on the visible frames and frequencies, with α, β and the cut-off from "
                                 "above and the signal model of the pipeline"));
    addButton(m_onSelection);
    connect(this, &StartColumn::cancelRequested, &m_tests, &SequentialTests::cancel);
    connect(m_onSelection, &QPushButton::clicked, this, &SequentialControls::onSelectionRequested);
    connect(&m_tests, &SequentialTests::restarted, this, [this] { showBusy(m_tests.isRunning()); });
    connect(&m_tests, &SequentialTests::busyChanged, this, &SequentialControls::showBusy);
    connect(&m_tests, &SequentialTests::progressed, this, &SequentialControls::showProgress);
    showBusy(m_tests.isRunning());
}

void SequentialControls::setOnSelectionEnabled(bool isEnabled)
{
    m_onSelection->setEnabled(isEnabled);
}

void SequentialControls::showBusy(bool isBusy)
{
    setCancellable(isBusy);
    const bool isDone = m_tests.isFixedSizeKnown() || (!m_tests.isOfScans() && !m_tests.isEmpty());
    if (isBusy)
        showProgress(0.0, tr("starting"));
    else if (isDone)
        showProgress(1.0, m_tests.isEmpty() ? QString() : tr("done"));
    else
        showProgress(0.0, m_tests.isEmpty() ? QString() : tr("Stopped; results incomplete"));
}

} // namespace faintline

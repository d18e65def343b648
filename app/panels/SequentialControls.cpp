#include "app/panels/SequentialControls.h"

#include "app/control/SequentialTests.h"
#include "widgets/base/labelText.h"

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

namespace faintline {

SequentialControls::SequentialControls(SequentialTests &tests, QWidget *parent)
    : QWidget(parent), m_tests(tests), m_form(new FieldForm<ScanTest>(tr("Test"))),
      m_cancel(new QPushButton(tr("Cancel"))), m_onSelection(new QPushButton(tr("Test the visible part"))),
      m_progress(new QProgressBar), m_state(new QLabel)
{
    m_form->setAccessibleName(tr("Settings of the sequential test"));
    m_progress->setRange(0, 1000);
    m_progress->setTextVisible(false);
    m_progress->setFixedHeight(8);
    m_progress->setAccessibleName(tr("Progress of the sequential tests"));
    m_state->setTextFormat(Qt::PlainText);
    m_state->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    auto *start = new QPushButton(tr("Run"));
    start->setToolTip(tr("Run tests on simulated radar scans with these settings, in the background"));
    m_onSelection->setToolTip(tr("Run one test on the visible frames and frequencies, with α, β and the cut-off from "
                                 "above and the signal model of the pipeline"));
    connect(start, &QPushButton::clicked, this, &SequentialControls::runRequested);
    connect(m_cancel, &QPushButton::clicked, &m_tests, &SequentialTests::cancel);
    connect(m_onSelection, &QPushButton::clicked, this, &SequentialControls::onSelectionRequested);

    setFixedWidth(290);
    auto *buttons = new QHBoxLayout;
    buttons->setSpacing(6);
    buttons->addWidget(start, 1);
    buttons->addWidget(m_cancel, 1);
    auto *below = new QVBoxLayout;
    below->setContentsMargins(8, 2, 8, 4);
    below->setSpacing(3);
    below->addLayout(buttons);
    below->addWidget(m_onSelection);
    below->addWidget(m_progress);
    below->addWidget(m_state);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(scrolledColumn(m_form), 1);
    layout->addLayout(below);

    connect(&m_tests, &SequentialTests::restarted, this, [this] { showBusy(m_tests.isRunning()); });
    connect(&m_tests, &SequentialTests::busyChanged, this, &SequentialControls::showBusy);
    connect(&m_tests, &SequentialTests::progressed, this, [this](double fraction, const QString &what) {
        m_progress->setValue(int(1000.0 * fraction));
        m_state->setText(what);
    });
    showBusy(m_tests.isRunning());
}

void SequentialControls::setOnSelectionEnabled(bool isEnabled)
{
    m_onSelection->setEnabled(isEnabled);
}

void SequentialControls::showBusy(bool isBusy)
{
    m_cancel->setEnabled(isBusy);
    if (isBusy) {
        m_state->setText(tr("starting"));
        return m_progress->setValue(0);
    }
    m_progress->setValue(m_tests.isFixedSizeKnown() || (!m_tests.isOfScans() && !m_tests.isEmpty()) ? 1000 : 0);
    m_state->setText(m_tests.isEmpty()             ? QString()
                     : m_progress->value() == 1000 ? tr("done")
                                                   : tr("Stopped; results "
                                                        "incomplete"));
}

} // namespace faintline

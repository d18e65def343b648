#include "app/window/ActivityBar.h"

#include "app/base/JobRunner.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>

namespace faintline {

ActivityBar::ActivityBar(QWidget *parent) : QWidget(parent), m_what(new QLabel), m_progress(new QProgressBar)
{
    constexpr int steps = 1000;
    m_progress->setRange(0, steps);
    m_progress->setTextVisible(false);
    m_progress->setFixedSize(160, 12);
    m_progress->setAccessibleName(tr("Progress"));
    auto *cancel = new QToolButton;
    cancel->setText(tr("Cancel"));
    cancel->setAutoRaise(true);
    cancel->setToolTip(tr("Stop computing and keep what is shown (Escape)"));
    connect(cancel, &QToolButton::clicked, this, &ActivityBar::cancelRequested);

    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(m_what);
    layout->addWidget(m_progress);
    layout->addWidget(cancel);

    m_delay.setSingleShot(true);
    m_delay.setInterval(200);
    connect(&m_delay, &QTimer::timeout, this, &QWidget::show);
    hide();
}

void ActivityBar::setBusy(bool isBusy)
{
    if (!isBusy) {
        m_delay.stop();
        hide();
        m_progress->setValue(0);
        m_what->clear();
    } else if (isHidden() && !m_delay.isActive()) {
        m_delay.start();
    }
}

void ActivityBar::follow(JobRunner &runner)
{
    connect(&runner, &JobRunner::busyChanged, this, &ActivityBar::setBusy);
    connect(&runner, &JobRunner::progressed, this, [this](double fraction, const QString &what) {
        m_what->setText(what);
        m_progress->setValue(int(fraction * m_progress->maximum()));
    });
    connect(this, &ActivityBar::cancelRequested, &runner, &JobRunner::cancel);
}

} // namespace faintline

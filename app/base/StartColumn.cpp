#include "app/base/StartColumn.h"

#include "widgets/base/labelText.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>

#include <algorithm>

namespace faintline {

StartColumn::StartColumn(QWidget *form, const QString &progressName, const QString &startToolTip, const QString &start)
    : m_start(new QPushButton(start.isEmpty() ? tr("Start") : start)), m_cancel(new QPushButton(tr("Cancel"))),
      m_status(new QVBoxLayout), m_progress(new QProgressBar), m_state(new QLabel), m_note(plainLabel())
{
    constexpr int usualWidth = 330;
    QScrollArea *area = scrolledColumn(form);
    setFixedWidth(
        std::max(usualWidth, form->minimumSizeHint().width() + area->verticalScrollBar()->sizeHint().width()));
    m_progress->setRange(0, 1000);
    m_progress->setTextVisible(false);
    m_progress->setFixedHeight(8);
    m_progress->setAccessibleName(progressName);
    m_state->setTextFormat(Qt::PlainText);
    m_state->setWordWrap(true);
    m_state->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_note->setWordWrap(true);
    m_note->setAccessibleName(tr("What is shown"));
    m_note->setContentsMargins(8, 6, 8, 2);
    m_note->hide();
    m_cancel->setEnabled(false);
    m_start->setToolTip(startToolTip);

    auto *buttons = new QHBoxLayout;
    buttons->setContentsMargins(8, 2, 8, 0);
    buttons->setSpacing(6);
    buttons->addWidget(m_start, 1);
    buttons->addWidget(m_cancel, 1);
    m_status->setContentsMargins(8, 2, 8, 4);
    m_status->setSpacing(2);
    m_status->addWidget(m_progress);
    m_status->addWidget(m_state);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_note);
    layout->addWidget(area, 1);
    layout->addLayout(buttons);
    layout->addLayout(m_status);

    connect(m_start, &QPushButton::clicked, this, &StartColumn::startRequested);
    connect(m_cancel, &QPushButton::clicked, this, &StartColumn::cancelRequested);
}

void StartColumn::setStartable(bool isStartable)
{
    m_start->setEnabled(isStartable);
}

void StartColumn::addButton(QPushButton *button)
{
    m_status->insertWidget(0, button);
}

void StartColumn::setCancellable(bool isCancellable)
{
    m_cancel->setEnabled(isCancellable);
}

void StartColumn::showProgress(double fraction, const QString &words)
{
    m_progress->setValue(int(1000.0 * fraction));
    m_state->setText(words);
}

void StartColumn::clearState()
{
    showProgress(0.0, {});
    setNote({});
    setCancellable(false);
}

void StartColumn::setNote(const QString &words)
{
    m_note->setText(words);
    m_note->setVisible(!words.isEmpty());
}

} // namespace faintline

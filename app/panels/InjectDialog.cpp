#include "app/panels/InjectDialog.h"

#include "base/Error.h"
#include "widgets/base/Span.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"

#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    QDoubleSpinBox *number(double value, const Span &range, double step, int decimals, const QString &suffix)
    {
        auto *box = new QDoubleSpinBox;
        box->setRange(range.low, range.high);
        box->setDecimals(decimals);
        box->setSingleStep(step);
        box->setValue(value);
        box->setSuffix(suffix);
        return box;
    }

} // namespace

InjectDialog::InjectDialog(const RecordingInfo &recording, double startSeconds, double frequencyHz,
                           double windowSeconds, QWidget *parent)
    : QDialog(parent), m_recording(recording), m_windowSeconds(windowSeconds), m_why(plainLabel()),
      m_buttons(new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel))
{
    setWindowTitle(tr("Inject a line"));
    const double length = recording.durationSeconds();
    const double cell = 1.0 / windowSeconds;
    const double band = recording.sampleRateHz;
    m_snr = number(0.0, {-60, 120}, 1, 1, tr(" dB"));
    m_start = number(std::clamp(startSeconds, 0.0, length), {0, length}, 1, 2, tr(" s"));
    m_duration = number(std::min(100.0 * windowSeconds, length - m_start->value()), {0, length}, 1, 2, tr(" s"));
    m_frequency = number(frequencyHz, {recording.centreHz - band, recording.centreHz + band}, cell, 2, tr(" Hz"));
    m_drift = number(0.0, {-1e6, 1e6}, 0.1 * cell * cell, 3, tr(" Hz/s"));
    m_wander = number(0.0, {0, 1e6}, cell, 2, tr(" Hz"));
    m_wanderTime = number(15.0 * windowSeconds, {1e-3, 1e6}, windowSeconds, 2, tr(" s"));
    m_snr->setToolTip(tr("Power over the local noise power, in one window of %1 s").arg(windowSeconds, 0, 'g', 3));
    m_duration->setToolTip(tr("0 extends the line to the end of the recording"));

    auto *form = new QFormLayout;
    form->addRow(tr("&SNR"), m_snr);
    form->addRow(tr("S&tart"), m_start);
    form->addRow(tr("D&uration"), m_duration);
    form->addRow(tr("&Frequency at the start"), m_frequency);
    form->addRow(tr("&Drift"), m_drift);
    form->addRow(tr("&Wander"), m_wander);
    form->addRow(tr("Wander's correlation ti&me"), m_wanderTime);
    m_why->setWordWrap(true);
    m_why->setMinimumWidth(330);
    QPalette red = m_why->palette();
    red.setColor(QPalette::WindowText, Theme::colours(*this).error);
    m_why->setPalette(red);
    m_buttons->button(QDialogButtonBox::Ok)->setText(tr("Inject"));
    auto *layout = new QVBoxLayout(this);
    layout->addLayout(form);
    layout->addWidget(m_why);
    layout->addWidget(m_buttons);

    for (QDoubleSpinBox *box : {m_snr, m_start, m_duration, m_frequency, m_drift, m_wander, m_wanderTime})
        connect(box, &QDoubleSpinBox::valueChanged, this, &InjectDialog::check);
    connect(m_buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(m_buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    check();
}

LineSettings InjectDialog::line() const
{
    LineSettings line;
    line.snrDb = m_snr->value();
    line.referenceSeconds = m_windowSeconds;
    line.startSeconds = m_start->value();
    line.durationSeconds = m_duration->value();
    line.frequencyHz = m_frequency->value();
    line.driftHzPerSecond = m_drift->value();
    line.wanderHz = m_wander->value();
    line.wanderSeconds = m_wanderTime->value();
    return line;
}

void InjectDialog::check()
{
    QString why;
    try {
        checkLine(line(), m_recording, "line");
    } catch (const Error &error) {
        why = messageText(error.what());
    }
    m_why->setText(why);
    m_buttons->button(QDialogButtonBox::Ok)->setEnabled(why.isEmpty());
}

} // namespace faintline

#include "app/features/evaluate/InjectDialog.h"

#include "base/Error.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// As many digits as a cell needs.
    double rounded(double value, double cell)
    {
        const double scale = std::pow(10.0, std::ceil(2.0 - std::log10(cell)));
        return std::round(value * scale) / scale;
    }

    LineSettings initialLine(const RecordingInfo &recording, double startSeconds, double frequencyHz,
                             double windowSeconds)
    {
        constexpr double longestWindows = 100.0;
        constexpr double wanderWindows = 15.0;
        const double length = recording.durationSeconds();
        LineSettings line;
        line.snrDb = 0.0;
        line.referenceSeconds = windowSeconds;
        line.startSeconds = std::clamp(rounded(startSeconds, windowSeconds), 0.0, length);
        line.durationSeconds = std::min(longestWindows * windowSeconds, length - line.startSeconds);
        line.frequencyHz = rounded(frequencyHz, 1.0 / windowSeconds);
        line.driftHzPerSecond = line.wanderHz = 0.0;
        line.wanderSeconds = wanderWindows * windowSeconds;
        return line;
    }

} // namespace

InjectDialog::InjectDialog(const RecordingInfo &recording, double startSeconds, double frequencyHz,
                           double windowSeconds, QWidget *parent)
    : QDialog(parent), m_recording(recording),
      m_line(new FieldForm<LineSettings>(
          tr("Line"),
          withMainFields(LineSettings::fields(), {"snrDb", "startSeconds", "durationSeconds", "frequencyHz",
                                                  "driftHzPerSecond", "wanderHz", "wanderSeconds"}),
          initialLine(recording, startSeconds, frequencyHz, windowSeconds))),
      m_why(plainLabel()), m_buttons(new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel))
{
    setWindowTitle(tr("Inject a line"));
    m_why->setWordWrap(true);
    m_why->setMinimumWidth(330);
    QPalette red = m_why->palette();
    red.setColor(QPalette::WindowText, Theme::colours(*this).error);
    m_why->setPalette(red);
    m_buttons->button(QDialogButtonBox::Ok)->setText(tr("Inject"));
    auto *layout = new QVBoxLayout(this);
    layout->addWidget(m_line);
    layout->addWidget(m_why);
    layout->addWidget(m_buttons);

    connect(m_line, &FieldFormBase::edited, this, &InjectDialog::check);
    connect(m_buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(m_buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    check();
}

void InjectDialog::check()
{
    QString why = m_line->isRefused() ? tr("Correct the marked value.") : QString();
    try {
        checkLine(line(), m_recording, "line");
    } catch (const Error &error) {
        why = messageText(error.what());
    }
    m_why->setText(why);
    m_buttons->button(QDialogButtonBox::Ok)->setEnabled(why.isEmpty());
}

} // namespace faintline

#include "app/panels/ThresholdPanel.h"

#include "app/control/AnalysisController.h"
#include "app/control/RecordingCheck.h"
#include "app/document/statisticUnit.h"
#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"
#include "widgets/plot/ExceedancePlot.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace faintline {

ThresholdPanel::ThresholdPanel(ExceedancePlot &plot, AnalysisController &controller, RecordingCheck &check,
                               QWidget *parent)
    : QWidget(parent), m_plot(plot), m_controller(controller), m_check(check), m_row(new QWidget),
      m_sentence(new QLabel), m_cure(new QPushButton)
{
    m_sentence->setObjectName(QStringLiteral("ownNoise"));
    m_sentence->setFont(Theme::font(12));
    m_sentence->setWordWrap(true);
    m_cure->setObjectName(QStringLiteral("cureOwnNoise"));
    m_cure->setAccessibleName(tr("Fit the threshold to this noise"));
    auto *line = new QHBoxLayout(m_row);
    line->setContentsMargins(8, 2, 8, 4);
    line->addWidget(m_sentence, 1);
    line->addWidget(m_cure);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(&plot, 1);
    layout->addWidget(m_row);
    connect(m_cure, &QPushButton::clicked, this, &ThresholdPanel::cure);
    connect(&check, &RecordingCheck::changed, this, &ThresholdPanel::refresh);
    refresh();
}

void ThresholdPanel::refresh()
{
    const bool isOff = m_check.law() && !m_check.law()->isFollowed();
    const QString words = !isOff ? QString() : m_check.law()->isMore() ? tr("more") : tr("fewer");
    const auto &count = m_check.count();
    m_plot.setOwnNoise({count ? std::optional(count->ratio) : std::nullopt, words});
    if (m_check.isCounting())
        return say(tr("Counting false alarms on noise like this recording's …"), tr("Stop"));
    if (const auto corrected = m_check.corrected())
        return say(tr("This noise gives %1 times the specified false alarms.").arg(powerText(count->ratio)),
                   tr("Set to %1 %2").arg(numberText(corrected->decide.thresholdNats, 2), statisticUnit(*corrected)));
    if (isOff && !count)
        return say(m_check.law()->isMore() ? tr("Expect more false alarms on this noise.")
                                           : tr("Expect fewer false alarms on this noise."),
                   tr("Count them"));
    m_row->hide();
}

void ThresholdPanel::say(const QString &sentence, const QString &cure)
{
    m_sentence->setText(sentence);
    m_cure->setText(cure);
    m_row->show();
}

/// Present text of the button.
void ThresholdPanel::cure()
{
    if (m_check.isCounting())
        return m_check.stopCount();
    if (const auto corrected = m_check.corrected())
        return m_controller.setSettings(*corrected, tr("Correct the threshold"));
    m_check.startCount();
}

} // namespace faintline

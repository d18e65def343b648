#include "app/features/settings/ThresholdPanel.h"

#include "app/document/AnalysisController.h"
#include "app/document/RecordingCheck.h"
#include "app/document/statisticUnit.h"
#include "app/features/settings/MainSettings.h"
#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"
#include "widgets/plot/ExceedancePlot.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>

namespace faintline {

ThresholdPanel::ThresholdPanel(ExceedancePlot &plot, MainSettings &main, AnalysisController &controller,
                               RecordingCheck &check, QWidget *parent)
    : QWidget(parent), m_plot(plot), m_main(main), m_controller(controller), m_check(check), m_row(new QWidget),
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
    layout->setSizeConstraint(QLayout::SetNoConstraint); // otherwise the settings would keep the panel tall
    layout->addWidget(&plot, 1);
    layout->addWidget(m_row);
    layout->addWidget(&main);
    main.hide();
    connect(&main, &MainSettings::applicableChanged, this, &ThresholdPanel::showWhatFits);
    connect(m_cure, &QPushButton::clicked, this, &ThresholdPanel::cure);
    connect(&check, &RecordingCheck::changed, this, &ThresholdPanel::refresh);
    refresh();
}

void ThresholdPanel::setMainSettingsWanted(bool areWanted)
{
    m_areMainWanted = areWanted;
    showWhatFits();
}

void ThresholdPanel::showWhatFits()
{
    constexpr int lowestPlot = 140;
    const int below = m_main.sizeHint().height() + (m_row->isHidden() ? 0 : m_row->sizeHint().height());
    m_main.setVisible(m_areMainWanted && m_main.isApplicable() && height() >= below + lowestPlot);
}

QSize ThresholdPanel::minimumSizeHint() const
{
    const int row = m_row->isHidden() ? 0 : m_row->sizeHint().height();
    const QSize plot = m_plot.minimumSizeHint();
    return {std::max(plot.width(), m_main.minimumSizeHint().width()), plot.height() + row};
}

void ThresholdPanel::resizeEvent(QResizeEvent *event)
{
    showWhatFits();
    QWidget::resizeEvent(event);
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
    if (!count && m_check.isCorrected())
        return say(tr("The threshold is corrected for this noise."), {});
    if (isOff && !count)
        return say(m_check.law()->isMore() ? tr("Expect more false alarms on this noise.")
                                           : tr("Expect fewer false alarms on this noise."),
                   tr("Count them"));
    m_row->hide();
    showWhatFits();
}

void ThresholdPanel::say(const QString &sentence, const QString &cure)
{
    m_sentence->setText(sentence);
    m_cure->setText(cure);
    m_cure->setVisible(!cure.isEmpty());
    m_row->show();
    showWhatFits();
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

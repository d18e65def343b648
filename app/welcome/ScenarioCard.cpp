#include "app/welcome/ScenarioCard.h"

#include "widgets/base/Theme.h"
#include "widgets/waterfall/OverviewStrip.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QLabel>
#include <QVBoxLayout>

#include <cmath>

namespace faintline {

namespace {

    constexpr int pictureHeight = 132;

    OverviewStrip *picture(Viewport &viewport)
    {
        auto *strip = new OverviewStrip;
        strip->setViewport(&viewport);
        strip->setFixedHeight(pictureHeight);
        strip->setFocusPolicy(Qt::NoFocus);
        strip->setAttribute(Qt::WA_TransparentForMouseEvents);
        return strip;
    }

} // namespace

ScenarioCard::ScenarioCard(const Scenario &scenario, QWidget *parent)
    : Card(scenario.title, scenario.sentence, parent), m_scenario(scenario), m_input(picture(m_viewport)),
      m_statistic(picture(m_viewport)), m_found(caption(tr("Simulating …"), Theme::font(12)))
{
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(14, 12, 14, 12);
    layout->setSpacing(4);
    layout->addWidget(caption(scenario.title, Theme::boldFont(15)));
    layout->addWidget(caption(tr("The input"), Theme::font(12)));
    layout->addWidget(m_input);
    layout->addWidget(caption(tr("The detector’s statistic"), Theme::font(12)));
    layout->addWidget(m_statistic);
    layout->addWidget(m_found);
    layout->addWidget(caption(scenario.sentence, Theme::font()));
    layout->addStretch();
}

void ScenarioCard::setResult(const OpenedSource &opened, std::shared_ptr<const Analysis> analysis)
{
    m_opened = opened;
    m_analysis = std::move(analysis);
    const Axis &frequency = m_analysis->grid().axes.front();
    const auto &input = m_analysis->inputAlong.front();
    const Viewport::Box full = WaterfallView::extents(input->time(), frequency);
    m_viewport.setExtents(full.time, full.frequency);
    m_input->setPicture(input, frequency);
    m_statistic->setPicture(m_analysis->statisticAlong.front(), frequency);
    const int count = int(m_analysis->tracks.size());
    m_found->setText(count == 1 ? tr("1 event found") : tr("%1 events found").arg(count));
}

} // namespace faintline

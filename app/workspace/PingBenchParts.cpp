// Parts of the bench of pings, their layout and their links.

#include "app/workspace/PingBar.h"
#include "app/workspace/PingBench.h"
#include "app/workspace/PingRegulation.h"
#include "widgets/base/TimeStack.h"
#include "widgets/pings/PingMap.h"
#include "widgets/plot/StripPlot.h"

#include <QSplitter>
#include <QVBoxLayout>

namespace faintline {

void PingBench::layOut()
{
    constexpr int lowestHistory = 96; // pixels, of one above the other
    for (WaterfallView *view : {m_rangeHistory, m_bearingHistory})
        view->setMinimumHeight(lowestHistory);
    m_maps->addWidget(m_input);
    m_maps->addWidget(m_output);
    m_histories->addWidget(m_rangeHistory);
    m_histories->addWidget(m_bearingHistory);
    auto *mapsAndBar = new QWidget;
    auto *column = new QVBoxLayout(mapsAndBar);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(m_maps, 1);
    column->addWidget(m_bar);
    m_rows->addWidget(mapsAndBar);
    m_rows->addWidget(m_histories);
    m_rows->addWidget(m_regulation);
    m_rows->setStretchFactor(0, 1);
    m_rows->setSizes({450, 250, 120});
    for (QSplitter *splitter : {m_maps, m_histories, m_rows})
        splitter->setChildrenCollapsible(false);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(m_rows);
}

/// What runs along time.
void PingBench::buildHistories()
{
    m_input->setObjectName(QStringLiteral("pingInput"));
    m_output->setObjectName(QStringLiteral("pingOutput"));
    m_rangeHistory->setViewport(&m_viewports.rangeTime());
    m_bearingHistory->setViewport(&m_viewports.bearingTime());
    for (WaterfallView *view : {m_rangeHistory, m_bearingHistory}) {
        view->setOrientation(WaterfallView::Orientation::LeftToRight);
        view->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
        m_stack->add(*view, *view);
        connect(view, &WaterfallView::orientationChanged, view == m_rangeHistory ? m_bearingHistory : m_rangeHistory,
                &WaterfallView::setOrientation);
        connect(view, &WaterfallView::orientationChanged, this, &PingBench::arrangeHistories);
    }
    m_stack->add(m_regulation->plot(), *m_regulation);
    arrangeHistories();
}

void PingBench::arrangeHistories()
{
    const bool isStacked = !m_rangeHistory->isTimeVertical();
    m_histories->setOrientation(isStacked ? Qt::Vertical : Qt::Horizontal);
    m_stack->setOn(isStacked);
}

void PingBench::linkBar()
{
    connect(m_bar, &PingBar::pingRequested, this, &PingBench::showPing);
    connect(m_bar, &PingBar::stepRequested, this, &PingBench::stepFrames);
    connect(m_bar, &PingBar::playClicked, this, [this] { setPlaying(!m_player.isPlaying()); });
    connect(m_bar, &PingBar::backwardClicked, this, [this] { setPlayingBackward(!m_player.isPlaying()); });
    for (PingMap *map : {m_input, m_output}) {
        connect(m_bar, &PingBar::inhibitionToggled, map, &PingMap::setInhibitionShown);
        connect(m_bar, &PingBar::conventionalToggled, map, &PingMap::setConventionalShown);
    }
    connect(m_bar, &PingBar::polarToggled, this, &PingBench::setPolar);
    connect(m_output, &PingMap::polarChanged, m_bar, &PingBar::setPolar);
}

std::vector<WaterfallView *> PingBench::views() const
{
    return {m_output->plane(), m_input->plane(), m_rangeHistory, m_bearingHistory};
}

void PingBench::linkViews()
{
    for (WaterfallView *view : views()) {
        for (WaterfallView *other : views()) {
            if (other == view)
                continue;
            connect(view, &WaterfallView::colourMapChanged, other, &WaterfallView::setColourMap);
            connect(view, &WaterfallView::layersChanged, other, [view, other] {
                for (const auto layer :
                     {WaterfallView::EventLayer, WaterfallView::TrackLayer, WaterfallView::TruthLayer,
                      WaterfallView::ThresholdLayer, WaterfallView::GridLayer, WaterfallView::CursorLayer})
                    other->setLayer(layer, view->layers().testFlag(layer));
            });
        }
        connect(view, &WaterfallView::eventActivated, this, &PingBench::eventActivated);
        connect(view, &WaterfallView::thresholdStepRequested, this, &PingBench::thresholdStepRequested);
    }
    for (PingMap *map : {m_input, m_output}) {
        PingMap *other = map == m_input ? m_output : m_input;
        connect(map->plane(), &WaterfallView::orientationChanged, other->plane(), &WaterfallView::setOrientation);
        connect(map, &PingMap::polarChanged, other, &PingMap::setPolar);
        connect(map, &PingMap::hovered, this, &PingBench::read);
        whenInUse(map, &PingMap::hoverEnded, &PingBench::readCursor);
    }
    whenInUse(&m_viewports, &PingViewports::placeChanged, &PingBench::followPlace);
}

} // namespace faintline

// Parts of the bench of pings, their layout and their links.

#include "app/features/pictures/PingBar.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/PingRegulation.h"
#include "app/features/pictures/RegulationPlot.h"
#include "app/features/pictures/ShownAxes.h"
#include "widgets/base/TimeStack.h"
#include "widgets/pings/PingMap.h"

#include <QSplitter>
#include <QVBoxLayout>

namespace faintline {

void PingBench::layOut()
{
    constexpr int lowestHistory = 96; // pixels, of one above the other
    for (WaterfallView *view : {m_alongHistory, m_acrossHistory})
        view->setMinimumHeight(lowestHistory);
    m_maps->addWidget(m_input);
    m_maps->addWidget(m_output);
    auto *mapsAndBar = new QWidget;
    auto *column = new QVBoxLayout(mapsAndBar);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(&m_axes->bar());
    column->addWidget(m_maps, 1);
    column->addWidget(m_bar);
    addPlane(*m_output->plane());
    addPlane(*m_input->plane());
    addHistory(*m_alongHistory, *m_alongHistory, 0);
    addHistory(*m_acrossHistory, *m_acrossHistory, 1);
    timeStack().add(m_regulation->plot(), *m_regulation);
    addRows({{mapsAndBar, 400}, {historyPanes(), 330}, {m_regulation, 90}}); // histories are two
}

/// What runs along time.
void PingBench::buildHistories()
{
    m_input->setObjectName(QStringLiteral("pingInput"));
    m_output->setObjectName(QStringLiteral("pingOutput"));
    m_alongHistory->setViewport(&m_viewports.alongTime());
    m_acrossHistory->setViewport(&m_viewports.acrossTime());
    arrangeBy(m_historyDirection);
}

void PingBench::linkBar()
{
    connect(m_bar, &PingBar::pingRequested, this, &PingBench::showPing);
    connect(m_bar, &PingBar::stepRequested, this, &PingBench::stepFrames);
    connect(m_bar, &PingBar::playClicked, this, [this] { setPlaying(!player().isPlaying()); });
    connect(m_bar, &PingBar::backwardClicked, this, [this] { setPlayingBackward(!player().isPlaying()); });
    PictureDisplay *display = &m_document.display();
    connect(m_bar, &PingBar::inhibitionToggled, this,
            [display](bool isOn) { display->setLayer(PictureDisplay::InhibitionLayer, isOn); });
    connect(m_bar, &PingBar::conventionalToggled, this,
            [display](bool isOn) { display->setLayer(PictureDisplay::ConventionalLayer, isOn); });
    connect(m_bar, &PingBar::polarToggled, this, &PingBench::setPolar);
    connect(display, &PictureDisplay::projectionChanged, this, &PingBench::followProjection);
}

void PingBench::linkAxes()
{
    connect(m_axes, &ShownAxes::axesChanged, this, [this] {
        showAxes();
        showHeading();
    });
    connect(m_axes, &ShownAxes::slicedChanged, this, &PingBench::followPlace);
    connect(&m_viewports, &PingViewports::cursorMoved, this, [this] {
        if (isInUse())
            m_axes->goBehind();
    });
}

void PingBench::linkViews()
{
    for (PingMap *map : {m_input, m_output}) {
        connect(map, &PingMap::hovered, this, &PingBench::read);
        whenInUse(map, &PingMap::hoverEnded, &PingBench::readCursor);
    }
    whenInUse(&m_viewports, &PingViewports::placeChanged, &PingBench::followPlace);
}

} // namespace faintline

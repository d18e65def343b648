// Parts of the main window and their layout.

#include "app/window/MainWindow.h"

#include "app/base/MessageBar.h"
#include "app/control/BoxAnalysis.h"
#include "app/control/EventReviews.h"
#include "app/control/Playback.h"
#include "app/control/ShownEvents.h"
#include "app/control/ThresholdCurves.h"
#include "app/document/OwnPresets.h"
#include "app/lessons/LessonList.h"
#include "app/panels/chosenEvents.h"
#include "app/views/panelList.h"
#include "app/welcome/WelcomePage.h"
#include "app/window/ActivityBar.h"
#include "app/window/Listening.h"
#include "app/window/Panels.h"
#include "app/workspace/LiveBar.h"
#include "app/workspace/PingBench.h"
#include "app/workspace/Workbench.h"
#include "app/workspace/bottomBars.h"
#include "widgets/base/ReadOut.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/waterfall/MarkLegend.h"
#include "widgets/waterfall/OverviewStrip.h"

#include <QGridLayout>
#include <QLabel>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>

namespace faintline {

void MainWindow::buildCentre()
{
    m_messages = new MessageBar;
    m_lessonList = new LessonList;
    m_welcome = new WelcomePage(m_lessonList);
    m_workbench = new Workbench(m_document);
    m_pages = new QStackedWidget;
    m_pages->addWidget(m_welcome);
    m_pages->addWidget(m_workbench);
    m_pings = new PingBench(m_document, m_workbench->layers());
    m_pages->addWidget(m_pings);
    // Hidden parts must not enforce a minimum size.
    const auto measureCurrent = [this](int current) {
        for (int i = 0; i < m_pages->count(); ++i) {
            const auto policy = i == current ? QSizePolicy::Expanding : QSizePolicy::Ignored;
            m_pages->widget(i)->setSizePolicy(policy, policy);
        }
    };
    connect(m_pages, &QStackedWidget::currentChanged, this, measureCurrent);
    measureCurrent(m_pages->currentIndex());

    auto *centre = new QWidget;
    auto *layout = new QVBoxLayout(centre);
    layout->setSizeConstraint(QLayout::SetMaximumSize); // while the pages are hidden, a panel uses their space
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    m_listening = new Listening(*this, *this);
    layout->addWidget(&m_listening->bar());
    auto *pages = new QGridLayout; // a message lies over them, which keeps the pictures where they are
    pages->addWidget(m_pages, 0, 0);
    pages->addWidget(m_messages, 0, 0, Qt::AlignBottom);
    layout->addLayout(pages, 1);
    m_messages->raise();
    setCentralWidget(centre);
}

void MainWindow::buildPanels()
{
    m_ownPresets = new OwnPresets(m_memory.presetFolder(), this);
    m_threshold = new ExceedancePlot;
    m_threshold->setObjectName(QStringLiteral("threshold"));
    m_threshold->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    new ThresholdCurves(m_document, m_controller, *m_threshold, this);
    m_events = new EventTable;
    m_reviews = new EventReviews(
        m_document, *m_events,
        {m_workbench->input(), m_workbench->output(), m_pings->alongHistory(), m_pings->acrossHistory()}, this);
    m_reviews->setClassNames(m_memory.classNames());
    m_reviews->addMaps({m_pings->input(), m_pings->output()});
    m_shownEvents = new ShownEvents(m_document, *m_events, this);
    m_shownEvents->setSnrBandwidth(m_memory.snrBandwidthHz());
    m_boxAnalysis = new BoxAnalysis(m_document, m_controller, {m_workbench->input(), m_workbench->output()}, this);
    m_playback = new Playback(
        m_document,
        [this]() -> std::optional<Event> {
            const std::vector<Event> events = chosenEvents(m_document, *m_events);
            return events.empty() ? std::nullopt : std::optional(events.front());
        },
        this);
    m_listening->setPlayback(*m_playback);
    for (const PanelRow &row : panelList())
        m_docked.emplace_back(row.dock, row.make(*this));
    for (std::size_t i = 0; i < m_docked.size(); ++i)
        m_panels->add(panelList()[i], *m_docked[i].second);
}

void MainWindow::buildBottom()
{
    const auto addBar = [this](const QString &name, const QString &title, QWidget *widget) {
        auto *bar = new QToolBar(title);
        bar->setObjectName(name);
        bar->setMovable(false);
        bar->setFloatable(false);
        bar->addWidget(widget);
        widget->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        addToolBar(Qt::BottomToolBarArea, bar);
        m_bottomBars.push_back(bar);
    };
    auto *overview = new OverviewStrip;
    connectOverview(*overview, m_document, *m_workbench);
    m_readOut = new ReadOut;
    connectReadOut(*m_readOut, m_document, *m_workbench);
    addBar(QStringLiteral("readOutBar"), tr("Read-out"), m_readOut); // the first one is the lowest
    addToolBarBreak(Qt::BottomToolBarArea);
    addBar(QStringLiteral("overviewBar"), tr("Overview"), overview);
}

void MainWindow::buildStatusBar()
{
    m_hint = new QLabel;
    m_hint->setTextFormat(Qt::PlainText);
    m_hint->setContentsMargins(8, 0, 0, 0);
    m_hint->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_activity = new ActivityBar;
    statusBar()->setSizeGripEnabled(false);
    statusBar()->addWidget(m_hint, 1);
    m_legend = new MarkLegend;
    m_legend->hide();
    statusBar()->addPermanentWidget(m_activity);
    statusBar()->addPermanentWidget(m_legend);
}

} // namespace faintline

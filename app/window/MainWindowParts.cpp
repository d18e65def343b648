// Parts of the main window and their layout.

#include "app/window/MainWindow.h"

#include "app/base/MessageBar.h"
#include "app/control/BoxAnalysis.h"
#include "app/control/EventFiles.h"
#include "app/control/EventReviews.h"
#include "app/control/Playback.h"
#include "app/control/ThresholdCurves.h"
#include "app/document/OwnPresets.h"
#include "app/lessons/LessonList.h"
#include "app/panels/ChannelsPanel.h"
#include "app/panels/ComparePanel.h"
#include "app/panels/DopplerPanel.h"
#include "app/panels/EvaluatePanel.h"
#include "app/panels/ExperimentsPanel.h"
#include "app/panels/HandLinePanel.h"
#include "app/panels/InfoPanel.h"
#include "app/panels/LatencyPanel.h"
#include "app/panels/MainSettings.h"
#include "app/panels/NoiseFitPanel.h"
#include "app/panels/PipelinePanel.h"
#include "app/panels/ReproductionPanel.h"
#include "app/panels/SequentialPanel.h"
#include "app/panels/SpectrumPanel.h"
#include "app/panels/StateSlicePanel.h"
#include "app/panels/SurveyPanel.h"
#include "app/panels/SweepPanel.h"
#include "app/panels/TargetsPanel.h"
#include "app/panels/ThresholdPanel.h"
#include "app/panels/WhyPanel.h"
#include "app/panels/chosenEvents.h"
#include "app/welcome/WelcomePage.h"
#include "app/window/ActivityBar.h"
#include "app/window/Panels.h"
#include "app/workspace/LiveBar.h"
#include "app/workspace/PingBench.h"
#include "app/workspace/Workbench.h"
#include "widgets/base/ReadOut.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/plot/StripPlot.h"
#include "widgets/waterfall/MarkLegend.h"
#include "widgets/waterfall/OverviewStrip.h"

#include <QDockWidget>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>

#include <array>
#include <memory>

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
    m_liveBar = new LiveBar(m_document, *m_live);
    m_liveBar->hide();
    layout->addWidget(m_liveBar);
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
    m_pipeline = new PipelinePanel(m_document, m_controller, *m_ownPresets);
    m_threshold = new ExceedancePlot;
    m_threshold->setObjectName(QStringLiteral("threshold"));
    m_threshold->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    new ThresholdCurves(m_document, *m_threshold, this);
    m_events = new EventTable;
    m_reviews = new EventReviews(
        m_document, *m_events,
        {m_workbench->input(), m_workbench->output(), m_pings->alongHistory(), m_pings->acrossHistory()}, this);
    m_reviews->setClassNames(m_memory.classNames());
    m_reviews->addMaps({m_pings->input(), m_pings->output()});
    m_boxAnalysis = new BoxAnalysis(m_document, m_controller, {m_workbench->input(), m_workbench->output()}, this);
    m_playback = new Playback(
        m_document,
        [this]() -> std::optional<Event> {
            const std::vector<Event> events = chosenEvents(m_document, *m_events);
            return events.empty() ? std::nullopt : std::optional(events.front());
        },
        this);
    m_why = new WhyPanel(m_document, m_pings->viewports());
    m_info = new InfoPanel(m_document, m_controller, m_check);
    m_noiseFit = new NoiseFitPanel(m_document);
    m_states = new StateSlicePanel(m_document, m_pings->viewports());
    m_latency = new LatencyPanel(m_document);
    m_handLine = new HandLinePanel(m_document,
                                   {*m_workbench->input(), *m_workbench->outputView(), *m_workbench->statisticPlot()});
    m_targets = new TargetsPanel(m_document, {m_pings->input(), m_pings->output()}, m_pings->viewports());
    m_compare = new ComparePanel(m_document, m_controller, m_comparer);
    m_spectrum = new SpectrumPanel(m_document);
    m_channels = new ChannelsPanel(m_document, m_controller);
    m_doppler = new DopplerPanel(m_document, *m_events, m_reviews->files().provenance());
    m_evaluate = new EvaluatePanel(m_document, m_experiments);
    m_sweep = new SweepPanel(m_document, m_experiments);
    m_experimentList = new ExperimentsPanel(m_experiments);
    m_reproduction = new ReproductionPanel;
    m_survey = new SurveyPanel(m_document, m_controller);
    m_sequential = new SequentialPanel(m_document, m_sequentialTests);
}

void MainWindow::buildDocks()
{
    using Place = Panels::Place;
    m_panels->add(QStringLiteral("pipelineDock"), tr("All settings"), m_pipeline, Place::Left);
    buildSettingsDock();
    auto *main = new MainSettings(m_document, m_controller, MainSettings::few());
    auto *threshold = new ThresholdPanel(*m_threshold, *main, m_controller, m_check);
    // The threshold is above the events so that both are visible while dragging.
    m_panels->add(QStringLiteral("thresholdDock"), tr("Threshold"), threshold, Place::RightTop);
    const auto seen = std::make_shared<std::array<bool, 2>>(); // forms that have these settings, too
    for (const std::size_t form : {std::size_t(0), std::size_t(1)})
        connect(findChild<QDockWidget *>(QLatin1String(form == 0 ? "pipelineDock" : "settingsDock")),
                &QDockWidget::visibilityChanged, threshold, [seen, form, threshold](bool isSeen) {
                    (*seen)[form] = isSeen;
                    threshold->setMainSettingsWanted(*seen == std::array{false, false});
                });
    m_panels->add(QStringLiteral("eventsDock"), tr("Events"), m_events, Place::RightBottom);
    m_panels->add(QStringLiteral("whyDock"), tr("Why"), m_why, Place::RightBottom);
    m_panels->add(QStringLiteral("noiseDock"), tr("Noise"), m_info, Place::RightBottom);
    m_panels->add(QStringLiteral("noiseFitDock"), tr("Noise fit"), m_noiseFit, Place::RightBottom);
    m_panels->add(QStringLiteral("statesDock"), tr("States"), m_states, Place::RightBottom);
    m_panels->add(QStringLiteral("handDock"), tr("By hand"), m_handLine, Place::RightBottom);
    m_handLine->parentWidget()->hide(); // until requested
    m_panels->add(QStringLiteral("evaluateDock"), tr("Pd and ROC"), m_evaluate, Place::Bottom);
    m_panels->add(QStringLiteral("spectrumDock"), tr("Spectrum"), m_spectrum, Place::Bottom);
    m_panels->add(QStringLiteral("channelsDock"), tr("Channels"), m_channels, Place::Bottom);
    m_panels->add(QStringLiteral("dopplerDock"), tr("Doppler fit"), m_doppler, Place::Bottom);
    m_panels->add(QStringLiteral("compareDock"), tr("Compare"), m_compare, Place::Bottom);
    m_panels->add(QStringLiteral("sweepDock"), tr("Sweep"), m_sweep, Place::Bottom);
    m_panels->add(QStringLiteral("surveyDock"), tr("Survey"), m_survey, Place::Bottom);
    m_panels->add(QStringLiteral("experimentsDock"), tr("Experiments"), m_experimentList, Place::Bottom);
    m_panels->add(QStringLiteral("reproductionDock"), tr("Reproduction"), m_reproduction, Place::Bottom);
    m_panels->add(QStringLiteral("sequentialDock"), tr("Sequential test"), m_sequential, Place::Bottom);
    m_panels->add(QStringLiteral("latencyDock"), tr("Latency"), m_latency, Place::Bottom);
    m_panels->add(QStringLiteral("targetsDock"), tr("Targets"), m_targets, Place::Bottom);
}

/// A dozen settings, and the form of all behind a button.
void MainWindow::buildSettingsDock()
{
    auto *all = new QPushButton(tr("&All settings…"));
    all->setToolTip(tr("The whole pipeline, with its presets"));
    connect(all, &QPushButton::clicked, this, [this] { m_panels->show(m_pipeline); });
    auto *column = new QWidget;
    auto *layout = new QVBoxLayout(column);
    layout->setContentsMargins(0, 4, 0, 4);
    layout->addWidget(new MainSettings(m_document, m_controller, MainSettings::dozen()));
    layout->addWidget(all, 0, Qt::AlignLeft);
    layout->addStretch(1);
    auto *area = new QScrollArea;
    area->setFrameShape(QFrame::NoFrame);
    area->setWidgetResizable(true);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area->setWidget(column);
    m_panels->add(QStringLiteral("settingsDock"), tr("Settings"), area, Panels::Place::Left);
    area->parentWidget()->hide(); // until a layout has it
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
    m_overview = new OverviewStrip;
    m_overview->setViewport(&m_document.viewport());
    m_readOut = new ReadOut;
    addBar(QStringLiteral("readOutBar"), tr("Read-out"), m_readOut); // the first one is the lowest
    addToolBarBreak(Qt::BottomToolBarArea);
    addBar(QStringLiteral("overviewBar"), tr("Overview"), m_overview);
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

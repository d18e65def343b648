#include "app/views/panelList.h"

#include "app/base/tr.h"
#include "app/document/OutputLayers.h"
#include "app/features/evaluate/EvaluatePanel.h"
#include "app/features/evaluate/ExperimentsPanel.h"
#include "app/features/evaluate/ReproductionPanel.h"
#include "app/features/evaluate/SweepPanel.h"
#include "app/features/events/ComparePanel.h"
#include "app/features/events/DopplerPanel.h"
#include "app/features/events/EventFiles.h"
#include "app/features/events/EventReviews.h"
#include "app/features/events/HandLinePanel.h"
#include "app/features/inspect/ChannelsPanel.h"
#include "app/features/inspect/InfoPanel.h"
#include "app/features/inspect/LatencyPanel.h"
#include "app/features/inspect/NoiseFitPanel.h"
#include "app/features/inspect/SpectrumPanel.h"
#include "app/features/inspect/StateSlicePanel.h"
#include "app/features/inspect/WhyPanel.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/Workbench.h"
#include "app/features/sequential/SequentialPanel.h"
#include "app/features/settings/MainSettings.h"
#include "app/features/settings/PipelinePanel.h"
#include "app/features/settings/ThresholdPanel.h"
#include "app/features/survey/SurveyPanel.h"
#include "app/features/targets/TargetsPanel.h"
#include "app/views/WindowParts.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/base/settingWords.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/plot/StripPlot.h"

#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

namespace faintline {

namespace {

    template <class P>
    QWidget *make(WindowParts &parts)
    {
        return new P(parts.document());
    }

    /// A dozen settings, and the form of all behind a button.
    QWidget *makeSettings(WindowParts &parts)
    {
        auto *all = new QPushButton(tr("&All settings…"));
        all->setToolTip(tr("The whole pipeline, with its presets"));
        QObject::connect(all, &QPushButton::clicked, all, [&parts] { parts.show(parts.panel<PipelinePanel>()); });
        auto *column = new QWidget;
        auto *layout = new QVBoxLayout(column);
        layout->setContentsMargins(0, 4, 0, 4);
        layout->addWidget(new MainSettings(parts.document(), parts.controller(), MainSettings::dozen()));
        layout->addWidget(all, 0, Qt::AlignLeft);
        layout->addStretch(1);
        return scrolledColumn(column);
    }

    QWidget *makeThreshold(WindowParts &parts)
    {
        auto *main = new MainSettings(parts.document(), parts.controller(), MainSettings::few());
        return new ThresholdPanel(parts.thresholdPlot(), *main, parts.controller(), parts.recordingCheck());
    }

    QWidget *makeWhy(WindowParts &parts)
    {
        auto *panel = new WhyPanel(parts.document(), parts.pingBench().viewports());
        QObject::connect(panel, &WhyPanel::remedyRequested, panel, [&parts](const Advice &advice) {
            parts.controller().setSettings(parts.recordingCheck().remedied(advice),
                                           capitalised(QString::fromStdString(advice.remedy)));
        });
        return panel;
    }

    QWidget *makeStates(WindowParts &parts)
    {
        auto *panel = new StateSlicePanel(parts.document(), parts.workbench().layers(), parts.pingBench().viewports());
        QObject::connect(panel, &StateSlicePanel::lawRequested, panel,
                         [&parts](const QString &field, const std::vector<double> &law) {
                             parts.controller().edit(field, law, tr("Change “%1”").arg(settingLabel(field)));
                         });
        return panel;
    }

    QWidget *makeHandLine(WindowParts &parts)
    {
        Workbench &bench = parts.workbench();
        return new HandLinePanel(parts.document(), {*bench.input(), *bench.outputView(), *bench.statisticPlot()});
    }

    QWidget *makeCompare(WindowParts &parts)
    {
        auto *panel = new ComparePanel(parts.document(), parts.controller(), parts.comparer());
        QObject::connect(panel, &ComparePanel::eventActivated, panel, [&parts](int id) { parts.goTo(id); });
        return panel;
    }

    QWidget *makeSweep(WindowParts &parts)
    {
        auto *panel = new SweepPanel(parts.document(), parts.experiments());
        QObject::connect(panel, &SweepPanel::valueChosen, &parts.controller(), &AnalysisController::editNumber);
        return panel;
    }

    QWidget *makeSurvey(WindowParts &parts)
    {
        auto *panel = new SurveyPanel(parts.document(), parts.controller());
        QObject::connect(panel, &SurveyPanel::eventReached, panel, [&parts, panel](int id) {
            parts.show(*panel); // the first recording replaces it with the panels of a recording
            parts.goTo(id);
        });
        QObject::connect(panel, &SurveyPanel::opened, panel, [&parts, panel] {
            parts.showAlone(*panel, tr("Survey — Faintline"), tr("Double-click an event to open its recording there."));
        });
        QObject::connect(panel, &SurveyPanel::openRequested, panel,
                         [&parts](const QString &path, const OpenOptions &options,
                                  const AnalysisController::Adjust &adjust) { parts.open(path, options, adjust); });
        return panel;
    }

    void showExperiment(WindowParts &parts, int id)
    {
        const Experiments::Entry *entry = parts.experiments().entry(id);
        if (!entry)
            return;
        if (entry->reproduction) {
            parts.panel<ReproductionPanel>().show(entry->reproduction);
            return parts.show(parts.panel<ReproductionPanel>());
        }
        if (entry->reproducible)
            return;
        auto &sweep = parts.panel<SweepPanel>();
        auto &curves = parts.panel<EvaluatePanel>();
        const bool isSweep = entry->campaign && entry->campaign->experiment.isSweep();
        isSweep ? sweep.show(id) : curves.show(id);
        QWidget &shown = isSweep ? static_cast<QWidget &>(sweep) : curves;
        if (!parts.document().isEmpty())
            return parts.show(shown);
        parts.showAlone(shown, tr("%1 — Faintline").arg(entry->name), tr("The curves grow while the experiment runs."));
    }

    QWidget *makeExperiments(WindowParts &parts)
    {
        auto *panel = new ExperimentsPanel(parts.experiments());
        QObject::connect(panel, &ExperimentsPanel::showRequested, panel,
                         [&parts](int id) { showExperiment(parts, id); });
        QObject::connect(&parts.experiments(), &Experiments::changed, panel, [&parts](int id) {
            // Show a finished reproduction; curves update in place.
            if (const Experiments::Entry *entry = parts.experiments().entry(id);
                entry->state == Experiments::State::Done && entry->reproduction)
                showExperiment(parts, id);
        });
        return panel;
    }

    QWidget *makeTargets(WindowParts &parts)
    {
        PingBench &bench = parts.pingBench();
        auto *panel = new TargetsPanel(parts.document(), {bench.input(), bench.output()}, bench.viewports());
        QObject::connect(panel, &TargetsPanel::newSceneRequested, panel, [&parts] { parts.newScene(); });
        QObject::connect(panel, &TargetsPanel::activeChanged, &bench, &PingBench::setMapsFirst);
        return panel;
    }

} // namespace

std::vector<PanelRow> &panelList()
{
    using Place = PanelRow::Place;
    using Of = PanelRow::Of;
    using Parts = WindowParts &;
    // The threshold is above the events so that both are visible while dragging.
    static std::vector<PanelRow> list{
        {"pipelineDock", tr("All settings"), Place::Left,
         [](Parts parts) { return new PipelinePanel(parts.document(), parts.controller(), parts.ownPresets()); }},
        {"settingsDock", tr("Settings"), Place::Left, makeSettings, "", Of::Recording, {}, true},
        {"thresholdDock", tr("Threshold"), Place::RightTop, makeThreshold},
        {"eventsDock", tr("Events"), Place::RightBottom, [](Parts parts) { return &parts.eventTable(); }, "events"},
        {"whyDock", tr("Why"), Place::RightBottom, makeWhy, "why"},
        {"noiseDock", tr("Noise"), Place::RightBottom,
         [](Parts parts) { return new InfoPanel(parts.document(), parts.controller(), parts.recordingCheck()); },
         "noise"},
        {"noiseFitDock", tr("Noise fit"), Place::RightBottom, make<NoiseFitPanel>, "noisefit"},
        {"statesDock", tr("States"), Place::RightBottom, makeStates, "slice"},
        {"handDock", tr("By hand"), Place::RightBottom, makeHandLine, "hand", Of::Recording, {}, true},
        {"evaluateDock", tr("Pd and ROC"), Place::Bottom,
         [](Parts parts) { return new EvaluatePanel(parts.document(), parts.experiments()); }, "pd"},
        {"spectrumDock", tr("Spectrum"), Place::Bottom, make<SpectrumPanel>, "spectrum"},
        {"channelsDock", tr("Channels"), Place::Bottom,
         [](Parts parts) { return new ChannelsPanel(parts.document(), parts.controller()); }, "channels"},
        {"dopplerDock", tr("Doppler fit"), Place::Bottom,
         [](Parts parts) {
             return new DopplerPanel(parts.document(), parts.eventTable(), parts.reviews().files().provenance());
         },
         "doppler"},
        {"compareDock", tr("Compare"), Place::Bottom, makeCompare, "compare"},
        {"sweepDock", tr("Sweep"), Place::Bottom, makeSweep, "sweep"},
        {"surveyDock", tr("Survey"), Place::Bottom, makeSurvey, "survey", Of::Survey},
        {"experimentsDock", tr("Experiments"), Place::Bottom, makeExperiments},
        {"reproductionDock", tr("Reproduction"), Place::Bottom, [](Parts) { return new ReproductionPanel; }},
        {"sequentialDock", tr("Sequential test"), Place::Bottom,
         [](Parts parts) { return new SequentialPanel(parts.document(), parts.sequentialTests()); }, "sequential",
         Of::Scans},
        {"latencyDock", tr("Latency"), Place::Bottom, make<LatencyPanel>, "latency", Of::Pings},
        {"targetsDock", tr("Targets"), Place::Bottom, makeTargets, "targets", Of::Pings},
    };
    return list;
}

} // namespace faintline

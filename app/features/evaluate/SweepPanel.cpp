#include "app/features/evaluate/SweepPanel.h"

#include "app/base/StartColumn.h"
#include "app/base/writeAndReport.h"
#include "app/document/Document.h"
#include "app/features/evaluate/SweepForm.h"
#include "app/features/evaluate/showEntry.h"
#include "evaluate/experiments/SweepTrials.h"
#include "noise/NoiseNormaliser.h"
#include "widgets/plot/ChartPlot.h"

#include <QHBoxLayout>
#include <QTabWidget>

namespace faintline {

namespace {

    /// Whether a setting varies, and not a property of the line.
    bool isOfSetting(const Experiment &sweep)
    {
        return sweep.parameter.find('.') != std::string::npos;
    }

} // namespace

SweepPanel::SweepPanel(const Document &document, Experiments &experiments, QWidget *parent)
    : Panel(parent), m_document(document), m_experiments(experiments), m_form(new SweepForm),
      m_column(new StartColumn(m_form, tr("Progress of the sweep"), tr("Try all values in the background"))),
      m_tabs(new QTabWidget), m_tradeOff(new ChartPlot), m_pd(new ChartPlot), m_falseAlarms(new ChartPlot),
      m_latency(new ChartPlot), m_cost(new ChartPlot)
{
    buildCharts();
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_column);
    layout->addWidget(m_tabs, 1);

    connect(m_column, &StartColumn::startRequested, this, &SweepPanel::start);
    connect(m_column, &StartColumn::cancelRequested, this, &SweepPanel::cancel);
    connect(m_form, &SweepForm::changed, this, &SweepPanel::followForm);
    connect(&experiments, &Experiments::changed, this, &SweepPanel::follow);
    connect(&experiments, &Experiments::removed, this, [this](int id) {
        if (id == m_shown)
            show(0);
    });
    connect(&document, &Document::analysisChanged, this, &SweepPanel::followDocument);
    connect(&document, &Document::opened, this, &SweepPanel::followDocument);
    connect(&document, &Document::settingsChanged, this, &SweepPanel::followDocument);
    followDocument();
}

void SweepPanel::buildCharts()
{
    const std::pair<ChartPlot *, QString> pages[] = {{m_tradeOff, tr("Trade-off")},
                                                     {m_pd, tr("Pd")},
                                                     {m_falseAlarms, tr("False alarms")},
                                                     {m_latency, tr("Latency")},
                                                     {m_cost, tr("Cost")}};
    for (const auto &[chart, title] : pages) {
        m_tabs->addTab(chart, title);
        chart->setEmptySentence(chart == m_cost ? tr("The cost of each value is measured last.")
                                                : tr("Choose a setting and its values, then press Start to plot the "
                                                     "results."));
        connect(chart, &ChartPlot::pointActivated, this,
                [this, chart = chart](std::size_t, std::size_t point) { choose(*chart, point); });
    }
    m_tabs->setDocumentMode(true);
}

void SweepPanel::followDocument()
{
    const auto &analysis = m_document.analysis();
    const double windowSeconds = analysis && analysis->recording ? analysis->frames->geometry().windowSeconds : 0.0;
    m_form->setCurrent(m_document.usedSettings(), m_document.recording() ? m_document.sourcePath() : QString(),
                       windowSeconds);
}

void SweepPanel::followForm()
{
    if (const Experiments::Entry *entry = m_experiments.entry(m_shown))
        showEntry(*m_column, *entry, ofForm());
}

/// The sweep that the form would start; nothing if the form is incomplete.
std::optional<Experiment> SweepPanel::ofForm() const
{
    try {
        return m_form->experiment();
    } catch (const Error &) {
        return {}; // the form says why
    }
}

void SweepPanel::start()
{
    actOrReport(*this, [this] {
        const Experiment sweep = m_form->experiment();
        show(m_experiments.start(m_form->name(), sweep, m_form->isInRecording() ? m_document.recording() : nullptr));
    });
}

void SweepPanel::cancel()
{
    m_experiments.cancel(m_shown);
}

void SweepPanel::show(int id)
{
    m_shown = id;
    m_meter.cancel();
    m_costOf = 0;
    m_cost->setChart({});
    if (const Experiments::Entry *entry = m_experiments.entry(id)) {
        if (entry->campaign && ofForm() != entry->campaign->experiment)
            m_form->setExperiment(entry->campaign->experiment);
        return follow(id);
    }
    for (ChartPlot *chart : {m_tradeOff, m_pd, m_falseAlarms, m_latency})
        chart->setChart({});
    m_column->clearState();
}

void SweepPanel::follow(int id)
{
    const Experiments::Entry *entry = m_experiments.entry(id);
    if (id != m_shown || !entry || !entry->campaign || !entry->campaign->experiment.isSweep())
        return;
    showEntry(*m_column, *entry, ofForm());
    showCharts(*entry);
    if (entry->state == Experiments::State::Done && m_isMeasuringCost && m_costOf != id)
        measureCost(*entry);
}

void SweepPanel::showCharts(const Experiments::Entry &entry)
{
    const bool isSetting = isOfSetting(entry.campaign->experiment);
    for (ChartPlot *chart : {m_tradeOff, m_pd, m_falseAlarms, m_latency, m_cost})
        chart->setInvitation(isSetting ? tr("click it to apply this value") : QString());
    m_tradeOff->setChart(tradeOffChart(*entry.campaign));
    m_pd->setChart(sweepChart(*entry.campaign, SweepMeasure::Pd));
    m_falseAlarms->setChart(sweepChart(*entry.campaign, SweepMeasure::FalseAlarms));
    m_latency->setChart(sweepChart(*entry.campaign, SweepMeasure::Latency));
}

void SweepPanel::measureCost(const Experiments::Entry &entry)
{
    m_costOf = entry.id;
    m_meter.start([this, sweep = entry.campaign->experiment,
                   recording = entry.recording](const RunContext &context) -> JobRunner::Delivery {
        const Chart chart =
            costChart(sweep, SweepTrials(sweep, recording ? recording : openRecordingOf(sweep), context.part(0.0, 0.1))
                                 .costs(context.part(0.1, 1.0)));
        return [this, chart] { m_cost->setChart(chart); };
    });
}

void SweepPanel::choose(const ChartPlot &chart, std::size_t point)
{
    const Experiments::Entry *entry = m_experiments.entry(m_shown);
    if (!entry || !entry->campaign)
        return;
    const auto &sweep = entry->campaign->experiment;
    if (!isOfSetting(sweep))
        return;
    if (&chart == m_latency) {
        // Values without any detection have no latency.
        emit valueChosen(QString::fromStdString(sweep.parameter), m_latency->chart().curves.front().points[point].x);
    } else if (&chart == m_cost) {
        emit valueChosen(QString::fromStdString(sweep.parameter), sweep.values[point]);
    } else if (const std::vector<SweepPoint> curve = sweepCurve(*entry->campaign); point < curve.size()) {
        emit valueChosen(QString::fromStdString(sweep.parameter), curve[point].value);
    }
}

} // namespace faintline

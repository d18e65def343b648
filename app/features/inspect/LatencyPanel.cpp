#include "app/features/inspect/LatencyPanel.h"

#include "base/Interval.h"
#include "evaluate/experiments/PingExperiment.h"
#include "widgets/base/labelText.h"
#include "widgets/plot/ChartPlot.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QSplitter>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    struct Latencies {
        std::vector<Index> detection;
        std::vector<Index> confirmation;
    };

    Latencies latenciesOf(const std::vector<TrackScore> &scores)
    {
        Latencies all;
        for (const TrackScore &run : scores)
            for (const TargetScore &target : run.targets) {
                all.detection.push_back(target.detectLatency);
                all.confirmation.push_back(target.confirmLatency);
            }
        return all;
    }

    Curve pdCurve(const std::string &name, const std::vector<Index> &latencies, Index longest)
    {
        Curve curve{name, Curve::Kind::Measured, {}};
        const auto count = double(latencies.size());
        const std::vector<double> pd = pdAgainstPings(latencies, longest);
        for (std::size_t i = 0; i < pd.size(); ++i)
            curve.points.push_back(
                {double(i + 1), pd[i], wilsonInterval(std::llround(pd[i] * count), std::ssize(latencies))});
        return curve;
    }

    Curve histogramCurve(const std::string &name, const std::vector<Index> &latencies, Index longest)
    {
        Curve curve{name, Curve::Kind::Measured, {}};
        const std::vector<int> counts = latencyHistogram(latencies, longest);
        for (std::size_t i = 0; i + 1 < counts.size(); ++i)
            curve.points.push_back({double(i + 1), double(counts[i]), {}});
        return curve;
    }

} // namespace

LatencyPanel::LatencyPanel(const Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_runs(new QSpinBox), m_button(new QPushButton(tr("&Measure"))),
      m_sentence(panelSentence()), m_pd(new ChartPlot), m_histogram(new ChartPlot)
{
    constexpr int usualRuns = 12;
    m_runs->setRange(1, 10000);
    m_runs->setValue(usualRuns);
    m_runs->setSuffix(tr(" runs"));
    m_runs->setAccessibleName(tr("Runs"));
    for (ChartPlot *plot : {m_pd, m_histogram})
        plot->setEmptySentence(tr("Press Measure to see how soon the scene's targets are found."));
    auto *top = new QHBoxLayout;
    top->setContentsMargins(8, 6, 8, 4);
    top->setSpacing(10);
    top->addWidget(m_runs);
    top->addWidget(m_button);
    top->addWidget(m_sentence, 1);
    auto *charts = new QSplitter(Qt::Horizontal);
    charts->addWidget(m_pd);
    charts->addWidget(m_histogram);
    charts->setChildrenCollapsible(false);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(top);
    layout->addWidget(charts, 1);

    connect(m_button, &QPushButton::clicked, this,
            [this] { m_runner.isRunning() ? m_runner.cancel() : start(m_runs->value()); });
    connect(&document, &Document::opened, this, [this] {
        m_runner.cancel();
        m_pd->setChart({});
        m_histogram->setChart({});
        follow();
    });
    connect(&document, &Document::analysisChanged, this, &LatencyPanel::follow);
    connect(&m_runner, &JobRunner::progressed, this, [this](double fraction, const QString &what) {
        m_sentence->setText(tr("%1, %2 %").arg(what).arg(int(100.0 * fraction)));
    });
    connect(&m_runner, &JobRunner::busyChanged, this,
            [this](bool isBusy) { m_button->setText(isBusy ? tr("&Stop") : tr("&Measure")); });
    connect(&m_runner, &JobRunner::cancelled, this, [this] { m_sentence->setText(tr("Stopped.")); });
    connect(&m_runner, &JobRunner::failed, this,
            [this](const Error &error) { m_sentence->setText(messageText(error.what())); });
    follow();
}

QString LatencyPanel::obstacle() const
{
    if (!m_document.source().pings || m_document.source().pings->targets.empty())
        return tr("Needs a simulated scene of pings with known targets.");
    if (!m_document.analysis())
        return tr("Needs an analysis to take its threshold from.");
    if (!std::holds_alternative<SmdSettings>(m_document.settings().detector)
        || m_document.settings().model.motion == Motion::Bank)
        return tr("Needs the sequential Markov detector with a single model.");
    return {};
}

void LatencyPanel::follow()
{
    const QString why = obstacle();
    m_button->setEnabled(why.isEmpty());
    m_sentence->setText(why);
}

void LatencyPanel::start(int runs)
{
    if (!obstacle().isEmpty())
        return;
    const Analysis &analysis = *m_document.analysis();
    PingExperiment experiment{*m_document.source().pings, m_document.settings(), runs, 200, 1, {3, 1}};
    experiment.settings.decide.by = DecideSettings::By::Nats;
    experiment.settings.decide.thresholdNats = analysis.threshold;
    std::get<SmdSettings>(experiment.settings.detector).lnK = analysis.calibration->lnK;
    m_runner.start([this, experiment](const RunContext &context) -> JobRunner::Delivery {
        const std::vector<TrackScore> scores = runPings(experiment, context);
        return [this, scores, longest = Index(experiment.scene.pings),
                threshold = experiment.settings.decide.thresholdNats] { show(scores, longest, threshold); };
    });
}

void LatencyPanel::show(const std::vector<TrackScore> &scores, Index longest, double threshold)
{
    const Latencies all = latenciesOf(scores);
    int falseTracks = 0;
    int falseConfirmed = 0;
    for (const TrackScore &run : scores) {
        falseTracks += run.falseTracks;
        falseConfirmed += run.falseConfirmed;
    }
    const Index last = std::max<Index>(1, *std::max_element(all.confirmation.begin(), all.confirmation.end()));
    const Index shown =
        std::min(longest, std::max(last, *std::max_element(all.detection.begin(), all.detection.end())) + 3);
    m_pd->setChart({"Probability of detection against latency",
                    "pings since the target appeared",
                    "Pd",
                    false,
                    false,
                    {pdCurve("detected", all.detection, shown), pdCurve("confirmed", all.confirmation, shown)}});
    m_histogram->setChart(
        {"Latency",
         "pings since the target appeared",
         "targets",
         false,
         false,
         {histogramCurve("detected", all.detection, shown), histogramCurve("confirmed", all.confirmation, shown)}});
    const auto never =
        std::count_if(all.detection.begin(), all.detection.end(), [](Index latency) { return latency < 0; });
    m_sentence->setText(tr("%1 targets in %2 runs at %3 nat, after 200 pings of noise: %4 not found; %5 false tracks, "
                           "%6 of them confirmed.")
                            .arg(all.detection.size())
                            .arg(scores.size())
                            .arg(threshold, 0, 'f', 1)
                            .arg(never)
                            .arg(falseTracks)
                            .arg(falseConfirmed));
}

} // namespace faintline

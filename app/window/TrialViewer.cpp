#include "app/window/TrialViewer.h"

#include "app/document/statisticUnit.h"
#include "app/window/TrialWindow.h"
#include "evaluate/experiments/campaignCurve.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"

namespace faintline {

namespace {

    double snrOf(const Campaign &campaign, std::size_t snr)
    {
        return campaign.experiment.snrDb[snr];
    }

} // namespace

TrialViewer::TrialViewer(const Experiments &experiments, QWidget *window) : m_experiments(experiments), m_parent(window)
{
    connect(&m_runner, &JobRunner::busyChanged, this, [this](bool isBusy) {
        if (m_window)
            m_window->setBusy(isBusy);
    });
    connect(&m_runner, &JobRunner::failed, this, &TrialViewer::failed);
}

TrialViewer::~TrialViewer() = default;

void TrialViewer::open(int experiment, std::size_t detector, std::size_t snr)
{
    const bool isSame = experiment == m_experiment && detector == m_detector && snr == m_snr;
    m_experiment = experiment;
    m_detector = detector;
    m_snr = snr;
    m_trial = isSame ? m_trial + 1 : 0;
    start();
}

void TrialViewer::step(int trials, bool onlyMissed)
{
    const Experiments::Entry *entry = m_experiments.entry(m_experiment);
    if (!entry || !entry->campaign)
        return;
    const auto all = trialsOf(*entry->campaign, {m_detector, m_snr});
    const auto count = std::ssize(all);
    for (std::ptrdiff_t i = 1; i <= count; ++i) {
        const std::ptrdiff_t next = ((m_trial + i * trials) % count + count) % count;
        if (onlyMissed && all[std::size_t(next)].isDetected)
            continue;
        m_trial = next;
        return start();
    }
}

void TrialViewer::start()
{
    const Experiments::Entry *entry = m_experiments.entry(m_experiment);
    if (!entry || !entry->campaign)
        return;
    const auto all = trialsOf(*entry->campaign, {m_detector, m_snr});
    if (all.empty())
        return;
    m_trial %= std::ssize(all);
    const TrialPlace place = all[std::size_t(m_trial)].place;
    m_runner.start([this, campaign = *entry->campaign, trials = entry->trials, detector = m_detector, snr = m_snr,
                    place](const RunContext &context) -> JobRunner::Delivery {
        ShownTrial trial = showTrial(campaign, trials.get(), {detector, snr}, place, context);
        return [this, trial = std::move(trial)] { show(trial); };
    });
}

void TrialViewer::show(const ShownTrial &trial)
{
    const Experiments::Entry *entry = m_experiments.entry(m_experiment);
    if (!entry || !entry->campaign)
        return;
    const Campaign &campaign = *entry->campaign;
    const auto all = trialsOf(campaign, {m_detector, m_snr});
    const TrialOutcome &outcome = all[std::size_t(m_trial)];
    const DetectorUnderTest &detector = campaign.experiment.detectors[m_detector];
    const QString name = labelText(detector.name);
    const QString db = numberText(snrOf(campaign, m_snr), 1);
    const QString unit = statisticUnit(detector.settings);
    const bool isLine = campaign.experiment.isLines();
    QString sentence;
    if (!detector.isWhole) {
        sentence = outcome.isDetected
                       ? tr("%1 at %2 dB: detected. On the line, D reaches %3 %5; the threshold is %4 %5.")
                       : tr("%1 at %2 dB: missed. On the line, D reaches only %3 %5; the threshold is %4 %5.");
        sentence = sentence.arg(name, db, numberText(outcome.statistic, 2),
                                numberText(shownThreshold(campaign, m_detector), 2), unit);
    } else if (outcome.isDetected) {
        sentence = tr("%1 at %2 dB: detected. A track on the line exceeds the threshold by %3 %4.")
                       .arg(name, db, numberText(outcome.statistic, 2), unit);
    } else {
        sentence = tr("%1 at %2 dB: missed. No track has half of its points on the line.").arg(name, db);
    }
    sentence += isLine ? tr(" Run %1, line %2. One second stands for a window T_FT, one hertz for a resolution cell.")
                             .arg(outcome.place.run)
                             .arg(outcome.place.signal)
                       : tr(" Trial %1, injected into the recording.").arg(outcome.place.run);
    if (!m_window) {
        m_window = std::make_unique<TrialWindow>(m_parent);
        connect(m_window.get(), &TrialWindow::stepRequested, this, &TrialViewer::step);
    }
    m_window->show(trial, tr("Trial %1 of %2 · %3 at %4 dB").arg(m_trial + 1).arg(all.size()).arg(name, db), sentence);
    emit shown();
}

} // namespace faintline

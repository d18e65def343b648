#include "evaluate/experiments/showTrial.h"

#include "analyse/analyse.h"
#include "evaluate/experiments/InjectionTrials.h"
#include "evaluate/experiments/LineTrials.h"
#include "evaluate/experiments/campaignCurve.h"

#include <algorithm>

namespace faintline {

namespace {

    /// Precomputed frames have no windows or resolution cells: lengths are converted to frames and bins.
    DetectorSettings inFrames(DetectorSettings detector, const Experiment &lines)
    {
        if (auto *integrator = std::get_if<IntegratorSettings>(&detector))
            integrator->durationWindows *= lines.stepsPerWindow;
        if (auto *viterbi = std::get_if<BlockViterbiSettings>(&detector))
            viterbi->durationWindows *= lines.stepsPerWindow;
        if (auto *pOfN = std::get_if<PofNSettings>(&detector))
            pOfN->widthCells *= lines.binsPerCell;
        return detector;
    }

    void setThreshold(AnalysisSettings &settings, double threshold)
    {
        const FieldInfo &range = settingField("decide.thresholdNats");
        settings.decide.by = DecideSettings::By::Nats;
        settings.decide.thresholdNats = std::clamp(threshold, range.minimum, range.maximum);
    }

    ShownTrial showLine(const Campaign &campaign, const CampaignPoint &point, const TrialPlace &place,
                        const RunContext &context)
    {
        const Experiment &lines = campaign.experiment;
        Experiment alone = lines;
        alone.detectors = {lines.detectors[point.detector]};
        AnalysisSettings settings = alone.detectors.front().settings;
        if (auto *smd = std::get_if<SmdSettings>(&settings.detector);
            smd && smd->reset == SmdSettings::Reset::Calibrated)
            *smd = {SmdSettings::Reset::Fixed, LineTrials(alone, context.part(0.0, 0.3)).resets().front().lnK};
        settings.detector = inFrames(settings.detector, lines);
        setThreshold(settings, shownThreshold(campaign, point.detector));

        context.checkpoint(0.3, "repeating the trial");
        const LineTrial trial = remakeTrial(lines, lines.snrDb[point.snr], place.run, place.signal);
        const Axis &time = trial.frames->time();
        const Axis &frequency = trial.frames->grid().axes.front();
        TruthLine truth;
        truth.startSeconds = time.value(double(trial.firstFrame));
        truth.endSeconds = time.value(double(trial.firstFrame + std::ssize(trial.path) - 1));
        truth.snrDb = lines.snrDb[point.snr];
        truth.referenceSeconds = 1.0;
        truth.stepSeconds = time.step;
        for (const Index bin : trial.path)
            truth.frequencyHz.push_back(frequency.value(double(bin)));
        return {analyse(trial.frames, settings, {.model = makeModel(settings.model, trial.frames->grid())},
                        context.part(0.4, 1.0)),
                {{truth}}};
    }

    ShownTrial showInjected(const Campaign &campaign, const InjectionTrials &trials, const CampaignPoint &point,
                            const TrialPlace &place, const RunContext &context)
    {
        const Experiment &injection = campaign.experiment;
        const MadeTrial made = trials.remake(place.run, injection.snrDb[point.snr]);
        AnalysisSettings settings = settingsOf(injection, point.detector);
        if (injection.detectors[point.detector].isWhole)
            settings = trials.wholeSettings(point.detector, made.truth);
        else
            setThreshold(settings, shownThreshold(campaign, point.detector));
        return {analyse(made.recording, settings, {}, context), {{made.truth}}};
    }

} // namespace

std::vector<TrialOutcome> trialsOf(const Campaign &campaign, const CampaignPoint &point)
{
    std::vector<TrialOutcome> result;
    if (campaign.outcomes.empty() || campaign.experiment.isSweep())
        return result;
    const double threshold = shownThreshold(campaign, point.detector);
    for (const RunOutcome &outcome : campaign.outcomes) {
        const std::vector<float> &signals = outcome.signal[point.detector][point.snr];
        for (std::size_t i = 0; i < signals.size(); ++i) {
            const auto statistic = double(signals[i]);
            result.push_back({{outcome.run, int(i)}, statistic, statistic > threshold});
        }
    }
    return result;
}

ShownTrial showTrial(const Campaign &campaign, const Trials *trials, const CampaignPoint &point,
                     const TrialPlace &place, const RunContext &context)
{
    const Experiment &experiment = campaign.experiment;
    if (experiment.isLines()) {
        if (!experiment.detectors[point.detector].isWhole)
            return showLine(campaign, point, place, context);
        const MadeTrial made = remakeField(experiment, experiment.snrDb[point.snr], place.run, place.signal);
        return {analyse(made.recording, wholeSettings(experiment, point.detector), {}, context), {{made.truth}}};
    }
    if (experiment.isSweep())
        throw Error("trial", "trials of a sweep cannot be shown; apply the value and inject a line instead");
    if (const auto *injected = dynamic_cast<const InjectionTrials *>(trials))
        return showInjected(campaign, *injected, point, place, context);
    throw Error("trial", "belongs to an imported injection experiment; run the experiment here to see its trials");
}

} // namespace faintline

#include "evaluate/experiments/SweepTrials.h"

#include "analyse/analyse.h"
#include "base/Error.h"
#include "base/Random.h"
#include "calibrate/calibrate.h"
#include "evaluate/experiments/lineDetection.h"
#include "evaluate/experiments/measureCost.h"
#include "evaluate/experiments/scaledInjection.h"
#include "plan/slopeUnit.h"
#include "scene/InjectedRecording.h"
#include "scene/SimulatedRecording.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr double bandMargin = 0.1; ///< fraction of the band at either edge that is kept free of lines

} // namespace

RunOutcome sweepOutcome(int run, std::ptrdiff_t falseAlarms, double seconds, double latencySeconds)
{
    RunOutcome outcome;
    outcome.run = run;
    outcome.noise = {{float(falseAlarms), float(seconds)}};
    outcome.signal = {{{float(latencySeconds)}}};
    return outcome;
}

SweepTrials::SweepTrials(const Experiment &experiment, RecordingPointer recording, const RunContext &context)
    : m_experiment(experiment), m_recording(std::move(recording)),
      m_referenceSeconds(experiment.settings.spectrogram.windowSeconds)
{
    checkExperiment(experiment);
    if (m_referenceSeconds == 0.0) {
        RecordingInfo info;
        info.sampleRateHz = experiment.sampleRateHz;
        info.sampleCount = Index(experiment.trialSeconds() * experiment.sampleRateHz);
        m_referenceSeconds = Spectrogram::automaticWindowSeconds(m_recording ? m_recording->info() : info);
    }
    if (m_recording) {
        SpectrogramSettings windows = experiment.settings.spectrogram;
        windows.windowSeconds = m_referenceSeconds;
        m_stopBands =
            bandsNotSearched(experiment.settings, Spectrogram(m_recording, windows, experiment.settings.selection));
    }
    const auto count = double(experiment.values.size());
    for (std::size_t i = 0; i < experiment.values.size(); ++i) {
        const RunContext part = context.part(double(i) / count, double(i + 1) / count);
        const SweptTrial made = remake(int(i));
        AnalysisSettings settings = made.settings;
        if (settings.spectrogram.windowSeconds == 0.0)
            settings.spectrogram.windowSeconds = m_referenceSeconds;
        settings = withSlopesInBins(settings, made.recording->info());
        const Spectrogram spectrogram(made.recording, settings.spectrogram, settings.selection);
        const double cellFramesPerHour = cellFramesInAnHour(settings, spectrogram);
        m_thresholds.push_back(
            thresholdNats(settings.decide, *calibrateBand(settings, spectrogram, part), cellFramesPerHour));
    }
}

/// Random position of a trial's line, as fractions of the possible range.
struct SweepTrials::Placement {
    double inBand;
    double inTime;
    std::uint64_t seed; ///< of the trial: noise, phase and wander
};

SweepTrials::SweptTrial SweepTrials::remake(int run) const
{
    const int trial = m_experiment.trialOf(run);
    Random places(std::uint64_t(m_experiment.seed), std::uint64_t(trial));
    const std::uint64_t seed = std::uint64_t(m_experiment.seed) * 1000003 + std::uint64_t(trial);
    const Placement placement{places.uniform(), places.uniform(), seed}; // in this order
    const Experiment one = experimentAt(m_experiment, std::size_t(m_experiment.valueOf(run)));
    const LineSettings line = lineAt(one, placement);
    return m_recording ? inject(one, line, placement) : simulate(one, line, placement);
}

LineSettings SweepTrials::lineAt(const Experiment &one, const Placement &placement) const
{
    RecordingInfo info;
    info.sampleRateHz = one.sampleRateHz;
    if (m_recording)
        info = m_recording->info();
    const SelectionSettings &selection = one.settings.selection;
    const bool isWhole = isWholeBand(selection);
    const double start = info.isComplex ? -0.5 * info.sampleRateHz : 0.0;
    const double end = 0.5 * info.sampleRateHz;
    double lowest = isWhole ? start : std::max(start, selection.lowHz);
    double highest = isWhole ? end : std::min(end, selection.highHz);
    for (const StopBand &band : m_stopBands)
        if (band.lowHz <= lowest)
            lowest = band.highHz;
        else
            highest = band.lowHz;
    const double travel = one.driftHzPerSecond * one.durationSeconds;
    const double low = lowest + bandMargin * (highest - lowest) + 4.0 * one.wanderHz + std::max(0.0, -travel);
    const double high = highest - bandMargin * (highest - lowest) - 4.0 * one.wanderHz - std::max(0.0, travel);
    if (!(low < high))
        throw Error("driftHzPerSecond, wanderHz",
                    "a line must stay within the band of " + formatNumber(highest - lowest) + " Hz");
    LineSettings line = lineOf(one, one.snrDb.front(), m_referenceSeconds);
    line.startSeconds = one.marginSeconds;
    line.frequencyHz = info.centreHz + low + placement.inBand * (high - low);
    return line;
}

SweepTrials::SweptTrial SweepTrials::simulate(const Experiment &one, const LineSettings &line,
                                              const Placement &placement) const
{
    LineScene scene;
    scene.sampleRateHz = one.sampleRateHz;
    scene.durationSeconds = one.trialSeconds();
    scene.seed = int(placement.seed % 2147483647);
    scene.lines = {line};
    const auto simulated = std::make_shared<SimulatedRecording>(scene);
    SweptTrial made{{simulated, simulated->truth().lines.front()}, one.settings};
    made.settings.selection.fromSeconds = made.settings.selection.toSeconds = 0.0;
    made.settings.selection.channel = 0;
    return made;
}

SweepTrials::SweptTrial SweepTrials::inject(const Experiment &one, LineSettings line, const Placement &placement) const
{
    const SelectionSettings &selection = one.settings.selection;
    const double recorded = m_recording->info().durationSeconds();
    const double whole = one.trialSeconds();
    const double from = selection.fromSeconds;
    const double to = selection.toSeconds > from ? std::min(selection.toSeconds, recorded) : recorded;
    if (to - from < whole)
        throw Error("durationSeconds, marginSeconds", "a trial of " + formatNumber(whole)
                                                          + " s must fit into the selection of "
                                                          + formatNumber(to - from) + " s");
    const double begin = from + placement.inTime * (to - from - whole);
    line.startSeconds += begin;
    SweptTrial made{{}, one.settings};
    made.settings.selection.fromSeconds = begin;
    made.settings.selection.toSeconds = begin + whole;
    AnalysisSettings placing = m_experiment.settings; // the noise under the line is the same for every value
    placing.selection = made.settings.selection;
    const InjectedLine injected = scaledInjection(line, m_recording, placing);
    const auto with =
        std::make_shared<InjectedRecording>(m_recording, std::vector{injected}, selection.channel, placement.seed);
    made.truth = with->truth().lines.front();
    made.recording = with;
    return made;
}

RunOutcome SweepTrials::outcomeOf(int run, const RunContext &quiet) const
{
    const SweptTrial made = remake(run);
    const auto analysis = analyse(made.recording, made.settings, {.depth = AnalysisDepth::Tracks}, quiet);
    const LineDetection found = lineDetection(*analysis, made.truth);
    return sweepOutcome(run, found.tracksBeside, double(analysis->time().count) * analysis->time().step,
                        found.latencySeconds);
}

std::vector<double> SweepTrials::costs(const RunContext &context) const
{
    std::vector<double> seconds;
    RunContext quiet;
    quiet.stop = context.stop;
    for (std::size_t i = 0; i < m_experiment.values.size(); ++i) {
        context.checkpoint(double(i) / double(m_experiment.values.size()), "measuring the cost");
        const SweptTrial made = remake(int(i));
        seconds.push_back(measureCost(*analyse(made.recording, made.settings, {}, quiet), quiet));
    }
    return seconds;
}

} // namespace faintline

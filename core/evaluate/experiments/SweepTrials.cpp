#include "evaluate/experiments/SweepTrials.h"

#include "analyse/analyse.h"
#include "base/Error.h"
#include "base/Random.h"
#include "base/parallel.h"
#include "calibrate/calibrate.h"
#include "evaluate/experiments/measureCost.h"
#include "evaluate/experiments/scaledInjection.h"
#include "plan/slopeUnit.h"
#include "scene/InjectedRecording.h"
#include "scene/SimulatedRecording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace faintline {

namespace {

    constexpr double reachCells = 1.5; ///< of a track around its line
    constexpr double bandMargin = 0.1; ///< fraction of the band at either edge that is kept free of lines
    constexpr double neverDetected = -std::numeric_limits<double>::infinity();

    /// Relation of a track to the line.
    enum class Bond { None, Touches, OnIt };

    Bond bondOf(const Track &track, const Analysis &analysis, const TruthLine &truth)
    {
        const Spectrogram &spectrogram = *analysis.frames->spectrogram();
        const Axis &frequency = analysis.grid().axes.front();
        const double reach = reachCells * spectrogram.binsPerCell() * frequency.step;
        const double window = spectrogram.windowSeconds();
        const double centreHz = analysis.recording->info().centreHz;
        int during = 0;
        int on = 0;
        bool isTouching = false;
        for (const TrackPoint &point : track.points) {
            const double seconds = analysis.time().value(double(point.frame));
            const double hz = frequency.value(double(point.cell));
            const bool isNear = std::abs(hz - (truth.frequencyAt(seconds) - centreHz)) <= reach;
            if (seconds >= truth.startSeconds && seconds <= truth.endSeconds) {
                ++during;
                on += isNear ? 1 : 0;
            }
            isTouching = isTouching
                         || (isNear && seconds >= truth.startSeconds - window && seconds <= truth.endSeconds + window);
        }
        return on > 0 && 2 * on >= during ? Bond::OnIt : isTouching ? Bond::Touches : Bond::None;
    }

    RunOutcome scored(int run, const Analysis &analysis, const TruthLine &truth)
    {
        std::ptrdiff_t falseAlarms = 0;
        double latency = neverDetected;
        for (const Track &track : analysis.tracks) {
            const Bond bond = bondOf(track, analysis, truth);
            falseAlarms += bond == Bond::None ? 1 : 0;
            if (bond != Bond::OnIt)
                continue;
            const double after = std::max(0.0, analysis.time().value(double(track.detectFrame)) - truth.startSeconds);
            latency = latency < 0.0 ? after : std::min(latency, after);
        }
        return sweepOutcome(run, falseAlarms, double(analysis.time().count) * analysis.time().step, latency);
    }

    /// Like `settingsAt`, with slopes in bins per frame for the window of that value.
    AnalysisSettings settingsOfTrial(const SweepExperiment &experiment, std::size_t value, const Recording *recording)
    {
        RecordingInfo info;
        info.sampleRateHz = experiment.sampleRateHz;
        return withSlopesInBins(settingsAt(experiment, value), recording ? recording->info() : info);
    }

} // namespace

RunOutcome sweepOutcome(int run, std::ptrdiff_t falseAlarms, double seconds, double latencySeconds)
{
    RunOutcome outcome;
    outcome.run = run;
    outcome.noise = {{float(falseAlarms), float(seconds)}};
    outcome.signal = {{{float(latencySeconds)}}};
    return outcome;
}

SweepTrials::SweepTrials(const SweepExperiment &experiment, RecordingPointer recording, const RunContext &context)
    : m_experiment(experiment), m_recording(std::move(recording))
{
    checkExperiment(experiment);
    if (m_recording && experiment.trialSeconds() >= m_recording->info().durationSeconds())
        throw Error("durationSeconds, marginSeconds", "a trial of " + formatNumber(experiment.trialSeconds())
                                                          + " s must be shorter than the recording, "
                                                          + formatNumber(m_recording->info().durationSeconds()) + " s");
    if (experiment.settings.spectrogram.windowSeconds == 0.0) {
        // What is chosen automatically must not depend on the stretch that a trial examines.
        RecordingInfo info;
        info.sampleRateHz = experiment.sampleRateHz;
        info.sampleCount = Index(experiment.trialSeconds() * experiment.sampleRateHz);
        m_experiment.settings.spectrogram.windowSeconds =
            Spectrogram::automaticWindowSeconds(m_recording ? m_recording->info() : info);
    }
    const auto count = double(experiment.values.size());
    for (std::size_t i = 0; i < experiment.values.size(); ++i) {
        const RunContext part = context.part(double(i) / count, double(i + 1) / count);
        const AnalysisSettings settings = settingsOfTrial(m_experiment, i, m_recording.get());
        const Made made = remake(int(i));
        const Spectrogram spectrogram(made.recording, settings.spectrogram, made.settings.selection);
        const double cellFramesPerHour = cellFramesInAnHour(settings.family, spectrogram);
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

SweepTrials::Made SweepTrials::remake(int run) const
{
    const int trial = m_experiment.trialOf(run);
    Random places(std::uint64_t(m_experiment.seed), std::uint64_t(trial));
    const std::uint64_t seed = std::uint64_t(m_experiment.seed) * 1000003 + std::uint64_t(trial);
    const Placement placement{places.uniform(), places.uniform(), seed}; // in this order
    const AnalysisSettings settings =
        settingsOfTrial(m_experiment, std::size_t(m_experiment.valueOf(run)), m_recording.get());
    const LineSettings line = lineAt(placement);
    return m_recording ? inject(line, placement, settings) : simulate(line, placement, settings);
}

LineSettings SweepTrials::lineAt(const Placement &placement) const
{
    RecordingInfo info;
    info.sampleRateHz = m_experiment.sampleRateHz;
    if (m_recording)
        info = m_recording->info();
    const SelectionSettings &selection = m_experiment.settings.selection;
    const bool isWhole = isWholeBand(selection);
    const double start = info.isComplex ? -0.5 * info.sampleRateHz : 0.0;
    const double end = 0.5 * info.sampleRateHz;
    const double lowest = isWhole ? start : std::max(start, selection.lowHz);
    const double highest = isWhole ? end : std::min(end, selection.highHz);
    const double travel = m_experiment.driftHzPerSecond * m_experiment.durationSeconds;
    const double low = lowest + bandMargin * (highest - lowest) + 4.0 * m_experiment.wanderHz + std::max(0.0, -travel);
    const double high = highest - bandMargin * (highest - lowest) - 4.0 * m_experiment.wanderHz - std::max(0.0, travel);
    if (!(low < high))
        throw Error("driftHzPerSecond, wanderHz",
                    "a line must stay within the band of " + formatNumber(highest - lowest) + " Hz");
    LineSettings line;
    line.snrDb = m_experiment.snrDb;
    line.referenceSeconds = m_experiment.settings.spectrogram.windowSeconds;
    line.startSeconds = m_experiment.marginSeconds;
    line.durationSeconds = m_experiment.durationSeconds;
    line.frequencyHz = info.centreHz + low + placement.inBand * (high - low);
    line.driftHzPerSecond = m_experiment.driftHzPerSecond;
    line.wanderHz = m_experiment.wanderHz;
    line.wanderSeconds = m_experiment.wanderSeconds;
    return line;
}

SweepTrials::Made SweepTrials::simulate(const LineSettings &line, const Placement &placement,
                                        const AnalysisSettings &settings) const
{
    LineScene scene;
    scene.sampleRateHz = m_experiment.sampleRateHz;
    scene.durationSeconds = m_experiment.trialSeconds();
    scene.seed = int(placement.seed % 2147483647);
    scene.lines = {line};
    const auto simulated = std::make_shared<SimulatedRecording>(scene);
    Made made{simulated, simulated->truth().lines.front(), settings};
    made.settings.selection.fromSeconds = made.settings.selection.toSeconds = 0.0;
    made.settings.selection.channel = 0;
    return made;
}

SweepTrials::Made SweepTrials::inject(LineSettings line, const Placement &placement,
                                      const AnalysisSettings &settings) const
{
    const SelectionSettings &selection = m_experiment.settings.selection;
    const double recorded = m_recording->info().durationSeconds();
    const double whole = m_experiment.trialSeconds();
    const double from = selection.fromSeconds;
    const double to = selection.toSeconds > from ? std::min(selection.toSeconds, recorded) : recorded;
    if (to - from < whole)
        throw Error("durationSeconds, marginSeconds", "a trial of " + formatNumber(whole)
                                                          + " s must fit into the selection of "
                                                          + formatNumber(to - from) + " s");
    const double begin = from + placement.inTime * (to - from - whole);
    line.startSeconds += begin;
    Made made{nullptr, {}, settings};
    made.settings.selection.fromSeconds = begin;
    made.settings.selection.toSeconds = begin + whole;
    AnalysisSettings placing = m_experiment.settings; // the line is the same for every value
    placing.selection = made.settings.selection;
    const InjectedLine injected = scaledInjection(line, m_recording, placing);
    const auto with =
        std::make_shared<InjectedRecording>(m_recording, std::vector{injected}, selection.channel, placement.seed);
    made.truth = with->truth().lines.front();
    made.recording = with;
    return made;
}

std::vector<RunOutcome> SweepTrials::run(const std::vector<int> &runs, const RunContext &context,
                                         const RunSink &sink) const
{
    std::vector<RunOutcome> outcomes(runs.size());
    std::mutex guard;
    parallelFor(std::ssize(runs), context, "trying values", [&] {
        return [&](Index i) {
            RunOutcome &outcome = outcomes[std::size_t(i)];
            const int run = runs[std::size_t(i)];
            const Made made = remake(run);
            RunContext quiet;
            quiet.stop = context.stop;
            outcome = scored(run, *analyse(made.recording, made.settings, {}, quiet), made.truth);
            if (sink) {
                const std::lock_guard lock(guard);
                sink(outcome);
            }
        };
    });
    return outcomes;
}

std::vector<double> SweepTrials::costs(const RunContext &context) const
{
    std::vector<double> seconds;
    RunContext quiet;
    quiet.stop = context.stop;
    for (std::size_t i = 0; i < m_experiment.values.size(); ++i) {
        context.checkpoint(double(i) / double(m_experiment.values.size()), "measuring the cost");
        const Made made = remake(int(i));
        seconds.push_back(measureCost(*analyse(made.recording, made.settings, {}, quiet), quiet));
    }
    return seconds;
}

} // namespace faintline

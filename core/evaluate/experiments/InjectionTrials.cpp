#include "evaluate/experiments/InjectionTrials.h"

#include "analyse/analyse.h"
#include "base/Error.h"
#include "base/Random.h"
#include "calibrate/calibrate.h"
#include "evaluate/experiments/lineDetection.h"
#include "plan/chain.h"
#include "plan/slopeUnit.h"
#include "scene/InjectedRecording.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace faintline {

namespace {

    constexpr Index framesBefore = 100; ///< let the detectors settle before the line begins
    constexpr double cellsAside = 24.0; ///< margin of the examined band beyond the range of the line
    constexpr double cellsOfBlock = 12.0;
    constexpr double cellsToSignals = 2.0;  ///< least distance of a line's path from the nearest signal
    constexpr double certainSignals = 1e-3; ///< fraction of the requested false-alarm rate at which a detection is
                                            ///< taken for a signal
    constexpr int attempts = 1000;
    constexpr float belowAnyStatistic = -std::numeric_limits<float>::infinity();

    /// Normalised frames of a selection, with the levels of its background: clicks are detected only in a whole band.
    std::shared_ptr<const NormalisedSpectrogram> framesOf(std::shared_ptr<const Spectrogram> spectrogram,
                                                          std::shared_ptr<const NoiseBackground> background,
                                                          NormaliserSettings noise)
    {
        noise.followLevel = false;
        return std::make_shared<NormalisedSpectrogram>(std::move(spectrogram), std::move(background), noise);
    }

    /// Calls take(frame, y) for every frame.
    template <class Take>
    void forEachFrame(const NormalisedFrames &frames, const RunContext &context, const char *what, Take take)
    {
        std::vector<float> y(std::size_t(frames.grid().size()));
        const Index count = frames.time().count;
        for (Index frame = 0; frame < count; ++frame) {
            if (frame % 64 == 0)
                context.checkpoint(double(frame) / double(count), what);
            frames.read(frame, 1, y);
            take(frame, std::span<float>(y));
        }
    }

    /// Mask of everything that the detectors' chains track, including the boxes that were inhibited meanwhile, and of
    /// what was not observed.
    SignalMask signalsFoundBy(const std::vector<AnalysisPlan> &plans, const RunContext &context)
    {
        const NormalisedFrames &frames = *plans.front().frames;
        SignalMask mask(frames.time().count, frames.grid().size());
        std::vector<std::unique_ptr<DetectionChain>> chains;
        for (const AnalysisPlan &plan : plans)
            chains.push_back(makeChain(plan, makePathDetector(plan)));
        std::vector<float> statistic(std::size_t(frames.grid().size()));
        forEachFrame(frames, context, "searching for signals", [&](Index frame, std::span<float> y) {
            const auto isObserved = [](float value) { return !std::isnan(value); };
            for (auto first = std::ranges::find_if_not(y, isObserved); first != y.end();) {
                const auto end = std::find_if(first, y.end(), isObserved);
                mask.add(frame, first - y.begin(), end - y.begin() - 1);
                first = std::find_if_not(end, y.end(), isObserved);
            }
            for (const auto &chain : chains) {
                chain->update(frame, y, statistic);
                for (const CellBox &box : chain->inhibited())
                    mask.add(frame, box.centre.front() - box.halfWidth.front(),
                             box.centre.front() + box.halfWidth.front());
            }
        });
        for (std::size_t d = 0; d < chains.size(); ++d) {
            chains[d]->finish();
            const SpectrogramSettings &settings = plans[d].settings.spectrogram;
            const auto aside =
                Index(std::ceil(plans[d].settings.decide.inhibitCells.front() * frameGeometry(settings).binsPerCell));
            for (const Track &track : chains[d]->tracks())
                for (const TrackPoint &point : track.points)
                    mask.add(point.frame, point.cell - aside, point.cell + aside);
        }
        return mask;
    }

    /// Largest statistic of every detector in each block of the recording that does not consist of signals alone.
    std::vector<std::vector<float>> blockMaxima(const std::vector<AnalysisPlan> &plans, const SignalMask &mask,
                                                Index blockFrames, Index blockBins, const RunContext &context)
    {
        const NormalisedFrames &frames = *plans.front().frames;
        const Index bins = frames.grid().size();
        const Index columns = std::max<Index>(1, bins / blockBins);
        std::vector<std::unique_ptr<Detector>> detectors;
        for (const AnalysisPlan &plan : plans)
            detectors.push_back(makeDetector(plan));
        std::vector<std::vector<float>> maxima(detectors.size());
        std::vector<std::vector<float>> open(detectors.size());
        std::vector<bool> isFree(static_cast<std::size_t>(columns));
        const auto close = [&] {
            for (std::size_t d = 0; d < detectors.size(); ++d)
                for (std::size_t column = 0; column < open[d].size(); ++column)
                    if (isFree[column])
                        maxima[d].push_back(open[d][column]);
        };
        std::vector<float> statistic(static_cast<std::size_t>(bins));
        forEachFrame(frames, context, "counting false alarms", [&](Index frame, std::span<float> y) {
            if (frame % blockFrames == 0) {
                close();
                open.assign(detectors.size(), std::vector<float>(std::size_t(columns), belowAnyStatistic));
                isFree.assign(isFree.size(), false);
            }
            mask.blank(frame, 0, y);
            for (std::size_t d = 0; d < detectors.size(); ++d) {
                detectors[d]->update(y, statistic);
                for (Index bin = 0; bin < bins; ++bin) {
                    if (y[std::size_t(bin)] == 0.0f)
                        continue;
                    const auto column = std::size_t(std::min(bin / blockBins, columns - 1));
                    isFree[column] = true;
                    open[d][column] = std::max(open[d][column], statistic[std::size_t(bin)]);
                }
            }
        });
        close();
        return maxima;
    }

} // namespace

struct InjectionTrials::Shared {
    RecordingPointer recording;
    std::shared_ptr<const Spectrogram> spectrogram; ///< of the whole selection
    std::shared_ptr<const NoiseBackground> background;
    std::vector<ResetRule> rules;
    std::optional<SignalMask> signals;
};

InjectionTrials::InjectionTrials(const Experiment &experiment, RecordingPointer recording, const RunContext &context)
    : m_experiment(experiment)
{
    checkExperiment(experiment);
    if (!recording)
        throw Error("recording", "must be the path of a recording");
    if (experiment.settings.noise.causal)
        throw fieldError("noise.causal", "true",
                         "is not possible in this experiment, which estimates the noise once for all trials");
    auto shared = std::make_unique<Shared>();
    shared->recording = std::move(recording);
    shared->spectrogram = std::make_shared<Spectrogram>(shared->recording, experiment.settings.spectrogram,
                                                        experiment.settings.selection);
    const Axis &time = shared->spectrogram->time();
    if (experiment.durationSeconds >= double(time.count) * time.step)
        throw fieldError("durationSeconds", formatNumber(experiment.durationSeconds),
                         "must be shorter than the selection, " + formatNumber(double(time.count) * time.step) + " s");
    shared->background = estimateBackground(*shared->spectrogram, experiment.settings.noise, context.part(0.0, 0.2));
    const double cellFramesPerHour = cellFramesInAnHour(experiment.settings, *shared->spectrogram);
    const double ordered = experiment.falseAlarmsPerHour / cellFramesPerHour;
    const auto frames = framesOf(shared->spectrogram, shared->background, experiment.settings.noise);
    std::vector<AnalysisPlan> plans;
    for (std::size_t d = 0; d < experiment.detectors.size(); ++d) {
        const AnalysisSettings settings =
            withSlopesInBins(settingsOf(experiment, d), shared->spectrogram->recording().info());
        const auto n = double(experiment.detectors.size());
        const auto calibration = calibrateBand(settings, *shared->spectrogram,
                                               context.part(0.2 + 0.6 * double(d) / n, 0.2 + 0.6 * double(d + 1) / n));
        const auto *smd = std::get_if<SmdSettings>(&settings.detector);
        shared->rules.push_back(smd ? resetRule(*smd, calibration->lnK) : ResetRule{});
        AnalysisPlan plan;
        plan.settings = settings;
        plan.frames = frames;
        plan.model = makeModel(settings.model, frames->grid());
        plan.calibration = calibration;
        plan.threshold = calibration->thresholdForEventRate(certainSignals * ordered);
        plans.push_back(std::move(plan));
    }
    shared->signals = signalsFoundBy(plans, context.part(0.8, 0.9));
    const auto blockFrames = std::max<Index>(1, Index(std::lround(experiment.durationSeconds / time.step)));
    const auto blockBins = Index(std::lround(cellsOfBlock * shared->spectrogram->binsPerCell()));
    const auto maxima = blockMaxima(plans, *shared->signals, blockFrames, blockBins, context.part(0.9, 1.0));
    const double falseAlarms =
        ordered * shared->signals->freeShare() * double(time.count) * double(frames->grid().size());
    for (std::size_t d = 0; d < plans.size(); ++d)
        m_thresholds.push_back(experiment.detectors[d].isWhole
                                   ? 0.0 // of a margin
                                   : measuredThreshold(maxima[d], falseAlarms, *plans[d].calibration, ordered));
    m_shared = std::move(shared);
}

InjectionTrials::~InjectionTrials() = default;

MadeTrial InjectionTrials::remake(int trial, double snrDb) const
{
    const Spectrogram &spectrogram = *m_shared->spectrogram;
    const RecordingInfo &info = m_shared->recording->info();
    const auto seed = std::uint64_t(m_experiment.seed);
    Random places(seed, std::uint64_t(trial));
    const Axis &time = spectrogram.time();
    const Axis &frequency = spectrogram.frequency();
    const double window = spectrogram.windowSeconds();
    const double begin = time.first - 0.5 * window;
    const double room = double(time.count - 1) * time.step + window - m_experiment.durationSeconds;
    const double travel = m_experiment.driftHzPerSecond * m_experiment.durationSeconds;
    const double margin = 2.0 / window + 4.0 * m_experiment.wanderHz;
    const double low = frequency.first + margin + std::max(0.0, -travel);
    const double high = frequency.last() - margin - std::max(0.0, travel);
    if (!(low < high))
        throw Error("driftHzPerSecond, wanderHz", "a line must stay within the selected band of "
                                                      + formatNumber(frequency.last() - frequency.first) + " Hz");
    InjectedLine injected{lineOf(m_experiment, snrDb, window)};
    LineSettings &line = injected.line;
    double offsetHz = 0.0;
    const auto isFree = [&] {
        const auto aside =
            Index(std::ceil(cellsToSignals * spectrogram.binsPerCell() + 4.0 * m_experiment.wanderHz / frequency.step));
        const auto last = Index(std::ceil(time.position(line.startSeconds + line.durationSeconds)));
        for (auto frame = Index(std::floor(time.position(line.startSeconds))); frame <= last; ++frame) {
            const double elapsed = std::clamp(time.value(double(frame)) - line.startSeconds, 0.0, line.durationSeconds);
            const Index bin = frequency.nearest(offsetHz + m_experiment.driftHzPerSecond * elapsed);
            if (m_shared->signals->touches(frame, bin - aside, bin + aside))
                return false;
        }
        return true;
    };
    int attempt = 0;
    do {
        line.startSeconds = begin + places.uniform() * room;
        offsetHz = low + places.uniform() * (high - low);
    } while (!isFree() && ++attempt < attempts);
    if (attempt == attempts)
        throw fieldError("durationSeconds", formatNumber(m_experiment.durationSeconds),
                         "must be shorter: no part of the selection is free of signals for that long");
    line.frequencyHz = info.centreHz + offsetHz;
    const double middle = line.startSeconds + 0.5 * line.durationSeconds;
    const double noisePower = std::exp(m_shared->background->lnPowerAt(middle, offsetHz + 0.5 * travel));
    injected.amplitude = toneAmplitude(snrDb, noisePower, double(spectrogram.windowSamples()), info.isComplex);
    // The tone's phase and wander are determined by the trial, too.
    const std::uint64_t own = seed * 1000003 + std::uint64_t(trial);
    const auto made = std::make_shared<InjectedRecording>(m_shared->recording, std::vector{injected},
                                                          m_experiment.settings.selection.channel, own);
    return {made, made->truth().lines.front()};
}

/// Runs the detectors on the band around one trial's line.
class InjectionTrials::LineReading
{
public:
    LineReading(const InjectionTrials &trials, const MadeTrial &made, bool hasLine)
        : m_experiment(trials.m_experiment), m_shared(*trials.m_shared), m_truth(made.truth),
          m_frames(framesAround(hasLine ? made.recording : m_shared.recording))
    {
        const Axis &time = m_shared.spectrogram->time();
        const Index lastNeeded = std::min(time.count - 1, Index(std::ceil(time.position(m_truth.endSeconds))));
        const Index firstNeeded =
            std::max<Index>(0, Index(std::floor(time.position(m_truth.startSeconds))) - framesBefore);
        const Grid &grid = m_frames->grid();
        for (std::size_t d = 0; d < m_experiment.detectors.size(); ++d) {
            const AnalysisSettings settings = withSlopesInBins(settingsOf(m_experiment, d), m_shared.recording->info());
            // Blocks are aligned as in the whole recording, and the block in which the line ends is completed.
            const Index block = framesPerDecision(settings.detector, frameGeometry(settings.spectrogram));
            const Index blockEnd =
                block == 1 ? lastNeeded : std::min(time.count - 1, (lastNeeded / block + 1) * block - 1);
            m_readFrames.push_back({firstNeeded / block * block, blockEnd, block > 1});
            m_detectors.push_back(makeDetector(settings.detector, makeModel(settings.model, grid), grid,
                                               frameGeometry(settings.spectrogram), m_shared.rules[d]));
        }
    }

    /// Largest statistic of every detector on the line's path.
    std::vector<float> largest()
    {
        const Axis &time = m_shared.spectrogram->time();
        const Index firstBin = m_shared.spectrogram->frequency().nearest(m_frames->grid().axes.front().first);
        const auto [first, last] = frameRange();
        std::vector<float> largest(m_detectors.size(), belowAnyStatistic);
        std::vector<float> y(std::size_t(m_frames->grid().size()));
        std::vector<float> statistic(y.size());
        for (Index frame = first; frame <= last; ++frame) {
            m_frames->read(frame, 1, y);
            m_shared.signals->blank(frame, firstBin, y);
            const double seconds = time.value(double(frame));
            const Bins path = pathAt(seconds);
            for (std::size_t d = 0; d < m_detectors.size(); ++d) {
                if (frame < m_readFrames[d].first || frame > m_readFrames[d].last)
                    continue;
                m_detectors[d]->update(y, statistic);
                if (seconds < m_truth.startSeconds || (seconds > m_truth.endSeconds && !m_readFrames[d].waits))
                    continue;
                for (Index bin = path.from; bin <= path.to; ++bin)
                    largest[d] = std::max(largest[d], statistic[std::size_t(bin)]);
            }
        }
        return largest;
    }

private:
    struct ReadFrames {
        Index first;
        Index last;
        bool waits; ///< until the first block end after the line
    };

    std::shared_ptr<const NormalisedSpectrogram> framesAround(const RecordingPointer &recording) const
    {
        const Spectrogram &whole = *m_shared.spectrogram;
        const double centreHz = m_shared.recording->info().centreHz;
        const double aside = cellsAside * whole.frequency().step * whole.binsPerCell();
        const auto [low, high] = std::minmax_element(m_truth.frequencyHz.begin(), m_truth.frequencyHz.end());
        SelectionSettings selection = m_experiment.settings.selection;
        selection.lowHz = std::max(whole.frequency().first, *low - centreHz - aside);
        selection.highHz = std::min(whole.frequency().last(), *high - centreHz + aside);
        return framesOf(std::make_shared<Spectrogram>(recording, whole.settings(), selection), m_shared.background,
                        m_experiment.settings.noise);
    }

    std::pair<Index, Index> frameRange() const
    {
        ReadFrames all = m_readFrames.front();
        for (const ReadFrames &each : m_readFrames) {
            all.first = std::min(all.first, each.first);
            all.last = std::max(all.last, each.last);
        }
        return {all.first, all.last};
    }

    struct Bins {
        Index from;
        Index to;
    };

    /// Bins in which the line is searched for: its path, then the neighbourhood of its end.
    Bins pathAt(double seconds) const
    {
        const double binsPerCell = m_shared.spectrogram->binsPerCell();
        const auto onLine = Index(std::floor(0.5 * binsPerCell));
        const auto afterIt = Index(std::ceil(m_experiment.settings.decide.inhibitCells.front() * binsPerCell));
        const Axis &axis = m_frames->grid().axes.front();
        const double hz = m_truth.frequencyAt(std::min(seconds, m_truth.endSeconds));
        const Index bin = axis.nearest(hz - m_shared.recording->info().centreHz);
        const Index aside = seconds > m_truth.endSeconds ? afterIt : onLine;
        return {std::max<Index>(0, bin - aside), std::min(axis.count - 1, bin + aside)};
    }

    const Experiment &m_experiment;
    const Shared &m_shared;
    const TruthLine &m_truth;
    std::shared_ptr<const NormalisedSpectrogram> m_frames;
    std::vector<std::unique_ptr<Detector>> m_detectors;
    std::vector<ReadFrames> m_readFrames;
};

AnalysisSettings InjectionTrials::wholeSettings(std::size_t detector, const TruthLine &line) const
{
    AnalysisSettings settings = m_experiment.detectors[detector].settings;
    settings.decide.by = DecideSettings::By::FalseAlarmsPerHour;
    settings.decide.falseAlarmsPerHour = m_experiment.falseAlarmsPerHour;
    SelectionSettings &selection = settings.selection = m_experiment.settings.selection;
    const double recorded = m_shared->recording->info().durationSeconds();
    const double last = selection.toSeconds > selection.fromSeconds ? selection.toSeconds : recorded;
    selection.fromSeconds = std::max(selection.fromSeconds, line.startSeconds - m_experiment.marginSeconds);
    selection.toSeconds = std::min(last, line.endSeconds + m_experiment.marginSeconds);
    return settings;
}

RunOutcome InjectionTrials::outcomeOf(int trial, const RunContext &quiet) const
{
    const auto largestOn = [&](double snrDb, bool hasLine) {
        const MadeTrial made = remake(trial, snrDb);
        std::vector<float> largest = LineReading(*this, made, hasLine).largest();
        for (std::size_t d = 0; d < largest.size(); ++d)
            if (m_experiment.detectors[d].isWhole)
                largest[d] =
                    float(lineDetection(*analyse(hasLine ? made.recording : m_shared->recording,
                                                 wholeSettings(d, made.truth), {.depth = AnalysisDepth::Tracks}, quiet),
                                        made.truth)
                              .margin);
        return largest;
    };
    RunOutcome outcome;
    outcome.run = trial;
    outcome.signal.resize(m_experiment.detectors.size());
    for (const float value : largestOn(0.0, false))
        outcome.noise.push_back({value});
    for (const double snrDb : m_experiment.snrDb) {
        const std::vector<float> largest = largestOn(snrDb, true);
        for (std::size_t d = 0; d < largest.size(); ++d)
            outcome.signal[d].push_back({largest[d]});
    }
    return outcome;
}

SignalMask::SignalMask(Index frames, Index bins) : m_bins(bins), m_stretches(std::size_t(frames)) {}

void SignalMask::add(Index frame, Index low, Index high)
{
    low = std::max<Index>(low, 0);
    high = std::min(high, m_bins - 1);
    if (frame < 0 || frame >= std::ssize(m_stretches) || low > high)
        return;
    auto &stretches = m_stretches[std::size_t(frame)];
    const auto first =
        std::find_if(stretches.begin(), stretches.end(), [low](const auto &one) { return one.second + 1 >= low; });
    auto last = first;
    for (; last != stretches.end() && last->first <= high + 1; ++last) {
        low = std::min(low, last->first);
        high = std::max(high, last->second);
    }
    stretches.insert(stretches.erase(first, last), {low, high});
}

bool SignalMask::touches(Index frame, Index low, Index high) const
{
    if (frame < 0 || frame >= std::ssize(m_stretches))
        return false;
    const auto &stretches = m_stretches[std::size_t(frame)];
    return std::any_of(stretches.begin(), stretches.end(),
                       [&](const auto &one) { return one.first <= high && one.second >= low; });
}

void SignalMask::blank(Index frame, Index firstBin, std::span<float> y) const
{
    for (const auto &[low, high] : m_stretches[std::size_t(frame)]) {
        const Index from = std::max<Index>(low - firstBin, 0);
        const Index to = std::min(high - firstBin, std::ssize(y) - 1);
        for (Index i = from; i <= to; ++i)
            y[std::size_t(i)] = 0.0f;
    }
}

double SignalMask::freeShare() const
{
    double taken = 0.0;
    for (const auto &stretches : m_stretches)
        for (const auto &[low, high] : stretches)
            taken += double(high - low + 1);
    return 1.0 - taken / (double(m_bins) * double(m_stretches.size()));
}

double measuredThreshold(std::vector<float> maxima, double falseAlarms, const Calibration &calibration,
                         double eventsPerCellFrame)
{
    constexpr double countedAlarmsMinimum = 10.0;
    const auto blocks = double(maxima.size());
    const double counted = std::max(falseAlarms, std::min(countedAlarmsMinimum, 0.5 * blocks));
    const auto exceeding = std::size_t(std::llround(blocks * -std::expm1(-counted / blocks)));
    std::sort(maxima.begin(), maxima.end(), std::greater<>());
    const double calibrated = calibration.thresholdForEventRate(eventsPerCellFrame);
    if (exceeding == 0 || exceeding >= maxima.size() || !std::isfinite(maxima[exceeding]))
        return calibrated;
    const double measured = 0.5 * (double(maxima[exceeding - 1]) + double(maxima[exceeding]));
    return measured + calibrated - calibration.thresholdForEventRate(eventsPerCellFrame * counted / falseAlarms);
}

} // namespace faintline

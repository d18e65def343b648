#include "evaluate/experiments/LineTrials.h"

#include "analyse/analyse.h"
#include "base/Random.h"
#include "base/logmath.h"
#include "base/multiversion.h"
#include "base/parallel.h"
#include "calibrate/constants.h"
#include "calibrate/fitReset.h"
#include "evaluate/experiments/lineDetection.h"
#include "plan/Calibration.h"
#include "scene/Tone.h"
#include "signal/ArrayRecording.h"
#include "signal/Fft.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    Grid gridOf(const Experiment &experiment)
    {
        return {{Axis{"frequency", "cells", 0.0, 1.0 / experiment.binsPerCell, experiment.bins(), false}}};
    }

    /// Fields of the experiment's noise with numbers that no run uses, for the calibration of K. They are longer than
    /// the runs if a detector would not settle within those.
    std::vector<NormalisedFramesPointer> calibrationNoise(Experiment experiment, const RunContext &context)
    {
        constexpr int fields = 4;
        if (experiment.frames <= settlingFrames)
            experiment.frames = 2 * settlingFrames;
        std::vector<NormalisedFramesPointer> noise(fields);
        parallelFor(fields, context, "calibrating K on noise", [&] {
            return [&](Index i) {
                NoisyField field;
                makeNoise(experiment, std::numeric_limits<int>::max() - int(i), field);
                field.signal.assign(field.noise.size(), {});
                std::vector<float> y(field.noise.size());
                const Index bins = experiment.bins();
                for (Index frame = 0; frame < experiment.frames; ++frame)
                    powerOf(field, bins, frame, 0.0f,
                            std::span(y).subspan(std::size_t(frame * bins), std::size_t(bins)));
                const Axis time{"time", "windows", 0.0, 1.0 / experiment.stepsPerWindow, experiment.frames, false};
                noise[std::size_t(i)] = std::make_shared<FrameArray>(time, gridOf(experiment), std::move(y));
            };
        });
        return noise;
    }

    FrameGeometry geometryOf(const Experiment &experiment)
    {
        return {double(experiment.stepsPerWindow), double(experiment.binsPerCell)};
    }

    /// Phase of a detector's blocks within the run. Lines begin at random in their noise blocks; the golden ratio
    /// covers all phases within few runs.
    Index blockPhase(int run, Index framesPerBlock)
    {
        const double turns = 0.6180339887498949 * (run + 1);
        return Index((turns - std::floor(turns)) * double(framesPerBlock));
    }

    constexpr float belowEachStatistic = -std::numeric_limits<float>::infinity();

    /// Runs all detectors on the field of one run.
    class Run
    {
    public:
        Run(const Experiment &experiment, int number, const std::vector<MarkovModel> &models,
            const std::vector<ResetRule> &resets)
            : m_experiment(experiment), m_number(number), m_models(models), m_resets(resets),
              m_field(makeField(experiment, number)), m_signals(std::size_t(experiment.signalsPerRun()))
        {
            for (const DetectorUnderTest &one : experiment.detectors)
                m_waits.push_back(framesPerDecision(one.settings.detector, geometryOf(experiment)) - 1);
        }

        RunOutcome outcome(const RunContext &context) const
        {
            RunOutcome outcome;
            outcome.run = m_number;
            outcome.noise = largestInBlocks();
            replaceByMargins(outcome.noise, 0.0f, context,
                             [this](const Analysis &analysis) { return marginsInBlocks(analysis); });
            outcome.signal.assign(m_waits.size(), {});
            for (const double snrDb : m_experiment.snrDb) {
                const auto amplitude = float(std::sqrt(ratioFromDb(snrDb)));
                Largest largest = largestOnLines(amplitude);
                replaceByMargins(largest, amplitude, context,
                                 [this](const Analysis &analysis) { return marginsOnLines(analysis); });
                for (std::size_t d = 0; d < m_waits.size(); ++d)
                    outcome.signal[d].push_back(largest[d]);
            }
            return outcome;
        }

    private:
        using Largest = std::vector<std::vector<float>>; ///< [detector][block or signal]

        Largest lowestOfAll() const
        {
            return Largest(m_waits.size(), std::vector<float>(m_signals, belowEachStatistic));
        }

        std::vector<std::unique_ptr<Detector>> detectorsAtWork() const
        {
            std::vector<std::unique_ptr<Detector>> detectors;
            for (std::size_t d = 0; d < m_waits.size(); ++d) {
                FrameGeometry geometry = geometryOf(m_experiment);
                geometry.blockPhase = blockPhase(m_number, m_waits[d] + 1);
                detectors.push_back(makeDetector(m_experiment.detectors[d].settings.detector, m_models[d],
                                                 gridOf(m_experiment), geometry, m_resets[d]));
            }
            return detectors;
        }

        Index blockedFrames() const { return Index(m_experiment.blocksInTime()) * m_experiment.blockFrames; }

        /// Runs all detectors over the field's frames and calls visit(detector, frame, statistic) for each.
        template <class Visit>
        void detect(float amplitude, Index frames, Visit visit) const
        {
            const auto detectors = detectorsAtWork();
            std::vector<float> y(std::size_t(m_experiment.bins()));
            std::vector<float> statistic(y.size());
            for (Index frame = 0; frame < frames; ++frame) {
                powerOf(m_field, m_experiment.bins(), frame, amplitude, y);
                for (std::size_t d = 0; d < detectors.size(); ++d) {
                    detectors[d]->update(y, statistic);
                    visit(d, frame, statistic);
                }
            }
        }

        /// On noise alone.
        Largest largestInBlocks() const
        {
            Largest result = lowestOfAll();
            detect(0.0f, blockedFrames(), [&](std::size_t d, Index frame, const std::vector<float> &statistic) {
                const Index row = frame / m_experiment.blockFrames * m_experiment.blocksInFrequency();
                for (Index column = 0; column < m_experiment.blocksInFrequency(); ++column) {
                    const auto from = statistic.begin() + column * m_experiment.blockBins;
                    float &largest = result[d][std::size_t(row + column)];
                    largest = std::max(largest, *std::max_element(from, from + m_experiment.blockBins));
                }
            });
            return result;
        }

        /// A detector that decides at the end of blocks is also read at the first block end after the line, at most one
        /// block later, within one resolution cell of the line's end. In the frames between, its value is -∞.
        Largest largestOnLines(float amplitude) const
        {
            Largest result = lowestOfAll();
            const Index longestWait = *std::max_element(m_waits.begin(), m_waits.end());
            detect(amplitude, longestWait > 0 ? m_experiment.frames : blockedFrames(),
                   [&](std::size_t d, Index frame, const std::vector<float> &statistic) {
                       for (std::size_t i = 0; i < m_signals; ++i)
                           readLine(m_field.places[i], frame, m_waits[d], statistic, result[d][i]);
                   });
            return result;
        }

        /// The values of `detect` as a whole are margins(analysis) of the field.
        template <class Margins>
        void replaceByMargins(Largest &values, float amplitude, const RunContext &context, Margins margins) const
        {
            for (std::size_t d = 0; d < values.size(); ++d)
                if (m_experiment.detectors[d].isWhole)
                    values[d] =
                        margins(*analyse(recordingOf(m_experiment, m_field, amplitude), wholeSettings(m_experiment, d),
                                         {.depth = AnalysisDepth::Tracks}, context));
        }

        std::vector<float> marginsInBlocks(const Analysis &analysis) const
        {
            std::vector<float> result(m_signals, belowEachStatistic);
            const double blockSeconds = double(m_experiment.blockFrames) / m_experiment.stepsPerWindow;
            const double blockHz = double(m_experiment.blockBins) / m_experiment.binsPerCell;
            for (const Event &event : events(analysis)) {
                const double hz = analysis.recording->info().centreHz + event.detectedPosition.front();
                const auto row = Index(event.detectSeconds / blockSeconds);
                const auto column = Index(hz / blockHz);
                if (row >= m_experiment.blocksInTime() || column < 0 || column >= m_experiment.blocksInFrequency())
                    continue; // beside all blocks
                float &largest = result[std::size_t(row * m_experiment.blocksInFrequency() + column)];
                largest = std::max(largest, float(marginOf(event.statistic, analysis)));
            }
            return result;
        }

        std::vector<float> marginsOnLines(const Analysis &analysis) const
        {
            std::vector<float> result;
            for (const TruthLine &line : m_field.truths)
                result.push_back(float(lineDetection(analysis, line).margin));
            return result;
        }

        void readLine(const Place &place, Index frame, Index wait, const std::vector<float> &statistic,
                      float &largest) const
        {
            const Index k = frame - place.firstFrame;
            const Index frames = std::ssize(place.bins);
            if (k < 0 || k >= frames + wait)
                return;
            const Index onLine = k < frames ? 0 : m_experiment.binsPerCell;
            const Index centre = place.bins[std::size_t(std::min(k, frames - 1))];
            const Index last = std::min<Index>(m_experiment.bins() - 1, centre + onLine);
            for (Index bin = std::max<Index>(0, centre - onLine); bin <= last; ++bin)
                largest = std::max(largest, statistic[std::size_t(bin)]);
        }

        const Experiment &m_experiment;
        int m_number;
        const std::vector<MarkovModel> &m_models;
        const std::vector<ResetRule> &m_resets;
        NoisyField m_field;
        std::size_t m_signals;
        std::vector<Index> m_waits; ///< frames until each detector's next decision
    };

    using Complex = std::complex<float>;

    /// Random streams of one run: its noise and the positions of its signals; wander and phase of a signal come from
    /// Tone.
    constexpr std::uint64_t streamsPerRun = 2;

    RecordingInfo recordingInfo(const Experiment &experiment)
    {
        // One window lasts one second, so that Hz are resolution cells.
        RecordingInfo info;
        info.sampleRateHz = Experiment::windowSamples;
        info.isComplex = true;
        info.centreHz = 0.5 * Experiment::windowSamples; // frequencies 0 … 250 cells
        info.sampleCount = Index(Experiment::windowSamples) * (experiment.frames + experiment.stepsPerWindow - 1)
                           / experiment.stepsPerWindow;
        return info;
    }

    /// The bin where a signal is strongest, near its nominal frequency.
    Index strongestBin(const Experiment &experiment, const std::vector<Complex> &signal, Index frame, double cells,
                       Index lowest)
    {
        const auto expected = Index(std::lround(cells * experiment.binsPerCell));
        const Index reach = 2 * experiment.binsPerCell;
        const Index from = std::clamp<Index>(expected - reach, lowest, lowest + experiment.blockBins - 1);
        const Index to = std::clamp<Index>(expected + reach, lowest, lowest + experiment.blockBins - 1);
        const Complex *row = signal.data() + frame * experiment.bins();
        Index best = from;
        for (Index bin = from + 1; bin <= to; ++bin)
            if (std::norm(row[bin]) > std::norm(row[best]))
                best = bin;
        return best;
    }

    /// Mean frequency, in cells, over a frame's window.
    double meanFrequency(const TruthLine &truth, double windowStart)
    {
        constexpr int points = 8;
        double sum = 0.0;
        for (int i = 0; i < points; ++i)
            sum += truth.frequencyAt(windowStart + (i + 0.5) / points);
        return sum / points;
    }

    /// y = |noise + amplitude·signal|² of interleaved complex values.
    FAINTLINE_MULTIVERSION
    void power(const float *noise, const float *signal, float amplitude, Index n, float *y)
    {
        for (Index i = 0; i < n; ++i) {
            const float re = noise[2 * i] + amplitude * signal[2 * i];
            const float im = noise[2 * i + 1] + amplitude * signal[2 * i + 1];
            y[i] = re * re + im * im;
        }
    }

} // namespace

AnalysisSettings wholeSettings(const Experiment &experiment, std::size_t detector)
{
    AnalysisSettings settings = experiment.detectors[detector].settings;
    settings.selection = {};
    settings.decide.by = DecideSettings::By::FalseAlarmsPerHour;
    settings.decide.falseAlarmsPerHour =
        3600.0 * experiment.blocksInFrequency() * experiment.stepsPerWindow / experiment.blockFrames;
    return settings;
}

LineTrials::LineTrials(const Experiment &experiment, const RunContext &context) : m_experiment(experiment)
{
    checkExperiment(experiment);
    for (const DetectorUnderTest &one : experiment.detectors)
        m_models.push_back(makeModel(one.settings.model, gridOf(experiment)));
    m_resets.resize(m_models.size());
    const auto noise = calibrationNoise(experiment, context);
    parallelFor(std::ssize(m_models), context, "calibrating K on noise", [&] {
        return [&](Index i) {
            const auto d = std::size_t(i);
            if (const auto *smd = std::get_if<SmdSettings>(&experiment.detectors[d].settings.detector))
                m_resets[d] = resetRule(*smd, fitReset(noise, m_models[d], *smd).lnK);
        };
    });
}

RunOutcome LineTrials::outcomeOf(int run, const RunContext &quiet) const
{
    return Run(m_experiment, run, m_models, m_resets).outcome(quiet);
}

LineTrial remakeTrial(const Experiment &experiment, double snrDb, int run, int signal)
{
    checkExperiment(experiment);
    const NoisyField field = makeField(experiment, run);
    const Index firstFrame = Index(signal / experiment.blocksInFrequency()) * experiment.blockFrames;
    const Index firstBin = Index(signal % experiment.blocksInFrequency()) * experiment.blockBins;
    std::vector<float> y(std::size_t(experiment.bins()));
    std::vector<float> block;
    for (Index frame = firstFrame; frame < firstFrame + experiment.blockFrames; ++frame) {
        powerOf(field, experiment.bins(), frame, float(std::sqrt(ratioFromDb(snrDb))), y);
        block.insert(block.end(), y.begin() + firstBin, y.begin() + firstBin + experiment.blockBins);
    }
    LineTrial trial;
    const Axis time{"time", "windows", 0.0, 1.0 / experiment.stepsPerWindow, experiment.blockFrames, false};
    const Axis frequency{
        "frequency",          "cells", double(firstBin) / experiment.binsPerCell, 1.0 / experiment.binsPerCell,
        experiment.blockBins, false};
    trial.frames = std::make_shared<FrameArray>(time, Grid{{frequency}}, std::move(block));
    const Place &place = field.places[std::size_t(signal)];
    trial.firstFrame = place.firstFrame - firstFrame;
    for (const Index bin : place.bins)
        trial.path.push_back(bin - firstBin);
    return trial;
}

MadeTrial remakeField(const Experiment &experiment, double snrDb, int run, int signal)
{
    checkExperiment(experiment);
    const NoisyField field = makeField(experiment, run);
    return {recordingOf(experiment, field, float(std::sqrt(ratioFromDb(snrDb)))), field.truths[std::size_t(signal)]};
}

std::vector<Complex> fieldTransform(const Experiment &experiment, std::span<const float> samples)
{
    const Index bins = experiment.bins();
    const std::vector<float> window = sampleWindow(experiment.window, Experiment::windowSamples);
    const Fft fft(experiment.bins(), Fft::Input::Complex);
    const auto buffer = fft.buffer();
    std::vector<Complex> spectra(std::size_t(experiment.frames * bins));
    for (Index frame = 0; frame < experiment.frames; ++frame) {
        const float *from = samples.data() + 2 * frame * (Experiment::windowSamples / experiment.stepsPerWindow);
        const std::span<float> input = buffer->input();
        for (std::size_t i = 0; i < window.size(); ++i) {
            input[2 * i] = from[2 * i] * window[i];
            input[2 * i + 1] = from[2 * i + 1] * window[i];
        }
        std::fill(input.begin() + std::ptrdiff_t(2 * window.size()), input.end(), 0.0f);
        fft.run(*buffer);
        // The centre frequency is in the middle of the axis.
        const auto spectrum = buffer->output();
        std::rotate_copy(spectrum.begin(), spectrum.end() - bins / 2, spectrum.end(), spectra.begin() + frame * bins);
    }
    return spectra;
}

void makeNoise(const Experiment &experiment, int run, NoisyField &field)
{
    field.noiseSamples.resize(std::size_t(2 * recordingInfo(experiment).sampleCount));
    Random(std::uint64_t(experiment.seed), std::uint64_t(run) * streamsPerRun)
        .normals(field.noiseSamples, float(std::sqrt(0.5)));
    field.noise = fieldTransform(experiment, field.noiseSamples);
}

NoisyField makeField(const Experiment &experiment, int run)
{
    NoisyField field;
    makeNoise(experiment, run, field);
    const RecordingInfo info = recordingInfo(experiment);
    const auto seed = std::uint64_t(experiment.seed);
    field.signalSamples.resize(field.noiseSamples.size());
    Random places(seed, std::uint64_t(run) * streamsPerRun + 1);
    const double amplitude = toneAmplitude(0.0, 1.0, Experiment::windowSamples, true);
    const double blockCells = double(experiment.blockBins) / experiment.binsPerCell;
    const double travel = experiment.driftHzPerSecond * experiment.durationSeconds;
    for (int i = 0; i < experiment.signalsPerRun(); ++i) {
        const int blockInTime = i / experiment.blocksInFrequency();
        const int blockInFrequency = i % experiment.blocksInFrequency();
        Place place;
        const Index room = experiment.blockFrames - experiment.signalFrames() + 1;
        place.firstFrame =
            Index(blockInTime) * experiment.blockFrames + std::min(room - 1, Index(places.uniform() * double(room)));
        const double margin = 1.0;
        const double lowest = blockInFrequency * blockCells + margin + std::max(0.0, -travel);
        const double highest = (blockInFrequency + 1) * blockCells - margin - std::max(0.0, travel);
        LineSettings line = lineOf(experiment, 0.0, 1.0);
        line.startSeconds = double(place.firstFrame) / experiment.stepsPerWindow;
        line.frequencyHz = lowest + places.uniform() * (highest - lowest);
        const Tone tone(line, amplitude, info, seed, Index(run) * experiment.signalsPerRun() + i);
        tone.addTo(0, field.signalSamples);
        field.truths.push_back(tone.truth());
        field.places.push_back(std::move(place));
    }
    field.signal = fieldTransform(experiment, field.signalSamples);
    for (std::size_t i = 0; i < field.truths.size(); ++i) {
        Place &place = field.places[i];
        const Index lowest = Index(i) % experiment.blocksInFrequency() * experiment.blockBins;
        for (Index k = 0; k < experiment.signalFrames(); ++k) {
            const Index frame = place.firstFrame + k;
            const double start = double(frame) / experiment.stepsPerWindow;
            place.bins.push_back(
                strongestBin(experiment, field.signal, frame, meanFrequency(field.truths[i], start), lowest));
        }
    }
    return field;
}

RecordingPointer recordingOf(const Experiment &experiment, const NoisyField &field, float amplitude)
{
    const RecordingInfo info = recordingInfo(experiment);
    auto samples = std::make_shared<std::vector<float>>(field.noiseSamples);
    if (amplitude != 0.0f)
        for (std::size_t i = 0; i < samples->size(); ++i)
            (*samples)[i] += amplitude * field.signalSamples[i];
    const std::shared_ptr<const float> first(samples, samples->data());
    return std::make_shared<ArrayRecording>(
        "field", first, ArrayLayout{info.sampleRateHz, info.sampleCount, 1, info.isComplex, info.centreHz});
}

void powerOf(const NoisyField &field, Index bins, Index frame, float amplitude, std::span<float> y)
{
    const auto row = [&](const std::vector<Complex> &values) {
        return reinterpret_cast<const float *>(values.data() + frame * bins);
    };
    power(row(field.noise), row(field.signal), amplitude, bins, y.data());
}

} // namespace faintline

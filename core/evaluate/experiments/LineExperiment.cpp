#include "evaluate/experiments/LineExperiment.h"

#include "analysis/Calibration.h"
#include "base/Error.h"
#include "base/Random.h"
#include "base/logmath.h"
#include "base/multiversion.h"
#include "base/parallel.h"
#include "recording/Tone.h"
#include "spectrum/Fft.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <mutex>

namespace faintline {

namespace {

    using Complex = std::complex<float>;

    /// Streams of one run: its noise, then where its signals lie; the signals' own wander and phase follow from Tone.
    constexpr std::uint64_t streamsPerRun = 2;

    /// A line's true place in the field.
    struct Place {
        Index firstFrame = 0;
        std::vector<Index> bins; ///< one per frame of its duration
    };

    /// The field of one run: noise, and unit-SNR signals to be added at any strength.
    struct NoisyField {
        std::vector<Complex> noise;  ///< frames × bins
        std::vector<Complex> signal; ///< of SNR 1
        std::vector<Place> places;
    };

    RecordingInfo recordingInfo(const LineExperiment &experiment)
    {
        // One window lasts a second, so that Hz are resolution cells.
        RecordingInfo info;
        info.sampleRateHz = LineExperiment::windowSamples;
        info.isComplex = true;
        info.centreHz = 0.5 * LineExperiment::windowSamples; // frequencies 0 … 250 cells
        info.sampleCount = Index(LineExperiment::windowSamples) * (experiment.frames + experiment.stepsPerWindow - 1)
                           / experiment.stepsPerWindow;
        return info;
    }

    /// Sliding transforms of interleaved complex samples, scaled to unit noise variance.
    class Transform
    {
    public:
        explicit Transform(const LineExperiment &experiment)
            : m_hop(LineExperiment::windowSamples / experiment.stepsPerWindow), m_frames(experiment.frames),
              m_bins(experiment.bins()), m_window(sampleWindow(experiment.window, LineExperiment::windowSamples)),
              m_fft(experiment.bins(), Fft::Input::Complex), m_buffer(m_fft.buffer())
        {
        }

        void run(std::span<const float> samples, std::vector<Complex> &out)
        {
            out.resize(std::size_t(m_frames * m_bins));
            for (Index frame = 0; frame < m_frames; ++frame) {
                const float *from = samples.data() + 2 * frame * m_hop;
                const std::span<float> input = m_buffer->input();
                for (std::size_t i = 0; i < m_window.size(); ++i) {
                    input[2 * i] = from[2 * i] * m_window[i];
                    input[2 * i + 1] = from[2 * i + 1] * m_window[i];
                }
                std::fill(input.begin() + std::ptrdiff_t(2 * m_window.size()), input.end(), 0.0f);
                m_fft.run(*m_buffer);
                // The centre frequency stands in the middle of the axis.
                const auto spectrum = m_buffer->output();
                Complex *row = out.data() + frame * m_bins;
                const Index half = m_bins / 2;
                std::copy(spectrum.begin() + (m_bins - half), spectrum.end(), row);
                std::copy(spectrum.begin(), spectrum.begin() + (m_bins - half), row + half);
            }
        }

    private:
        Index m_hop;
        Index m_frames;
        Index m_bins;
        std::vector<float> m_window;
        Fft m_fft;
        std::unique_ptr<Fft::Buffer> m_buffer;
    };

    /// The bin where a signal is strongest, near where its frequency says.
    Index strongestBin(const LineExperiment &experiment, const std::vector<Complex> &signal, Index frame, double cells,
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

    /// Mean frequency, in cells, that a frame's window sees.
    double meanFrequency(const TruthLine &truth, double windowStart)
    {
        constexpr int points = 8;
        double sum = 0.0;
        for (int i = 0; i < points; ++i)
            sum += truth.frequencyAt(windowStart + (i + 0.5) / points);
        return sum / points;
    }

    void makeNoise(const LineExperiment &experiment, int run, Transform &transform, NoisyField &field)
    {
        std::vector<float> samples(std::size_t(2 * recordingInfo(experiment).sampleCount));
        Random(std::uint64_t(experiment.seed), std::uint64_t(run) * streamsPerRun)
            .normals(samples, float(std::sqrt(0.5)));
        transform.run(samples, field.noise);
    }

    NoisyField makeField(const LineExperiment &experiment, int run, Transform &transform)
    {
        NoisyField field;
        makeNoise(experiment, run, transform, field);
        const RecordingInfo info = recordingInfo(experiment);
        const auto seed = std::uint64_t(experiment.seed);
        std::vector<float> samples(std::size_t(2 * info.sampleCount));
        Random places(seed, std::uint64_t(run) * streamsPerRun + 1);
        const double amplitude = toneAmplitude(0.0, 1.0, LineExperiment::windowSamples, true);
        const double blockCells = double(experiment.blockBins) / experiment.binsPerCell;
        const double travel = experiment.driftCellsPerWindow * experiment.durationWindows;
        std::vector<TruthLine> truths;
        for (int i = 0; i < experiment.signalsPerRun(); ++i) {
            const int blockInTime = i / experiment.blocksInFrequency();
            const int blockInFrequency = i % experiment.blocksInFrequency();
            Place place;
            const Index room = experiment.blockFrames - experiment.signalFrames() + 1;
            place.firstFrame = Index(blockInTime) * experiment.blockFrames
                               + std::min(room - 1, Index(places.uniform() * double(room)));
            const double margin = 1.0;
            const double lowest = blockInFrequency * blockCells + margin + std::max(0.0, -travel);
            const double highest = (blockInFrequency + 1) * blockCells - margin - std::max(0.0, travel);
            LineSettings line;
            line.snrDb = 0.0;
            line.referenceSeconds = 1.0;
            line.startSeconds = double(place.firstFrame) / experiment.stepsPerWindow;
            line.durationSeconds = experiment.durationWindows;
            line.frequencyHz = lowest + places.uniform() * (highest - lowest);
            line.driftHzPerSecond = experiment.driftCellsPerWindow;
            line.wanderHz = experiment.wanderCells;
            line.wanderSeconds = experiment.wanderWindows;
            line.fading = experiment.fading;
            line.fadingSeconds = experiment.fadingWindows;
            const Tone tone(line, amplitude, info, seed, Index(run) * experiment.signalsPerRun() + i);
            tone.addTo(0, samples);
            truths.push_back(tone.truth());
            field.places.push_back(std::move(place));
        }
        transform.run(samples, field.signal);
        for (std::size_t i = 0; i < truths.size(); ++i) {
            Place &place = field.places[i];
            const Index lowest = Index(i) % experiment.blocksInFrequency() * experiment.blockBins;
            for (Index k = 0; k < experiment.signalFrames(); ++k) {
                const Index frame = place.firstFrame + k;
                const double start = double(frame) / experiment.stepsPerWindow;
                place.bins.push_back(
                    strongestBin(experiment, field.signal, frame, meanFrequency(truths[i], start), lowest));
            }
        }
        return field;
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

    void powerOf(const NoisyField &field, Index bins, Index frame, float amplitude, std::span<float> y)
    {
        const auto row = [&](const std::vector<Complex> &values) {
            return reinterpret_cast<const float *>(values.data() + frame * bins);
        };
        power(row(field.noise), row(field.signal), amplitude, bins, y.data());
    }

    /// Where the experiment's detectors come from, once K is known.
    struct Recipe {
        MarkovModel model;
        DetectorSettings detector;
        ResetRule rule;
    };

    Grid gridOf(const LineExperiment &experiment)
    {
        return {{Axis{"frequency", "cells", 0.0, 1.0 / experiment.binsPerCell, experiment.bins(), false}}};
    }

    /// Fields of the experiment's own noise, of runs that no experiment reaches, to find K on.
    std::vector<NormalisedFramesPointer> calibrationNoise(const LineExperiment &experiment, const RunContext &context)
    {
        constexpr int fields = 4;
        std::vector<NormalisedFramesPointer> noise(fields);
        parallelFor(fields, context, "calibrating K on noise", [&] {
            return [&, transform = std::make_shared<Transform>(experiment)](Index i) {
                NoisyField field;
                makeNoise(experiment, std::numeric_limits<int>::max() - int(i), *transform, field);
                field.signal.assign(field.noise.size(), Complex());
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

    std::vector<Recipe> recipesOf(const LineExperiment &experiment, const RunContext &context)
    {
        std::vector<Recipe> recipes;
        for (const DetectorUnderTest &detectorUnderTest : experiment.detectors)
            recipes.push_back({makeModel(detectorUnderTest.settings.model, gridOf(experiment)),
                               detectorUnderTest.settings.detector,
                               {}});
        const auto noise = calibrationNoise(experiment, context);
        parallelFor(std::ssize(recipes), context, "calibrating K on noise", [&] {
            return [&](Index i) {
                Recipe &recipe = recipes[std::size_t(i)];
                if (const auto *smd = std::get_if<SmdSettings>(&recipe.detector))
                    recipe.rule = resetRule(*smd, fitReset(noise, recipe.model, *smd).lnK);
            };
        });
        return recipes;
    }

    FrameGeometry geometryOf(const LineExperiment &experiment)
    {
        return {double(experiment.stepsPerWindow), double(experiment.binsPerCell)};
    }

    /// Lines begin at random in their noise blocks, a detector's own blocks at random in the run: by the golden ratio,
    /// so that few runs already have all phases.
    Index blockPhase(int run, Index framesPerBlock)
    {
        const double turns = 0.6180339887498949 * (run + 1);
        return Index((turns - std::floor(turns)) * double(framesPerBlock));
    }

    std::vector<std::unique_ptr<Detector>> detectorsOf(const LineExperiment &experiment,
                                                       const std::vector<Recipe> &recipes, int run)
    {
        std::vector<std::unique_ptr<Detector>> detectors;
        for (const Recipe &recipe : recipes) {
            FrameGeometry geometry = geometryOf(experiment);
            geometry.blockPhase = blockPhase(run, framesPerDecision(recipe.detector, geometry));
            detectors.push_back(makeDetector(recipe.detector, recipe.model, gridOf(experiment), geometry, recipe.rule));
        }
        return detectors;
    }

    constexpr float lowest = -std::numeric_limits<float>::infinity();

    /// Runs all detectors over the frames of a run's field; look(detector, frame, statistic) sees each.
    template <class Look>
    void detect(const LineExperiment &experiment, int run, const std::vector<Recipe> &recipes, const NoisyField &field,
                float amplitude, Index frames, Look look)
    {
        const auto detectors = detectorsOf(experiment, recipes, run);
        std::vector<float> y(std::size_t(experiment.bins()));
        std::vector<float> statistic(y.size());
        for (Index frame = 0; frame < frames; ++frame) {
            powerOf(field, experiment.bins(), frame, amplitude, y);
            for (std::size_t d = 0; d < detectors.size(); ++d) {
                detectors[d]->update(y, statistic);
                look(d, frame, statistic);
            }
        }
    }

    RunOutcome doRun(const LineExperiment &experiment, int run, const std::vector<Recipe> &recipes,
                     Transform &transform)
    {
        const NoisyField field = makeField(experiment, run, transform);
        const auto signals = std::size_t(experiment.signalsPerRun());
        RunOutcome outcome;
        outcome.run = run;
        outcome.noise.assign(recipes.size(), std::vector<float>(signals, lowest));
        const Index frames = Index(experiment.blocksInTime()) * experiment.blockFrames;
        detect(experiment, run, recipes, field, 0.0f, frames,
               [&](std::size_t d, Index frame, const std::vector<float> &statistic) {
                   const Index row = frame / experiment.blockFrames * experiment.blocksInFrequency();
                   for (Index column = 0; column < experiment.blocksInFrequency(); ++column) {
                       const auto from = statistic.begin() + column * experiment.blockBins;
                       float &largest = outcome.noise[d][std::size_t(row + column)];
                       largest = std::max(largest, *std::max_element(from, from + experiment.blockBins));
                   }
               });
        // A detector that decides at the end of blocks is read at the first one after the line, too, one resolution
        // cell to either side of where that ended: at the latest, a block after it. In the frames between it says -∞.
        std::vector<Index> waits;
        for (const Recipe &recipe : recipes)
            waits.push_back(framesPerDecision(recipe.detector, geometryOf(experiment)) - 1);
        const Index longestWait = *std::max_element(waits.begin(), waits.end());
        const Index onLine = experiment.binsPerCell;
        outcome.signal.assign(recipes.size(), std::vector<std::vector<float>>(experiment.snrDb.size(),
                                                                              std::vector<float>(signals, lowest)));
        for (std::size_t s = 0; s < experiment.snrDb.size(); ++s) {
            const auto amplitude = float(std::sqrt(ratioFromDb(experiment.snrDb[s])));
            const auto see = [&](std::size_t d, Index frame, const std::vector<float> &statistic) {
                for (std::size_t i = 0; i < signals; ++i) {
                    const Place &place = field.places[i];
                    const Index k = frame - place.firstFrame;
                    if (k < 0 || k >= std::ssize(place.bins) + waits[d])
                        continue;
                    float &largest = outcome.signal[d][s][i];
                    if (k < std::ssize(place.bins)) {
                        largest = std::max(largest, statistic[std::size_t(place.bins[std::size_t(k)])]);
                        continue;
                    }
                    const Index end = place.bins.back();
                    for (Index bin = std::max<Index>(0, end - onLine);
                         bin <= std::min<Index>(experiment.bins() - 1, end + onLine); ++bin)
                        largest = std::max(largest, statistic[std::size_t(bin)]);
                }
            };
            detect(experiment, run, recipes, field, amplitude, longestWait > 0 ? experiment.frames : frames, see);
        }
        return outcome;
    }

} // namespace

const std::vector<Field<LineExperiment>> &LineExperiment::fields()
{
    using S = LineExperiment;
    static const std::vector<Field<S>> table{
        field(&S::seed, "seed", "", 0.0, 2147483647.0, "Seed of all random numbers."),
        field(&S::runs, "runs", "", 1.0, 1e7, "Number of fields to simulate; each contains one line per block."),
        field(&S::frames, "frames", "frames", 2.0, 1e5, "Length of a field."),
        field(&S::blockFrames, "blockFrames", "frames", 2.0, 1e5, "Length of a block."),
        field(&S::blockBins, "blockBins", "bins", 2.0, 1e5, "Width of a block."),
        field(&S::stepsPerWindow, "stepsPerWindow", "", 1.0, 16.0, "Frames per window, k_t."),
        field(&S::binsPerCell, "binsPerCell", "", 1.0, 16.0, "Bins per resolution cell, k_f."),
        field(&S::window, "window", windowShapeNames, "Shape of the window."),
        field(&S::snrDb, "snrDb", "dB", -60.0, 60.0, "Signal-to-noise ratios in a frame with a rectangular window."),
        field(&S::durationWindows, "durationWindows", "windows", 0.5, 1e5, "Duration of a line."),
        field(&S::driftCellsPerWindow, "driftCellsPerWindow", "cells/window", -100.0, 100.0, "Steady drift of a line."),
        field(&S::wanderCells, "wanderCells", "cells", 0.0, 1000.0, "Standard deviation of a line's wander."),
        field(&S::wanderWindows, "wanderWindows", "windows", 0.01, 1e5, "Correlation time of the wander."),
        field(&S::fading, "fading", fadingNames, "Whether the amplitude fades."),
        field(&S::fadingWindows, "fadingWindows", "windows", 0.01, 1e5, "Correlation time of the fading."),
    };
    return table;
}

int LineExperiment::signalFrames() const
{
    return int(std::lround(durationWindows * stepsPerWindow));
}

void checkExperiment(const LineExperiment &experiment)
{
    checkFields(experiment, LineExperiment::fields());
    if (experiment.detectors.empty())
        throw Error("detectors", "must name at least one detector");
    if (experiment.snrDb.empty())
        throw Error("snrDb", "must hold at least one value");
    if (LineExperiment::windowSamples % experiment.stepsPerWindow != 0)
        throw fieldError("stepsPerWindow", std::to_string(experiment.stepsPerWindow),
                         "must divide 250, the samples of a window");
    if (experiment.blocksInTime() < 1 || experiment.blocksInFrequency() < 1)
        throw Error("blockFrames, blockBins", "a block must fit into the field of " + std::to_string(experiment.frames)
                                                  + " × " + std::to_string(experiment.bins()) + " cells");
    if (experiment.signalFrames() < 1 || experiment.signalFrames() > experiment.blockFrames)
        throw fieldError("durationWindows", formatNumber(experiment.durationWindows),
                         "a line must last 1 … blockFrames = " + std::to_string(experiment.blockFrames) + " frames");
    const double room = double(experiment.blockBins) / experiment.binsPerCell - 4.0;
    if (std::abs(experiment.driftCellsPerWindow) * experiment.durationWindows + 4.0 * experiment.wanderCells > room)
        throw Error("driftCellsPerWindow, wanderCells", "a line must stay within its block of blockBins = "
                                                            + std::to_string(experiment.blockBins) + " bins");
    for (const DetectorUnderTest &detectorUnderTest : experiment.detectors) {
        checkSettings(detectorUnderTest.settings);
        checkHasNoFamily(detectorUnderTest.settings, "is not possible in this experiment");
    }
}

std::vector<DetectorUnderTest> detectorsFromJson(const Json &json, const std::string &where)
{
    const auto list = json.find("detectors");
    if (list == json.end() || !list->is_array() || list->empty())
        throw Error(jsonName(where, "detectors"), "must be a list of {\"name\": …, \"settings\": {…}}");
    std::vector<DetectorUnderTest> detectorsUnderTest;
    for (std::size_t i = 0; i < list->size(); ++i) {
        const std::string name = jsonName(where, "detectors[" + std::to_string(i) + "]");
        const Json &entry = (*list)[i];
        checkKeys(entry, name, {"name", "settings"});
        if (!entry.contains("name") || !entry["name"].is_string())
            throw Error(jsonName(name, "name"), "must be a string");
        DetectorUnderTest detectorUnderTest{entry["name"].get<std::string>(), {}};
        if (entry.contains("settings"))
            detectorUnderTest.settings = settingsFromJson(entry["settings"].dump(), jsonName(name, "settings"));
        detectorsUnderTest.push_back(std::move(detectorUnderTest));
    }
    return detectorsUnderTest;
}

Json toJson(const std::vector<DetectorUnderTest> &detectorsUnderTest)
{
    Json list = Json::array();
    for (const DetectorUnderTest &detectorUnderTest : detectorsUnderTest)
        list.push_back(
            {{"name", detectorUnderTest.name}, {"settings", Json::parse(settingsToJson(detectorUnderTest.settings))}});
    return list;
}

LineExperiment lineExperimentFromJson(const Json &json, const std::string &where)
{
    LineExperiment experiment;
    readFields(json, LineExperiment::fields(), experiment, where, {"kind", "detectors"});
    experiment.detectors = detectorsFromJson(json, where);
    checkExperiment(experiment);
    return experiment;
}

Json toJson(const LineExperiment &experiment)
{
    Json whole{{"kind", "lines"}};
    whole.update(writeFields(experiment, LineExperiment::fields()));
    whole["detectors"] = toJson(experiment.detectors);
    return whole;
}

std::vector<ResetRule> calibratedResets(const LineExperiment &experiment, const RunContext &context)
{
    checkExperiment(experiment);
    std::vector<ResetRule> rules;
    for (const Recipe &recipe : recipesOf(experiment, context))
        rules.push_back(recipe.rule);
    return rules;
}

std::vector<RunOutcome> runExperiment(const LineExperiment &experiment, const std::vector<int> &runs,
                                      const RunContext &context, const RunSink &sink)
{
    checkExperiment(experiment);
    const std::vector<Recipe> recipes = recipesOf(experiment, context.part(0.0, 0.1));
    std::vector<RunOutcome> outcomes(runs.size());
    std::mutex guard;
    parallelFor(std::ssize(runs), context.part(0.1, 1.0), "simulating", [&] {
        return [&, transform = std::make_shared<Transform>(experiment)](Index i) {
            RunOutcome &outcome = outcomes[std::size_t(i)];
            outcome = doRun(experiment, runs[std::size_t(i)], recipes, *transform);
            if (sink) {
                const std::lock_guard lock(guard);
                sink(outcome);
            }
        };
    });
    return outcomes;
}

LineTrial remakeTrial(const LineExperiment &experiment, double snrDb, int run, int signal)
{
    checkExperiment(experiment);
    Transform transform(experiment);
    const NoisyField field = makeField(experiment, run, transform);
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

} // namespace faintline

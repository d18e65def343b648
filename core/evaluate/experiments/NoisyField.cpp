#include "evaluate/experiments/NoisyField.h"

#include "base/Random.h"
#include "base/multiversion.h"
#include "scene/Tone.h"
#include "signal/ArrayRecording.h"
#include "signal/Fft.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

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
        LineSettings line;
        line.snrDb = 0.0;
        line.referenceSeconds = 1.0;
        line.startSeconds = double(place.firstFrame) / experiment.stepsPerWindow;
        line.durationSeconds = experiment.durationSeconds;
        line.frequencyHz = lowest + places.uniform() * (highest - lowest);
        line.driftHzPerSecond = experiment.driftHzPerSecond;
        line.wanderHz = experiment.wanderHz;
        line.wanderSeconds = experiment.wanderSeconds;
        line.fading = experiment.fading;
        line.fadingSeconds = experiment.fadingSeconds;
        line.fluctuation = experiment.fluctuation;
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

#include "scene/SimulatedRecording.h"

#include "base/Random.h"
#include "base/logmath.h"
#include "scene/ornsteinUhlenbeck.h"
#include "signal/ArrayRecording.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace faintline {

namespace {

    const LineScene &checked(const LineScene &scene)
    {
        checkScene(scene);
        return scene;
    }

    constexpr Index whiteBlock = 4096;       ///< floats per random stream
    constexpr Index colouredBlock = 1 << 14; ///< samples
    constexpr Index runUp = 1 << 13;         ///< samples; 25 times the longest time constant
    constexpr double lowestTurns = 0x1p-11;  ///< frequency of the lowest pole in cycles per sample
    constexpr double levelStep = 0.1;        ///< correlation times between nodes of the level

    Index floorDivide(Index a, Index b)
    {
        return a / b - (a % b < 0 ? 1 : 0);
    }

    /// Decay per sample of a first-order section with a corner frequency in cycles per sample.
    double decay(double turns)
    {
        return std::exp(-2.0 * std::numbers::pi * turns);
    }

    /// First-order sections in parallel: d + Σ rₖ/(1 - pₖ/z).
    template <std::size_t sections>
    struct ParallelFilter {
        float direct;
        std::array<float, sections> poles;
        std::array<float, sections> residues;
    };

    /// Filters one component of the samples (every `stride`-th float).
    template <std::size_t sections>
    void run(const ParallelFilter<sections> &filter, float *samples, std::size_t count, std::size_t stride)
    {
        const auto &[direct, poles, residues] = filter;
        std::array<float, sections> state{};
        for (std::size_t i = 0; i < count; ++i) {
            const float x = samples[i * stride];
            for (std::size_t k = 0; k < sections; ++k)
                state[k] = poles[k] * state[k] + residues[k] * x;
            float even = direct * x;
            float odd = 0.0f;
            for (std::size_t k = 0; k < sections; k += 2) {
                even += state[k];
                odd += state[k + 1];
            }
            samples[i * stride] = even + odd;
        }
    }

} // namespace

SimulatedRecording::SimulatedRecording(const LineScene &scene)
    : m_scene(checked(scene)),
      m_noise(scene.noise, scene.sampleRateHz, scene.durationSeconds, scene.isComplex, std::uint64_t(scene.seed))
{
    m_info = recordingInfo(scene);
    for (const LineSettings &line : scene.lines) {
        const double variance = m_noise.localVariance(line.frequencyHz - scene.centreHz);
        const double amplitude =
            toneAmplitude(line.snrDb, variance, line.referenceSeconds * scene.sampleRateHz, scene.isComplex);
        m_tones.emplace_back(line, amplitude, m_info, std::uint64_t(scene.seed), std::ssize(m_tones));
    }
}

void SimulatedRecording::read(int, Index first, Index count, std::span<float> out) const
{
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        m_noise.read(from, inside);
        for (const Tone &tone : m_tones)
            tone.addTo(from, inside);
    });
}

Truth SimulatedRecording::truth() const
{
    return truthOf(m_tones);
}

NoiseSource::NoiseSource(const NoiseSettings &settings, double sampleRateHz, double durationSeconds, bool isComplex,
                         std::uint64_t seed)
    : m_settings(settings), m_sampleRateHz(sampleRateHz), m_floats(isComplex ? 2 : 1), m_seed(seed),
      m_isColoured(settings.slopeDbPerOctave != 0.0)
{
    if (m_isColoured)
        design(settings.slopeDbPerOctave);
    if (settings.levelDriftDb > 0.0) {
        m_levelStepSeconds = levelStep * settings.levelDriftSeconds;
        Random random(seed, streamNumber(SimulationStream::Level, 0));
        m_level = ornsteinUhlenbeck(random, Index(std::ceil(durationSeconds / m_levelStepSeconds)) + 1, levelStep);
        standardise(m_level, settings.levelDriftDb);
        for (double &value : m_level)
            value = std::sqrt(ratioFromDb(value));
    }
}

/// Partial fractions of g·Π(1 - zₖ/z)/(1 - pₖ/z), with g such that white noise of variance 1 gives variance 1.
void NoiseSource::design(double slopeDbPerOctave)
{
    std::array<double, sections> zeros;
    for (std::size_t k = 0; k < sections; ++k) {
        // A falling slope extends from a pole to its zero, a rising one from a zero to its pole.
        const double begin = std::ldexp(lowestTurns, int(k));
        const double end = begin * std::exp2(std::abs(slopeDbPerOctave) / dbFromRatio(4.0));
        m_poles[k] = decay(slopeDbPerOctave < 0.0 ? begin : end);
        zeros[k] = decay(slopeDbPerOctave < 0.0 ? end : begin);
    }
    m_direct = 1.0;
    for (std::size_t k = 0; k < sections; ++k)
        m_direct *= zeros[k] / m_poles[k];
    for (std::size_t k = 0; k < sections; ++k) {
        m_residues[k] = 1.0;
        for (std::size_t j = 0; j < sections; ++j) {
            m_residues[k] *= 1.0 - zeros[j] / m_poles[k];
            if (j != k)
                m_residues[k] /= 1.0 - m_poles[j] / m_poles[k];
        }
    }
    // Σ h² with h(n) = d·δ(n) + Σ rₖ pₖⁿ
    double variance = m_direct * m_direct;
    for (std::size_t k = 0; k < sections; ++k) {
        variance += 2.0 * m_direct * m_residues[k];
        for (std::size_t j = 0; j < sections; ++j)
            variance += m_residues[k] * m_residues[j] / (1.0 - m_poles[k] * m_poles[j]);
    }
    const double gain = 1.0 / std::sqrt(variance);
    m_direct *= gain;
    for (double &residue : m_residues)
        residue *= gain;
}

double NoiseSource::localVariance(double frequencyHz) const
{
    const double variance = m_settings.deviation * m_settings.deviation;
    if (!m_isColoured)
        return variance;
    const std::complex<double> delay = std::polar(1.0, -2.0 * std::numbers::pi * frequencyHz / m_sampleRateHz);
    std::complex<double> response = m_direct;
    for (std::size_t k = 0; k < sections; ++k)
        response += m_residues[k] / (1.0 - m_poles[k] * delay);
    return variance * std::norm(response);
}

void NoiseSource::read(Index first, std::span<float> out) const
{
    if (m_isColoured)
        readColoured(first, out);
    else
        readWhite(first, out);
    if (!m_level.empty())
        applyLevel(first, out);
}

void NoiseSource::readWhite(Index first, std::span<float> out) const
{
    const auto deviation = float(m_settings.deviation / std::sqrt(double(m_floats)));
    std::array<float, whiteBlock> edge;
    Index at = first * m_floats;
    while (!out.empty()) {
        const Index block = floorDivide(at, whiteBlock);
        const Index within = at - block * whiteBlock;
        const std::size_t run = std::min(out.size(), std::size_t(whiteBlock - within));
        Random random(m_seed, streamNumber(SimulationStream::Noise, block));
        if (within == 0) {
            random.normals(out.first(run), deviation);
        } else {
            const std::span<float> needed = std::span(edge).first(std::size_t(within) + run);
            random.normals(needed, deviation);
            std::copy(needed.begin() + within, needed.end(), out.begin());
        }
        out = out.subspan(run);
        at += Index(run);
    }
}

void NoiseSource::readColoured(Index first, std::span<float> out) const
{
    std::vector<float> samples;
    while (!out.empty()) {
        const Index start = floorDivide(first, colouredBlock) * colouredBlock;
        const Index end = std::min(start + colouredBlock, first + std::ssize(out) / m_floats);
        samples.resize(std::size_t((end - start + runUp) * m_floats));
        readWhite(start - runUp, samples);
        colour(samples);
        const auto from = samples.begin() + (first - start + runUp) * m_floats;
        std::copy(from, samples.end(), out.begin());
        out = out.subspan(std::size_t(samples.end() - from));
        first = end;
    }
}

void NoiseSource::colour(std::span<float> samples) const
{
    ParallelFilter<sections> filter{float(m_direct), {}, {}};
    std::copy(m_poles.begin(), m_poles.end(), filter.poles.begin());
    std::copy(m_residues.begin(), m_residues.end(), filter.residues.begin());
    const auto stride = std::size_t(m_floats);
    for (std::size_t component = 0; component < stride; ++component)
        run(filter, samples.data() + component, samples.size() / stride, stride);
}

void NoiseSource::applyLevel(Index first, std::span<float> out) const
{
    for (std::size_t i = 0; i < out.size(); ++i) {
        const Index sample = first + Index(i) / m_floats;
        const double seconds = double(sample) / m_sampleRateHz;
        out[i] *= float(interpolate(m_level, seconds / m_levelStepSeconds));
    }
}

RecordingPointer simulatedInMemory(const LineScene &scene)
{
    constexpr std::size_t mostFloats = std::size_t(1) << 23;
    const auto recording = std::make_shared<SimulatedRecording>(scene);
    const RecordingInfo &info = recording->info();
    const auto floats = std::size_t(info.sampleCount * info.floatsPerSample());
    if (floats > mostFloats)
        return recording;
    const std::shared_ptr<float[]> samples(new float[floats]);
    recording->read(0, 0, info.sampleCount, std::span(samples.get(), floats));
    return std::make_shared<ArrayRecording>("noise", std::shared_ptr<const float>(samples, samples.get()),
                                            ArrayLayout{info.sampleRateHz, info.sampleCount, 1, info.isComplex});
}

} // namespace faintline

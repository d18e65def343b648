#include "scene/Tone.h"

#include "base/fastmath.h"
#include "base/logmath.h"
#include "base/multiversion.h"
#include "scene/ornsteinUhlenbeck.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace faintline {

namespace {

    constexpr Index runSamples = 256;
    constexpr double fadingStep = 0.02; ///< correlation times between nodes of the fading

    struct Parabola {
        double startSeconds;
        double turns;       ///< phase at the start
        double frequencyHz; ///< at the start
        double rateHzPerSecond;
    };

    /// cos 2πφ and sin 2πφ of consecutive samples.
    FAINTLINE_MULTIVERSION
    void phasors(const Parabola &phase, double firstSample, double secondsPerSample, std::span<float> cosine,
                 float *sine)
    {
        constexpr double roundingShift = 6755399441055744.0; // adding 1.5·2⁵² rounds to a whole number
        const double halfRate = 0.5 * phase.rateHzPerSecond;
        for (std::size_t i = 0; i < cosine.size(); ++i) {
            const double seconds = (firstSample + double(int(i))) * secondsPerSample - phase.startSeconds;
            const double turns = phase.turns + seconds * (phase.frequencyHz + seconds * halfRate);
            const double whole = (turns + roundingShift) - roundingShift;
            const auto [s, c] = fastSineCosineTurns(float(turns - whole));
            cosine[i] = c;
            sine[i] = s;
        }
    }

    /// Number of intervals of the frequency path of a line of the given duration.
    Index intervalCount(const LineSettings &line, double durationSeconds)
    {
        if (line.wanderHz == 0.0)
            return 1; // the parabola is exact
        const double step = 0.1 * std::min(line.referenceSeconds, line.wanderSeconds);
        return std::max<Index>(1, Index(std::ceil(durationSeconds / step - 1e-9)));
    }

} // namespace

double toneAmplitude(double snrDb, double noiseVariance, double windowSamples, bool isComplex)
{
    return (isComplex ? 1.0 : 2.0) * std::sqrt(noiseVariance * ratioFromDb(snrDb) / windowSamples);
}

Tone::Tone(const LineSettings &line, double amplitude, const RecordingInfo &recording, std::uint64_t seed, Index number)
    : m_sampleRateHz(recording.sampleRateHz), m_centreHz(recording.centreHz), m_isComplex(recording.isComplex)
{
    const double recordingEnd = recording.durationSeconds();
    m_truth.startSeconds = line.startSeconds;
    m_truth.endSeconds =
        line.durationSeconds > 0.0 ? std::min(line.startSeconds + line.durationSeconds, recordingEnd) : recordingEnd;
    m_truth.snrDb = line.snrDb;
    m_truth.referenceSeconds = line.referenceSeconds;
    m_truth.amplitude = amplitude;
    const double duration = std::max(0.0, m_truth.endSeconds - m_truth.startSeconds);

    const Index intervals = intervalCount(line, duration);
    m_truth.stepSeconds = duration / double(intervals);
    std::vector<double> &frequency = m_truth.frequencyHz;
    if (line.wanderHz > 0.0) {
        Random random(seed, streamNumber(SimulationStream::Wander, number));
        frequency = ornsteinUhlenbeck(random, intervals + 1, m_truth.stepSeconds / line.wanderSeconds);
        standardise(frequency, line.wanderHz);
    } else {
        frequency.assign(std::size_t(intervals) + 1, 0.0);
    }
    for (std::size_t k = 0; k < frequency.size(); ++k)
        frequency[k] += line.frequencyHz + line.driftHzPerSecond * double(k) * m_truth.stepSeconds;

    m_turns.resize(frequency.size());
    m_turns[0] = Random(seed, streamNumber(SimulationStream::Phase, number)).uniform();
    for (std::size_t k = 1; k < m_turns.size(); ++k) {
        const double turns =
            m_turns[k - 1] + (0.5 * (frequency[k - 1] + frequency[k]) - m_centreHz) * m_truth.stepSeconds;
        m_turns[k] = turns - std::floor(turns);
    }

    if (line.fading == Fading::Rayleigh) {
        m_fadingStepSeconds = fadingStep * line.fadingSeconds;
        const Index nodes = Index(std::ceil(duration / m_fadingStepSeconds)) + 1;
        const auto component = [&](SimulationStream stream) {
            Random random(seed, streamNumber(stream, number));
            std::vector<double> path = ornsteinUhlenbeck(random, nodes, fadingStep);
            for (double &value : path)
                value *= std::sqrt(0.5);
            return path;
        };
        m_fadingReal = component(SimulationStream::FadingReal);
        m_fadingImaginary = component(SimulationStream::FadingImaginary);
    }

    if (line.fluctuation != Fluctuation::None) {
        m_dwellSeconds = line.referenceSeconds;
        Random random(seed, streamNumber(SimulationStream::Fluctuation, number));
        const double dwells = changesFromFrameToFrame(line.fluctuation) ? std::ceil(duration / m_dwellSeconds) : 1.0;
        for (Index dwell = 0; dwell < Index(dwells); ++dwell)
            m_dwellAmplitudes.push_back(float(std::sqrt(relativePower(line.fluctuation, random))));
    }

    const auto firstAt = [&](double seconds) { return Index(std::ceil(seconds * m_sampleRateHz - 1e-6)); };
    m_begin = firstAt(m_truth.startSeconds);
    m_end = firstAt(m_truth.endSeconds);
}

/// First sample of an interval between two nodes; for the interval after the last one, the tone's end.
Index Tone::firstSampleOf(Index interval) const
{
    if (interval <= 0)
        return m_begin;
    if (interval >= std::ssize(m_turns) - 1)
        return m_end;
    const double seconds = m_truth.startSeconds + double(interval) * m_truth.stepSeconds;
    return std::clamp(Index(std::ceil(seconds * m_sampleRateHz)), m_begin, m_end);
}

Index Tone::intervalOf(Index sample) const
{
    const double seconds = double(sample) / m_sampleRateHz - m_truth.startSeconds;
    const double guess = m_truth.stepSeconds > 0.0 ? seconds / m_truth.stepSeconds : 0.0;
    Index interval = std::clamp<Index>(Index(guess), 0, std::ssize(m_turns) - 2);
    while (interval > 0 && sample < firstSampleOf(interval))
        --interval;
    while (interval < std::ssize(m_turns) - 2 && sample >= firstSampleOf(interval + 1))
        ++interval;
    return interval;
}

void Tone::addTo(Index first, std::span<float> out) const
{
    const Index floats = m_isComplex ? 2 : 1;
    const Index end = std::min(first + std::ssize(out) / floats, m_end);
    Index at = std::max(first, m_begin);
    if (at >= end)
        return;
    for (Index interval = intervalOf(at); at < end; ++interval)
        for (const Index intervalEnd = std::min(end, firstSampleOf(interval + 1)); at < intervalEnd;) {
            const Index run = std::min(runSamples, intervalEnd - at);
            addRun(interval, at, out.subspan(std::size_t((at - first) * floats), std::size_t(run * floats)));
            at += run;
        }
}

/// Amplitude factor of the dwell that holds a sample; the last dwell extends to the end.
float Tone::dwellAmplitude(Index sample) const
{
    const double seconds = (double(sample) + 1e-6) / m_sampleRateHz - m_truth.startSeconds;
    const Index dwell = std::clamp<Index>(Index(seconds / m_dwellSeconds), 0, std::ssize(m_dwellAmplitudes) - 1);
    return m_dwellAmplitudes[std::size_t(dwell)];
}

/// Adds at most runSamples samples, all within one interval.
void Tone::addRun(Index interval, Index first, std::span<float> out) const
{
    const auto k = std::size_t(interval);
    const std::size_t count = out.size() / (m_isComplex ? 2 : 1);
    const std::vector<double> &frequency = m_truth.frequencyHz;
    const Parabola phase = {m_truth.startSeconds + double(interval) * m_truth.stepSeconds, m_turns[k],
                            frequency[k] - m_centreHz, (frequency[k + 1] - frequency[k]) / m_truth.stepSeconds};
    std::array<float, runSamples> cosine;
    std::array<float, runSamples> sine;
    phasors(phase, double(first), 1.0 / m_sampleRateHz, std::span(cosine).first(count), sine.data());

    for (std::size_t i = 0; i < count && !m_fadingReal.empty(); ++i) {
        const double seconds = double(first + Index(i)) / m_sampleRateHz - m_truth.startSeconds;
        const double position = seconds / m_fadingStepSeconds;
        const auto real = float(interpolate(m_fadingReal, position));
        const auto imaginary = float(interpolate(m_fadingImaginary, position));
        const float c = cosine[i];
        cosine[i] = real * c - imaginary * sine[i];
        sine[i] = real * sine[i] + imaginary * c;
    }

    for (std::size_t i = 0; i < count && !m_dwellAmplitudes.empty(); ++i) {
        const float factor = dwellAmplitude(first + Index(i));
        cosine[i] *= factor;
        sine[i] *= factor;
    }

    const auto amplitude = float(m_truth.amplitude);
    if (m_isComplex) {
        for (std::size_t i = 0; i < count; ++i) {
            out[2 * i] += amplitude * cosine[i];
            out[2 * i + 1] += amplitude * sine[i];
        }
    } else {
        for (std::size_t i = 0; i < count; ++i)
            out[i] += amplitude * cosine[i];
    }
}

Truth truthOf(const std::vector<Tone> &tones)
{
    Truth truth;
    for (const Tone &tone : tones)
        truth.lines.push_back(tone.truth());
    return truth;
}

} // namespace faintline

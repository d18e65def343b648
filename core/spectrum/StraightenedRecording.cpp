#include "spectrum/StraightenedRecording.h"

#include "base/Error.h"
#include "base/Field.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace faintline {

namespace {

    constexpr Index blockSamples = 8192;

    void checkTarget(double toHz, const RecordingInfo &info)
    {
        const double lowest = info.isComplex ? -0.5 * info.sampleRateHz : 0.0;
        const double highest = 0.5 * info.sampleRateHz;
        if (!(toHz >= lowest && toHz <= highest))
            throw Error("straightened line at " + formatNumber(toHz) + " Hz", "must lie in the recording's band, "
                                                                                  + formatNumber(lowest) + " … "
                                                                                  + formatNumber(highest) + " Hz");
    }

} // namespace

StraightenedRecording::StraightenedRecording(RecordingPointer base, int channel, const FrequencyCurve &curve,
                                             double toHz)
    : m_base(std::move(base)), m_channel(channel), m_curve(curve), m_toHz(toHz),
      m_fft(std::make_shared<Fft>(static_cast<int>(blockSamples), Fft::Input::Complex)),
      m_window(static_cast<std::size_t>(blockSamples))
{
    m_info = m_base->info();
    checkTarget(toHz, m_info);
    if (channel < 0 || channel >= m_info.channelCount)
        throw Error("channel " + std::to_string(channel), "the recording has no such channel");
    m_info.channelCount = 1;
    m_info.notes.push_back("Straightened: shifted so that a line stays at " + formatNumber(toHz) + " Hz.");
    for (std::size_t n = 0; n < m_window.size(); ++n)
        m_window[n] = static_cast<float>(
            std::sin(std::numbers::pi * (static_cast<double>(n) + 0.5) / static_cast<double>(blockSamples)));
}

void StraightenedRecording::read(int /*channel*/, Index first, Index count, std::span<float> out) const
{
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        if (m_info.isComplex) {
            m_base->read(m_channel, from, std::ssize(inside) / 2, inside);
            turn(from, inside);
            return;
        }
        std::fill(inside.begin(), inside.end(), 0.0f);
        // Block b covers samples b·length/2 … b·length/2 + length - 1; -1 is the first that reaches into the recording.
        constexpr Index hop = blockSamples / 2;
        for (Index block = from / hop - 1; block * hop < from + std::ssize(inside); ++block)
            addBlock(block, from, inside);
    });
}

/// Of interleaved samples: a → a·e^(-iθ), θ = 2π (∫ f dt - f0·t), which is exact every few samples and linear between them.
void StraightenedRecording::turn(Index first, std::span<float> samples) const
{
    constexpr Index linear = 32; // samples, from multiples of it on, so that no value depends on where a read begins
    const auto cyclesAt = [&](Index n) {
        const double seconds = static_cast<double>(n) / m_info.sampleRateHz;
        return m_curve.cyclesAt(seconds) - m_toHz * (seconds - m_curve.time().first);
    };
    const auto factorAt = [](double cycles) {
        return std::polar(1.0, -2.0 * std::numbers::pi * (cycles - std::floor(cycles)));
    };
    const Index end = first + std::ssize(samples) / 2;
    for (Index begin = first - (first % linear + linear) % linear; begin < end; begin += linear) {
        const double cycles = cyclesAt(begin);
        const std::complex<double> rotation =
            factorAt((cyclesAt(begin + linear) - cycles) / static_cast<double>(linear));
        std::complex<double> factor = factorAt(cycles);
        for (Index n = begin; n < std::min(begin + linear, end); ++n, factor *= rotation) {
            if (n < first)
                continue;
            float *const sample = samples.data() + 2 * (n - first);
            const std::complex<double> turned =
                factor * std::complex<double>(static_cast<double>(sample[0]), static_cast<double>(sample[1]));
            sample[0] = static_cast<float>(turned.real());
            sample[1] = static_cast<float>(turned.imag());
        }
    }
}

/// Adds a block's share to real samples from `first` on.
void StraightenedRecording::addBlock(Index block, Index first, std::span<float> out) const
{
    const Index begin = block * (blockSamples / 2);
    std::vector<float> real(static_cast<std::size_t>(blockSamples));
    m_base->read(m_channel, begin, blockSamples, real);
    const std::unique_ptr<Fft::Buffer> buffer = m_fft->buffer();
    const std::span<float> samples = buffer->input();
    for (std::size_t n = 0; n < real.size(); ++n) {
        samples[2 * n] = m_window[n] * real[n];
        samples[2 * n + 1] = 0.0f;
    }
    m_fft->run(*buffer);
    // Positive frequencies twice, negative ones not; the inverse transform by a forward one: F⁻¹{X} = conj(F{conj X})/N.
    std::vector<std::complex<float>> spectrum(buffer->output().begin(), buffer->output().end());
    constexpr std::size_t half = blockSamples / 2;
    for (std::size_t bin = 0; bin < spectrum.size(); ++bin) {
        const float gain = bin == 0 || bin == half ? 1.0f : bin < half ? 2.0f : 0.0f;
        samples[2 * bin] = gain * spectrum[bin].real() / static_cast<float>(blockSamples);
        samples[2 * bin + 1] = -gain * spectrum[bin].imag() / static_cast<float>(blockSamples);
    }
    m_fft->run(*buffer);
    const Index from = std::max(begin, first);
    const Index to = std::min(begin + blockSamples, first + std::ssize(out));
    std::vector<float> analytic;
    for (Index n = from; n < to; ++n) {
        const std::complex<float> a = std::conj(buffer->output()[static_cast<std::size_t>(n - begin)]);
        analytic.insert(analytic.end(), {a.real(), a.imag()});
    }
    turn(from, analytic);
    for (Index n = from; n < to; ++n)
        out[static_cast<std::size_t>(n - first)] +=
            m_window[static_cast<std::size_t>(n - begin)] * analytic[2 * static_cast<std::size_t>(n - from)];
}

} // namespace faintline

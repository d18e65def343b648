#include "signal/StraightenedRecording.h"

#include "base/Error.h"
#include "base/Field.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace faintline {

namespace {

    constexpr Index filterSamples = 8192;

    /// Doubles positive frequencies, removes negative ones, divides by the length.
    std::vector<float> analyticGains()
    {
        constexpr std::size_t half = filterSamples / 2;
        std::vector<float> gains(2 * half, 0.0f);
        std::fill_n(gains.begin(), half, 2.0f / float(filterSamples));
        gains[0] = gains[half] = 1.0f / float(filterSamples);
        return gains;
    }

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
    : m_base(std::move(base)), m_channel(channel), m_curve(curve), m_toHz(toHz), m_filter(filterSamples),
      m_gains(analyticGains())
{
    m_info = m_base->info();
    checkTarget(toHz, m_info);
    if (channel < 0 || channel >= m_info.channelCount)
        throw Error("channel " + std::to_string(channel), "the recording has no such channel");
    m_info.channelCount = 1;
    m_info.notes.push_back("Straightened: shifted so that a line stays at " + formatNumber(toHz) + " Hz.");
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
        const Index end = from + std::ssize(inside);
        for (Index block = m_filter.firstBlockOf(from); m_filter.beginOf(block) < end; ++block)
            addBlock(block, from, inside);
    });
}

/// For interleaved samples: a → a·e^(-iθ), θ = 2π (∫ f dt - f0·t), exact every few samples and linear between them.
void StraightenedRecording::turn(Index first, std::span<float> samples) const
{
    constexpr Index linear = 32; // samples; aligned to multiples, so that no value depends on where a read begins
    const auto cyclesAt = [&](Index n) {
        const double seconds = double(n) / m_info.sampleRateHz;
        return m_curve.cyclesAt(seconds) - m_toHz * (seconds - m_curve.time().first);
    };
    const auto factorAt = [](double cycles) {
        return std::polar(1.0, -2.0 * std::numbers::pi * (cycles - std::floor(cycles)));
    };
    const Index end = first + std::ssize(samples) / 2;
    for (Index begin = first - (first % linear + linear) % linear; begin < end; begin += linear) {
        const double cycles = cyclesAt(begin);
        const std::complex<double> rotation = factorAt((cyclesAt(begin + linear) - cycles) / double(linear));
        std::complex<double> factor = factorAt(cycles);
        for (Index n = begin; n < std::min(begin + linear, end); ++n, factor *= rotation) {
            if (n < first)
                continue;
            float *const sample = samples.data() + 2 * (n - first);
            const std::complex<double> turned = factor * std::complex<double>(double(sample[0]), double(sample[1]));
            sample[0] = float(turned.real());
            sample[1] = float(turned.imag());
        }
    }
}

/// Adds a block's contribution to real samples from `first` on. Rotation and the second window commute.
void StraightenedRecording::addBlock(Index block, Index first, std::span<float> out) const
{
    const Index begin = m_filter.beginOf(block);
    std::vector<float> real(static_cast<std::size_t>(filterSamples));
    m_base->read(m_channel, begin, filterSamples, real);
    std::vector<std::complex<float>> analytic(real.begin(), real.end());
    m_filter.apply(analytic, m_gains);
    turn(begin, {reinterpret_cast<float *>(analytic.data()), 2 * analytic.size()});
    const Index end = std::min(begin + filterSamples, first + std::ssize(out));
    for (Index n = std::max(begin, first); n < end; ++n)
        out[std::size_t(n - first)] += analytic[std::size_t(n - begin)].real();
}

} // namespace faintline

#include "signal/StraightenedRecording.h"

#include "base/Error.h"
#include "base/Field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

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

    constexpr double largestStretch = 8.0;
    constexpr double passedBandShare = 0.94; ///< fraction of half the rate
    constexpr Index blockSamples = 8192;

    /// One side of a Kaiser-windowed sinc, interpolated linearly.
    class Kernel
    {
    public:
        static constexpr double crossings = 48.0; ///< on either side

        Kernel()
        {
            constexpr double beta = 9.0;
            for (std::size_t i = 0; i < m_values.size(); ++i) {
                const double x = double(i) / pointsPerCrossing;
                const double angle = std::numbers::pi * x;
                const double root = std::sqrt(std::max(0.0, 1.0 - x * x / (crossings * crossings)));
                m_values[i] = (i == 0 ? 1.0 : std::sin(angle) / angle) * std::cyl_bessel_i(0.0, beta * root)
                              / std::cyl_bessel_i(0.0, beta);
            }
            m_values.back() = 0.0;
        }

        /// |x| ≤ crossings
        double operator()(double x) const
        {
            const double place = std::abs(x) * pointsPerCrossing;
            const auto lower = std::min(std::size_t(place), m_values.size() - 2);
            return m_values[lower] + (place - double(lower)) * (m_values[lower + 1] - m_values[lower]);
        }

    private:
        static constexpr double pointsPerCrossing = 512.0;
        std::array<double, std::size_t(crossings *pointsPerCrossing) + 1> m_values;
    };

    const Kernel &kernel()
    {
        static const Kernel made;
        return made;
    }

    void check(const FrequencyCurve &curve, double toHz)
    {
        const auto [least, most] = std::minmax_element(curve.hz().begin(), curve.hz().end());
        if (!(*least > 0.0))
            throw Error("resampling along " + formatNumber(*least) + " … " + formatNumber(*most) + " Hz",
                        "needs a fundamental above 0 Hz; shift the recording instead");
        if (!(toHz >= *most / largestStretch && toHz <= *least * largestStretch))
            throw Error("resampled line at " + formatNumber(toHz) + " Hz",
                        "must lie in " + formatNumber(*most / largestStretch) + " … "
                            + formatNumber(*least * largestStretch)
                            + " Hz, so that time is stretched by a factor of 8 at most");
    }

} // namespace

StraightenedRecording::StraightenedRecording(RecordingPointer base, int channel, const FrequencyCurve &curve,
                                             double toHz)
    : DerivedRecording(std::move(base)), m_channel(channel), m_curve(curve), m_toHz(toHz), m_filter(filterSamples),
      m_gains(analyticGains())
{
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

ResampledRecording::ResampledRecording(RecordingPointer base, int channel, const FrequencyCurve &curve, double toHz)
    : m_base(std::move(base)), m_channel(channel), m_curve(curve), m_toHz(toHz)
{
    m_info = m_base->info();
    check(curve, toHz);
    if (channel < 0 || channel >= m_info.channelCount)
        throw Error("channel " + std::to_string(channel), "the recording has no such channel");
    m_info.sampleCount = Index(std::floor(secondsOf(m_info.durationSeconds()) * m_info.sampleRateHz));
    m_info.channelCount = 1;
    m_info.notes.push_back("Resampled: time is stretched so that a fundamental stays at " + formatNumber(toHz)
                           + " Hz.");
}

double ResampledRecording::secondsOf(double baseSeconds) const
{
    return (m_curve.cyclesAt(baseSeconds) - m_curve.cyclesAt(0.0)) / m_toHz;
}

double ResampledRecording::baseSecondsOf(double seconds) const
{
    return m_curve.secondsAt(m_curve.cyclesAt(0.0) + m_toHz * seconds);
}

void ResampledRecording::read(int /*channel*/, Index first, Index count, std::span<float> out) const
{
    const Index floats = m_info.floatsPerSample();
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        while (!inside.empty()) {
            const auto block = inside.first(std::min(inside.size(), std::size_t(blockSamples * floats)));
            readBlock(from, block);
            from += std::ssize(block) / floats;
            inside = inside.subspan(block.size());
        }
    });
}

void ResampledRecording::readBlock(Index first, std::span<float> out) const
{
    const double rate = m_info.sampleRateHz;
    const auto floats = std::size_t(m_info.floatsPerSample());
    const std::size_t count = out.size() / floats;
    constexpr double kernelReachSamples = Kernel::crossings * largestStretch / passedBandShare;
    const auto begin = Index(std::floor(baseSecondsOf(double(first) / rate) * rate - kernelReachSamples));
    const auto end = Index(std::ceil(baseSecondsOf(double(first + Index(count)) / rate) * rate + kernelReachSamples));
    std::vector<float> base(std::size_t(end - begin) * floats);
    m_base->read(m_channel, begin, end - begin, base);
    for (std::size_t n = 0; n < count; ++n) {
        const double seconds = baseSecondsOf(double(first + Index(n)) / rate);
        const double width = passedBandShare * std::min(1.0, m_curve.at(seconds) / m_toHz); // relative to half the rate
        const double centre = seconds * rate - double(begin);
        const double reach = Kernel::crossings / width;
        std::array<double, 2> sum{};
        for (auto k = std::size_t(std::ceil(centre - reach)); double(k) <= centre + reach; ++k) {
            const double weight = kernel()(width * (double(k) - centre));
            for (std::size_t part = 0; part < floats; ++part)
                sum[part] += weight * double(base[k * floats + part]);
        }
        for (std::size_t part = 0; part < floats; ++part)
            out[n * floats + part] = float(width * sum[part]);
    }
}

} // namespace faintline

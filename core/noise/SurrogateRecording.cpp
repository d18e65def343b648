#include "noise/SurrogateRecording.h"

#include "base/Random.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <complex>
#include <string>

namespace faintline {

namespace {

    constexpr Index shortestSilence = 64; ///< samples that are 0 by chance less often than once per recording

    /// Quantisation step of an integer format, for samples scaled to ±1; 0 for other formats.
    double quantisationStep(const std::string &sampleType)
    {
        const bool isInteger = sampleType.find('i') != std::string::npos || sampleType.find('u') != std::string::npos;
        const auto digit =
            std::find_if(sampleType.begin(), sampleType.end(), [](unsigned char c) { return std::isdigit(c); });
        if (!isInteger || digit == sampleType.end() || sampleType.starts_with("float"))
            return 0.0;
        return std::exp2(1.0 - std::stod(std::string(digit, sampleType.end())));
    }

} // namespace

SurrogateRecording::SurrogateRecording(RecordingPointer recording, int channel, int windowSamples,
                                       std::shared_ptr<const NoiseBackground> background, std::uint64_t seed)
    : DerivedRecording(std::move(recording)), m_baseChannel(channel), m_background(std::move(background)), m_seed(seed),
      m_filter(Fft::fastLength((windowSamples + 1) / 2) * 2)
{
    m_info.container = "surrogate";
    m_info.notes.push_back("Noise like that of " + m_base->info().path + ", without its signals.");
    m_step = quantisationStep(m_info.sampleType);
}

void SurrogateRecording::read(int /*channel*/, Index first, Index count, std::span<float> out) const
{
    std::fill(out.begin(), out.begin() + std::ptrdiff_t(count * m_info.floatsPerSample()), 0.0f);
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        std::fill(inside.begin(), inside.end(), 0.0f);
        const Index end = from + std::ssize(inside) / m_info.floatsPerSample();
        for (Index block = m_filter.firstBlockOf(from); m_filter.beginOf(block) < end; ++block)
            addBlock(block, from, inside);
        if (m_step > 0.0)
            for (float &value : inside)
                value = float(std::clamp(std::round(double(value) / m_step) * m_step, -1.0, 1.0 - m_step));
        silence(from, inside);
    });
}

/// A block of complex white noise; each half block has its own random stream, because it belongs to two blocks.
void SurrogateRecording::fillWhite(Index block, std::span<std::complex<float>> samples) const
{
    const Index hop = m_filter.length() / 2;
    std::vector<float> normals(std::size_t(m_info.isComplex ? 2 * hop : hop));
    for (Index half = 0; half < 2; ++half) {
        Random random(m_seed, std::uint64_t(block + half + 1));
        random.normals(normals, m_info.isComplex ? float(std::sqrt(0.5)) : 1.0f);
        for (Index n = 0; n < hop; ++n) {
            const auto from = std::size_t(n);
            const auto to = std::size_t(half * hop + n);
            samples[to] = m_info.isComplex ? std::complex<float>(normals[2 * from], normals[2 * from + 1])
                                           : std::complex<float>(normals[from]);
        }
    }
}

/// √B at a time, averaged over the block, for each bin of its transform.
std::vector<float> SurrogateRecording::gainsAt(double seconds) const
{
    const Axis &frequency = m_background->frequency;
    const Index length = m_filter.length();
    std::vector<float> ln(std::size_t(frequency.count));
    m_background->readLnPower(seconds, ln);
    std::vector<float> gains(static_cast<std::size_t>(length));
    for (Index bin = 0; bin < length; ++bin) {
        const Index signedBin = 2 * bin < length ? bin : bin - length;
        const double hz = m_info.sampleRateHz * double(signedBin) / double(length);
        const double last = double(frequency.count - 1);
        const double position = std::clamp(frequency.position(m_info.isComplex ? hz : std::abs(hz)), 0.0, last);
        const auto lower = std::size_t(position);
        const std::size_t upper = std::min(lower + 1, ln.size() - 1);
        const double fraction = position - double(lower);
        const double lnPower = (1.0 - fraction) * double(ln[lower]) + fraction * double(ln[upper]);
        gains[std::size_t(bin)] = float(std::exp(0.5 * (m_background->lnUnit + lnPower)) / double(length));
    }
    return gains;
}

/// Adds a block's contribution to the samples from `first` on.
void SurrogateRecording::addBlock(Index block, Index first, std::span<float> out) const
{
    const Index begin = m_filter.beginOf(block);
    const Index length = m_filter.length();
    const double middle = (double(begin) + 0.5 * double(length)) / m_info.sampleRateHz;
    std::vector<std::complex<float>> samples(static_cast<std::size_t>(length));
    fillWhite(block, samples);
    m_filter.apply(samples, gainsAt(middle));
    const Index floats = m_info.floatsPerSample();
    const Index end = std::min(begin + length, first + std::ssize(out) / floats);
    for (Index sample = std::max(begin, first); sample < end; ++sample) {
        const std::complex<float> value = samples[std::size_t(sample - begin)];
        const auto to = std::size_t((sample - first) * floats);
        out[to] += value.real();
        if (m_info.isComplex)
            out[to + 1] += value.imag();
    }
}

/// Sets samples to 0 where the recording has a run of zeros longer than chance would produce.
void SurrogateRecording::silence(Index first, std::span<float> out) const
{
    const auto floats = std::size_t(m_info.floatsPerSample());
    const Index count = std::ssize(out) / Index(floats);
    const Index begin = first - shortestSilence;
    const Index total = count + 2 * shortestSilence;
    std::vector<float> original(std::size_t(total) * floats);
    m_base->read(m_baseChannel, begin, total, original);
    Index run = 0; // number of consecutive zeros, including this sample
    const auto isZero = [&](Index n) {
        const auto at = std::size_t(n) * floats;
        return original[at] == 0.0f && original[at + floats - 1] == 0.0f;
    };
    for (Index n = 0; n <= total; ++n) {
        if (n < total && isZero(n)) {
            ++run;
            continue;
        }
        for (Index zero = n - run; run >= shortestSilence && zero < n; ++zero)
            if (const Index at = zero - shortestSilence; at >= 0 && at < count)
                std::fill_n(out.begin() + at * Index(floats), floats, 0.0f);
        run = 0;
    }
}

} // namespace faintline

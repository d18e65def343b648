#include "spectrum/SurrogateRecording.h"

#include "base/Random.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string>

namespace faintline {

namespace {

    constexpr Index shortestSilence = 64; ///< samples that are 0 by chance less often than once in a recording

    /// Of samples scaled to ±1: what one digit of an integer format stands for; 0 for others.
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

SurrogateRecording::SurrogateRecording(const Spectrogram &spectrogram,
                                       std::shared_ptr<const NoiseBackground> background, std::uint64_t seed)
    : m_base(spectrogram.recordingPointer()), m_baseChannel(spectrogram.selection().channel),
      m_background(std::move(background)), m_seed(seed),
      m_length(Fft::fastLength((spectrogram.windowSamples() + 1) / 2) * 2),
      m_fft(std::make_shared<Fft>(static_cast<int>(m_length), Fft::Input::Complex)),
      m_window(static_cast<std::size_t>(m_length))
{
    m_info = m_base->info();
    m_info.container = "surrogate";
    m_info.notes.push_back("Noise like that of " + m_base->info().path + ", without its signals.");
    m_step = quantisationStep(m_info.sampleType);
    for (std::size_t n = 0; n < m_window.size(); ++n)
        m_window[n] = static_cast<float>(
            std::sin(std::numbers::pi * (static_cast<double>(n) + 0.5) / static_cast<double>(m_length)));
}

void SurrogateRecording::read(int /*channel*/, Index first, Index count, std::span<float> out) const
{
    std::fill(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count * m_info.floatsPerSample()), 0.0f);
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        std::fill(inside.begin(), inside.end(), 0.0f);
        // Block b covers samples b·length/2 … b·length/2 + length - 1; -1 is the first that reaches into the recording.
        const Index hop = m_length / 2;
        const Index end = from + std::ssize(inside) / m_info.floatsPerSample();
        for (Index block = from / hop - 1; block * hop < end; ++block)
            addBlock(block, from, inside);
        if (m_step > 0.0)
            for (float &value : inside)
                value = static_cast<float>(
                    std::clamp(std::round(static_cast<double>(value) / m_step) * m_step, -1.0, 1.0 - m_step));
        silence(from, inside);
    });
}

/// Adds a block's share to the samples from `first` on.
void SurrogateRecording::addBlock(Index block, Index first, std::span<float> out) const
{
    const auto length = static_cast<std::size_t>(m_length);
    const auto floats = static_cast<std::size_t>(m_info.floatsPerSample());
    const Index hop = m_length / 2;
    const std::shared_ptr<Fft::Buffer> buffer = m_fft->buffer();
    const std::span<float> samples = buffer->input();
    std::fill(samples.begin(), samples.end(), 0.0f);
    // White noise of half blocks: each belongs to two blocks.
    std::vector<float> white(static_cast<std::size_t>(hop) * floats);
    for (Index half = 0; half < 2; ++half) {
        Random random(m_seed, static_cast<std::uint64_t>(block + half + 1));
        random.normals(white, m_info.isComplex ? static_cast<float>(std::sqrt(0.5)) : 1.0f);
        for (Index n = 0; n < hop; ++n) {
            const auto at = static_cast<std::size_t>(half * hop + n);
            for (std::size_t part = 0; part < floats; ++part)
                samples[2 * at + part] = white[static_cast<std::size_t>(n) * floats + part] * m_window[at];
        }
    }
    m_fft->run(*buffer);

    const double rate = m_info.sampleRateHz;
    const double middle =
        (static_cast<double>(block) * static_cast<double>(hop) + 0.5 * static_cast<double>(m_length)) / rate;
    const Axis &frequency = m_background->frequency;
    std::vector<float> ln(static_cast<std::size_t>(frequency.count));
    m_background->readLnPower(middle, ln);
    const auto gain = [&](double hz) {
        const double position = std::clamp(frequency.position(hz), 0.0, static_cast<double>(frequency.count - 1));
        const auto lower =
            static_cast<std::size_t>(std::min(position, static_cast<double>(std::max<Index>(0, frequency.count - 2))));
        const std::size_t upper = std::min(lower + 1, ln.size() - 1);
        const double fraction = position - static_cast<double>(lower);
        return std::exp(
            0.5 * (m_background->lnUnit + (1.0 - fraction) * static_cast<double>(ln[lower]) + fraction * static_cast<double>(ln[upper])));
    };
    // The inverse transform by a forward one: F⁻¹{X} = conj(F{conj X})/N.
    const std::span<const std::complex<float>> bins = buffer->output();
    std::vector<float> shaped(2 * length);
    for (std::size_t bin = 0; bin < length; ++bin) {
        const double signedBin = bin < length - length / 2 ? static_cast<double>(bin)
                                                           : static_cast<double>(bin) - static_cast<double>(length);
        const double hz = signedBin * rate / static_cast<double>(length);
        const auto factor =
            static_cast<float>(gain(m_info.isComplex ? hz : std::abs(hz)) / static_cast<double>(length));
        shaped[2 * bin] = bins[bin].real() * factor;
        shaped[2 * bin + 1] = -bins[bin].imag() * factor;
    }
    std::copy(shaped.begin(), shaped.end(), samples.begin());
    m_fft->run(*buffer);
    const Index count = std::ssize(out) / static_cast<Index>(floats);
    for (Index n = std::max<Index>(0, first - block * hop); n < m_length && block * hop + n < first + count; ++n) {
        const auto to = static_cast<std::size_t>(block * hop + n - first) * floats;
        const auto from = static_cast<std::size_t>(n);
        out[to] += buffer->output()[from].real() * m_window[from];
        if (floats == 2)
            out[to + 1] -= buffer->output()[from].imag() * m_window[from];
    }
}

/// 0 where the recording holds nothing but zeros for longer than chance has it.
void SurrogateRecording::silence(Index first, std::span<float> out) const
{
    const auto floats = static_cast<std::size_t>(m_info.floatsPerSample());
    const Index count = std::ssize(out) / static_cast<Index>(floats);
    const Index begin = first - shortestSilence;
    const Index total = count + 2 * shortestSilence;
    std::vector<float> original(static_cast<std::size_t>(total) * floats);
    m_base->read(m_baseChannel, begin, total, original);
    Index run = 0; // of zeros, up to and with this sample
    const auto isZero = [&](Index n) {
        const auto at = static_cast<std::size_t>(n) * floats;
        return original[at] == 0.0f && original[at + floats - 1] == 0.0f;
    };
    for (Index n = 0; n <= total; ++n) {
        if (n < total && isZero(n)) {
            ++run;
            continue;
        }
        for (Index zero = n - run; run >= shortestSilence && zero < n; ++zero)
            if (const Index at = zero - shortestSilence; at >= 0 && at < count)
                std::fill_n(out.begin() + at * static_cast<Index>(floats), floats, 0.0f);
        run = 0;
    }
}

} // namespace faintline

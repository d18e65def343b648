#include "signal/BandRecording.h"

#include <algorithm>
#include <complex>

namespace faintline {

namespace {

    constexpr Index bandBlockSamples = BandRecording::reachSamples;

    /// Gains of each bin of a block; the transform is not divided by its length.
    std::vector<float> gainsOf(const RecordingInfo &info, double lowHz, double highHz)
    {
        std::vector<float> gains(static_cast<std::size_t>(bandBlockSamples), 0.0f);
        for (Index bin = 0; bin < bandBlockSamples; ++bin) {
            const bool isNegative = bin > bandBlockSamples / 2;
            const double hz =
                double(isNegative ? bin - bandBlockSamples : bin) * info.sampleRateHz / double(bandBlockSamples);
            const bool isEdge = bin == 0 || bin == bandBlockSamples / 2; // is its own conjugate
            const float gain = info.isComplex || isEdge ? 1.0f : isNegative ? 0.0f : 2.0f;
            if (hz >= lowHz && hz <= highHz)
                gains[std::size_t(bin)] = gain / float(bandBlockSamples);
        }
        return gains;
    }

} // namespace

BandRecording::BandRecording(RecordingPointer base, int channel, double lowHz, double highHz)
    : m_base(std::move(base)), m_channel(channel), m_filter(bandBlockSamples),
      m_gains(gainsOf(m_base->info(), lowHz, highHz))
{
    m_info = m_base->info();
    m_info.channelCount = 1;
    m_info.isComplex = true;
}

void BandRecording::read(int /*channel*/, Index first, Index count, std::span<float> out) const
{
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        std::fill(inside.begin(), inside.end(), 0.0f);
        const Index end = from + std::ssize(inside) / 2;
        for (Index block = m_filter.firstBlockOf(from); m_filter.beginOf(block) < end; ++block)
            addBlock(block, from, inside);
    });
}

void BandRecording::addBlock(Index block, Index first, std::span<float> out) const
{
    const Index begin = m_filter.beginOf(block);
    std::vector<float> samples(std::size_t(bandBlockSamples * m_base->info().floatsPerSample()));
    m_base->read(m_channel, begin, bandBlockSamples, samples);
    std::vector<std::complex<float>> values(static_cast<std::size_t>(bandBlockSamples));
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = m_base->info().isComplex ? std::complex(samples[2 * i], samples[2 * i + 1]) : samples[i];
    m_filter.apply(values, m_gains);
    const Index end = std::min(begin + bandBlockSamples, first + std::ssize(out) / 2);
    for (Index n = std::max(begin, first); n < end; ++n) {
        out[std::size_t(2 * (n - first))] += values[std::size_t(n - begin)].real();
        out[std::size_t(2 * (n - first) + 1)] += values[std::size_t(n - begin)].imag();
    }
}

} // namespace faintline

#include "signal/BlockFilter.h"

#include <cmath>
#include <numbers>

namespace faintline {

BlockFilter::BlockFilter(Index length) : m_window(std::size_t(length)), m_fft(int(length), Fft::Input::Complex)
{
    for (std::size_t n = 0; n < m_window.size(); ++n)
        m_window[n] = float(std::sin(std::numbers::pi * (double(n) + 0.5) / double(length)));
}

void BlockFilter::apply(std::span<std::complex<float>> block, std::span<const float> gains) const
{
    const auto buffer = m_fft.buffer();
    const std::span<float> samples = buffer->input();
    for (std::size_t n = 0; n < block.size(); ++n) {
        samples[2 * n] = m_window[n] * block[n].real();
        samples[2 * n + 1] = m_window[n] * block[n].imag();
    }
    m_fft.run(*buffer);
    // Inverse transform by a forward transform: F⁻¹{X} = conj(F{conj X})/N.
    for (std::size_t bin = 0; bin < block.size(); ++bin) {
        const std::complex<float> value = buffer->output()[bin];
        samples[2 * bin] = value.real() * gains[bin];
        samples[2 * bin + 1] = -value.imag() * gains[bin];
    }
    m_fft.run(*buffer);
    for (std::size_t n = 0; n < block.size(); ++n)
        block[n] = std::conj(buffer->output()[n]) * m_window[n];
}

} // namespace faintline

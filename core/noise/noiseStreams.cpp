#include "noise/noiseStreams.h"

#include "base/Random.h"
#include "frames/Window.h"
#include "signal/Fft.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    class IndependentNoise final : public NoiseStream
    {
    public:
        explicit IndependentNoise(Index cells) : m_cells(cells) {}
        Index cells() const override { return m_cells; }
        void next(Random &random, std::span<float> y) override { random.exponentials(y); }

    private:
        Index m_cells;
    };

    class SpectralNoise final : public NoiseStream
    {
    public:
        SpectralNoise(const SpectrogramSettings &settings, int windowSamples)
            : m_hop(std::size_t(std::max(1L, std::lround(double(windowSamples) / settings.stepsPerWindow)))),
              m_window(sampleWindow(settings.window, windowSamples)),
              m_fft(settings.transformLength(windowSamples), Fft::Input::Complex), m_buffer(m_fft.buffer()),
              m_samples(2 * m_window.size())
        {
        }

        Index cells() const override { return m_fft.length(); }

        void next(Random &random, std::span<float> y) override
        {
            // The first window is entirely new, others only in their last hop.
            const std::size_t fresh = m_isFirst ? m_samples.size() : std::min(2 * m_hop, m_samples.size());
            m_isFirst = false;
            std::copy(m_samples.begin() + std::ptrdiff_t(fresh), m_samples.end(), m_samples.begin());
            random.normals(std::span(m_samples).last(fresh), float(std::sqrt(0.5)));
            const std::span<float> input = m_buffer->input();
            std::fill(input.begin(), input.end(), 0.0f);
            for (std::size_t n = 0; n < m_window.size(); ++n) {
                input[2 * n] = m_samples[2 * n] * m_window[n];
                input[2 * n + 1] = m_samples[2 * n + 1] * m_window[n];
            }
            m_fft.run(*m_buffer);
            for (std::size_t bin = 0; bin < y.size(); ++bin)
                y[bin] = std::norm(m_buffer->output()[bin]);
        }

        std::vector<float> state() const override { return m_samples; }
        void setState(std::span<const float> state) override
        {
            m_samples.assign(state.begin(), state.end());
            m_isFirst = false;
        }

    private:
        std::size_t m_hop;
        std::vector<float> m_window;
        Fft m_fft;
        std::unique_ptr<Fft::Buffer> m_buffer;
        std::vector<float> m_samples; ///< interleaved
        bool m_isFirst = true;
    };

} // namespace

std::unique_ptr<NoiseStream> independentNoise(Index cells)
{
    return std::make_unique<IndependentNoise>(cells);
}

std::unique_ptr<NoiseStream> spectralNoise(const SpectrogramSettings &settings, int windowSamples)
{
    return std::make_unique<SpectralNoise>(settings, windowSamples);
}

} // namespace faintline

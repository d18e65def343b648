#include "inspect/advice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace faintline {

namespace {

    constexpr Index sampledFrames = 200;
    constexpr Index fewestFrames = 16;
    constexpr double mostValues = 8e6;
    constexpr double toleratedLossShare = 0.1; ///< of the channels
    constexpr double steadyPower = 1.5;        ///< mean of a cell with a line

    /// e^(-y) of some frames, spread over the analysis, for each channel: uniform on noise.
    class Shares
    {
    public:
        Shares(const Analysis &analysis, const RunContext &context)
            : m_channels(analysis.lines.size()), m_cells(std::size_t(analysis.lines.front()->grid().size())),
              m_isNoise(m_cells, true)
        {
            const auto held = Index(mostValues / double(m_cells * m_channels));
            const Index count = std::min(analysis.time().count, std::clamp(held, fewestFrames, sampledFrames));
            m_frames = std::size_t(count);
            std::vector<float> frame(m_cells);
            for (const NormalisedFramesPointer &lines : analysis.lines) {
                std::vector<double> sums(m_cells, 0.0);
                for (Index i = 0; i < count; ++i) {
                    context.checkpoint(0.0, "comparing the channels' noise");
                    lines->read(i * analysis.time().count / count, 1, frame);
                    for (std::size_t cell = 0; cell < m_cells; ++cell) {
                        const bool isKnown = frame[cell] > 0.0f; // neither silent nor NaN
                        m_isNoise[cell] = m_isNoise[cell] && isKnown;
                        sums[cell] += double(frame[cell]);
                        m_values.push_back(std::exp(-frame[cell]));
                    }
                }
                for (std::size_t cell = 0; cell < m_cells; ++cell)
                    m_isNoise[cell] = m_isNoise[cell] && sums[cell] <= steadyPower * double(count);
            }
        }

        /// Correlation of two channels; 0 if nothing is known.
        double correlation(std::size_t a, std::size_t b) const
        {
            double n = 0.0, sumA = 0.0, sumB = 0.0, squaresA = 0.0, squaresB = 0.0, products = 0.0;
            for (std::size_t frame = 0; frame < m_frames; ++frame)
                for (std::size_t cell = 0; cell < m_cells; ++cell) {
                    if (!m_isNoise[cell])
                        continue;
                    const double valueA = at(a, frame, cell);
                    const double valueB = at(b, frame, cell);
                    n += 1.0;
                    sumA += valueA;
                    sumB += valueB;
                    squaresA += valueA * valueA;
                    squaresB += valueB * valueB;
                    products += valueA * valueB;
                }
            const double variances = (n * squaresA - sumA * sumA) * (n * squaresB - sumB * sumB);
            return variances > 0.0 ? (n * products - sumA * sumB) / std::sqrt(variances) : 0.0;
        }

        std::size_t channelCount() const { return m_channels; }

    private:
        double at(std::size_t channel, std::size_t frame, std::size_t cell) const
        {
            return double(m_values[(channel * m_frames + frame) * m_cells + cell]);
        }

        std::size_t m_channels;
        std::size_t m_cells;
        std::size_t m_frames = 0;
        std::vector<bool> m_isNoise; ///< for each cell, in all channels
        std::vector<float> m_values;
    };

    /// Mean coherence of all pairs.
    double coherenceOf(const Shares &shares)
    {
        double sum = 0.0;
        double pairs = 0.0;
        for (std::size_t a = 0; a < shares.channelCount(); ++a)
            for (std::size_t b = a + 1; b < shares.channelCount(); ++b) {
                const double c = std::clamp(shares.correlation(a, b), 0.0, 1.0);
                sum += 4.0 * c / (3.0 + c);
                pairs += 1.0;
            }
        return sum / pairs;
    }

} // namespace

std::optional<Advice> adviceOnChannels(const Analysis &analysis, const RunContext &context)
{
    if (analysis.lines.size() < 2)
        return {};
    const double coherence = coherenceOf(Shares(analysis, context));
    const auto count = double(analysis.lines.size());
    const double left = count / (1.0 + (count - 1.0) * coherence);
    if (left >= (1.0 - toleratedLossShare) * count)
        return {};
    char sentence[200];
    std::snprintf(sentence, sizeof sentence,
                  "the %zu channels share their noise (coherence %.2f): they carry the evidence of %.1f, and false "
                  "alarms are more frequent than specified",
                  analysis.lines.size(), coherence, left);
    Advice advice{"commonNoise", sentence, "analyse one channel", analysis.settings};
    advice.settings.selection.channels.clear();
    return advice;
}

} // namespace faintline

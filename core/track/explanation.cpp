#include "track/explanation.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr Index piece = 64;             ///< frames
    constexpr double perCell = 16.0;        ///< of the leakage's table
    constexpr double margin = 2.0;
    constexpr double negligible = 0.02;     ///< of the noise
    constexpr double farthestCells = 4096.0;

} // namespace

Explanations::Explanations(Index cells, const std::function<double(double)> &leakage)
{
    const double farthest = std::min(farthestCells, static_cast<double>(cells));
    for (double distance = 0.0; distance <= farthest; distance += 1.0 / perCell)
        m_leakage.push_back(static_cast<float>(leakage(distance)));
}

double Explanations::leakageAt(double distance) const
{
    const auto at = static_cast<std::size_t>(distance * perCell);
    return static_cast<double>(at < m_leakage.size() ? m_leakage[at] : m_leakage.back());
}

/// Cells over which a signal of that level adds what is not negligible.
double Explanations::reach(double level) const
{
    const double least = negligible / (margin * std::max(1e-3, level));
    const auto end = std::partition_point(m_leakage.begin(), m_leakage.end(),
                                          [least](float share) { return static_cast<double>(share) > least; });
    return static_cast<double>(end - m_leakage.begin()) / perCell;
}

void Explanations::add(ExplainedSignal signal)
{
    const auto last = static_cast<std::size_t>(signal.endFrame() / piece); // with the frame behind it
    if (m_byTime.size() <= last)
        m_byTime.resize(last + 1);
    for (auto i = static_cast<std::size_t>(std::max<Index>(0, signal.firstFrame - 1) / piece); i <= last; ++i)
        m_byTime[i].push_back(m_signals.size());
    m_signals.push_back(std::move(signal));
}

void Explanations::read(Index frame, Index firstCell, std::span<float> floor) const
{
    std::fill(floor.begin(), floor.end(), 1.0f);
    const auto number = static_cast<std::size_t>(frame / piece);
    if (number >= m_byTime.size())
        return;
    for (const std::size_t i : m_byTime[number]) {
        const ExplainedSignal &signal = m_signals[i];
        if (frame < signal.firstFrame - 1 || frame > signal.endFrame())
            continue;
        const auto at = static_cast<std::size_t>(
            std::clamp<Index>(frame - signal.firstFrame, 0, std::ssize(signal.positions) - 1));
        const double position = signal.positions[at] - static_cast<double>(firstCell);
        const auto level = static_cast<double>(signal.levels[at]);
        std::span<const float> skirt;
        if (!signal.skirts.empty())
            skirt = signal.skirts[std::min(at / static_cast<std::size_t>(ExplainedSignal::skirtFrames), signal.skirts.size() - 1)];
        const double end = std::max(static_cast<double>(skirt.size()), reach(level));
        const auto size = static_cast<double>(floor.size());
        const auto first = static_cast<Index>(std::clamp(std::floor(position - end), 0.0, size));
        const auto last = static_cast<Index>(std::clamp(std::ceil(position + end) + 1.0, 0.0, size));
        for (Index cell = first; cell < last; ++cell) {
            const double distance = std::abs(static_cast<double>(cell) - position);
            double share = leakageAt(distance);
            if (const auto step = static_cast<std::size_t>(std::lround(distance)); step < skirt.size())
                share = std::max(share, static_cast<double>(skirt[step]));
            floor[static_cast<std::size_t>(cell)] *= static_cast<float>(1.0 + margin * level * share);
        }
    }
}

} // namespace faintline

#include "bindings/Result.h"
#include "analyse/analyse.h"

#include <algorithm>

namespace faintline::python {

std::size_t Result::valueCount() const
{
    constexpr double most = 0x1p31;
    const auto cells = double(m_analysis->grid().size());
    const auto frames = double(m_analysis->time().count);
    if (cells * frames > most)
        throw Error("result", "has more than 2³¹ values, which are not held in memory; detect in a shorter part "
                              "(from_seconds, to_seconds) or "
                              "save(statistic=...)");
    return std::size_t(cells * frames);
}

Result::Values Result::input(const RunOptions &options)
{
    if (m_input)
        return m_input;
    const auto values = std::make_shared<std::vector<float>>(valueCount());
    const NormalisedFrames &frames = *m_analysis->frames;
    const Index cells = frames.grid().size();
    const Index atOnce = std::max<Index>(1, (Index(1) << 20) / cells);
    runInterruptibly(options, [&](const RunContext &context) {
        for (Index first = 0; first < frames.time().count; first += atOnce) {
            context.checkpoint(double(first) / double(frames.time().count), "reading");
            const Index count = std::min(atOnce, frames.time().count - first);
            frames.read(first, count,
                        std::span(*values).subspan(std::size_t(first * cells), std::size_t(count * cells)));
        }
    });
    m_input = values;
    return m_input;
}

void Result::streamStatistic(const StatisticSink &sink, const RunContext &context) const
{
    const Analysis &a = *m_analysis;
    analyse(a.recording ? OpenedSource(a.recording) : OpenedSource(a.frames), a.settings,
            {.previous = &a, .statistic = sink, .depth = AnalysisDepth::Trial}, context);
}

Result::Values Result::statistic(const RunOptions &options)
{
    if (m_statistic)
        return m_statistic;
    const auto values = std::make_shared<std::vector<float>>(valueCount());
    const Index cells = m_analysis->grid().size();
    runInterruptibly(options, [&](const RunContext &context) {
        streamStatistic(
            [&](Index first, std::span<const float> block) {
                std::ranges::copy(block, values->begin() + first * cells);
            },
            context);
    });
    m_statistic = values;
    return m_statistic;
}

} // namespace faintline::python

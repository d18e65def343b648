#include "signal/ResidualRecording.h"

#include <algorithm>
#include <functional>

namespace faintline {

namespace {

    constexpr double neighbourCells = 8.0; ///< lines further apart do not affect each other's amplitude
    constexpr Index silentRun = LineFit::silentSamples;
    constexpr std::string_view subtracting = "subtracting lines";

} // namespace

ResidualRecording::ResidualRecording(RecordingPointer base, int channel, std::vector<LinePath> paths,
                                     const Recording *noise, const RunContext &context)
    : m_base(std::move(base)), m_channel(channel)
{
    m_info = m_base->info();
    std::vector<float> simulated;
    for (LinePath &path : paths) {
        const double done = double(m_lines.size()) / double(paths.size());
        std::vector<const LineFit *> near;
        for (const LineFit &line : m_lines)
            if (line.comesNear(path, neighbourCells))
                near.push_back(&line);
        const auto read = [&](Index first, std::span<float> out) {
            context.checkpoint(done, subtracting);
            const Index samples = std::ssize(out) / m_info.floatsPerSample();
            m_base->read(channel, first, samples, out);
            if (noise) {
                simulated.resize(out.size());
                noise->read(0, first, samples, simulated);
                std::transform(out.begin(), out.end(), simulated.begin(), out.begin(), std::minus<>());
            }
            for (const LineFit *line : near)
                line->subtractFrom(first, out);
        };
        m_lines.emplace_back(LineFit::Samples{m_info, read}, std::move(path));
    }
    m_info.notes.push_back(std::to_string(m_lines.size()) + " line(s) were subtracted from channel "
                           + std::to_string(channel) + ".");
}

void ResidualRecording::read(int channel, Index first, Index count, std::span<float> out) const
{
    if (channel != m_channel)
        return m_base->read(channel, first, count, out);
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        const Index floats = m_info.floatsPerSample();
        const Index begin = from / silentRun * silentRun;
        const Index end = (from + std::ssize(inside) / floats + silentRun - 1) / silentRun * silentRun;
        std::vector<float> runs(std::size_t((end - begin) * floats));
        m_base->read(channel, begin, end - begin, runs);
        for (const LineFit &line : m_lines)
            if (line.beginSample() < end && line.endSample() > begin)
                line.subtractFrom(begin, runs);
        std::copy_n(runs.begin() + (from - begin) * floats, inside.size(), inside.begin());
    });
}

} // namespace faintline

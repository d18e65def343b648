#include "scene/InjectedRecording.h"

namespace faintline {

void checkInjections(const std::vector<InjectedLine> &lines, const RecordingInfo &recording, const std::string &name)
{
    constexpr std::size_t injectionLimitLines = 1000;
    if (lines.size() > injectionLimitLines)
        throw Error(name, "must be at most " + std::to_string(injectionLimitLines) + " lines");
    std::vector<LineSettings> settings;
    for (const InjectedLine &one : lines)
        settings.push_back(one.line);
    checkLines(settings, recording, name);
}

InjectedRecording::InjectedRecording(RecordingPointer base, const std::vector<InjectedLine> &lines, int channel,
                                     std::uint64_t seed)
    : DerivedRecording(std::move(base)), m_channel(channel)
{
    for (const auto &[line, amplitude] : lines) {
        checkLine(line, m_info, "lines[" + std::to_string(m_tones.size()) + "]");
        m_tones.emplace_back(line, amplitude, m_info, seed, std::ssize(m_tones));
    }
    m_info.notes.push_back(std::to_string(lines.size()) + " known line(s) were injected into channel "
                           + std::to_string(channel) + ".");
}

void InjectedRecording::read(int channel, Index first, Index count, std::span<float> out) const
{
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        m_base->read(channel, from, std::ssize(inside) / m_info.floatsPerSample(), inside);
        if (channel == m_channel)
            for (const Tone &tone : m_tones)
                tone.addTo(from, inside);
    });
}

Truth InjectedRecording::truth() const
{
    return truthOf(m_tones);
}

} // namespace faintline

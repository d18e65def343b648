#include "scene/SimulatedRecording.h"

namespace faintline {

namespace {

    const LineScene &checked(const LineScene &scene)
    {
        checkScene(scene);
        return scene;
    }

} // namespace

SimulatedRecording::SimulatedRecording(const LineScene &scene)
    : m_scene(checked(scene)),
      m_noise(scene.noise, scene.sampleRateHz, scene.durationSeconds, scene.isComplex, std::uint64_t(scene.seed))
{
    m_info = recordingInfo(scene);
    for (const LineSettings &line : scene.lines) {
        const double variance = m_noise.localVariance(line.frequencyHz - scene.centreHz);
        const double amplitude =
            toneAmplitude(line.snrDb, variance, line.referenceSeconds * scene.sampleRateHz, scene.isComplex);
        m_tones.emplace_back(line, amplitude, m_info, std::uint64_t(scene.seed), std::ssize(m_tones));
    }
}

void SimulatedRecording::read(int, Index first, Index count, std::span<float> out) const
{
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        m_noise.read(from, inside);
        for (const Tone &tone : m_tones)
            tone.addTo(from, inside);
    });
}

Truth SimulatedRecording::truth() const
{
    Truth truth;
    for (const Tone &tone : m_tones)
        truth.lines.push_back(tone.truth());
    return truth;
}

} // namespace faintline

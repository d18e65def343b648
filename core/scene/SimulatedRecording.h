#pragma once

#include "scene/LineScene.h"
#include "scene/NoiseSource.h"
#include "scene/Tone.h"

namespace faintline {

/// A scene as a recording: x(n) = noise(n) + Σ tones(n), a pure function of (scene, n), computed when read.
///
/// Each line's amplitude follows from its SNR and the noise density at its first frequency (toneAmplitude). Memory does
/// not grow with the length, except for the nodes of wandering and fading lines (16 bytes per 0.1·referenceSeconds) and
/// the powers of lines that change from frame to frame (4 bytes per referenceSeconds).
/// Thread-safe.
class SimulatedRecording final : public Recording
{
public:
    /// Throws Error as checkScene does.
    explicit SimulatedRecording(const LineScene &scene);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    int scaleExponent(int) const override { return scaleExponentOf(m_scene.noise.deviation); }

    const LineScene &scene() const { return m_scene; }
    Truth truth() const;

private:
    LineScene m_scene;
    NoiseSource m_noise;
    std::vector<Tone> m_tones;
};

} // namespace faintline

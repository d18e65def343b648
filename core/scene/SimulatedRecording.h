#pragma once

#include "base/Axis.h"
#include "scene/LineScene.h"
#include "scene/Tone.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace faintline {

/// Gaussian noise as a function of (settings, seed, sample index): white or coloured by first-order sections, of
/// constant or drifting level.
///
/// A slope of s dB per octave is built from ten pole-zero pairs, an octave apart, starting at 1/1024 of half the rate,
/// with |s|/6.02 octaves between pole and zero (within 1 dB of the slope up to a quarter of the rate). As a
/// partial-fraction sum,
///
///   y(n) = d·x(n) + Σ sₖ(n),   sₖ(n) = pₖ·sₖ(n-1) + rₖ·x(n)
///
/// scaled to the wanted standard deviation in closed form. Coloured noise is generated in fixed blocks, each with a
/// run-up from rest, so a stretch gives the same values however it is divided. Thread-safe.
class NoiseSource
{
public:
    NoiseSource(const NoiseSettings &settings, double sampleRateHz, double durationSeconds, bool isComplex,
                std::uint64_t seed);

    /// Writes samples from `first` on: one float each, or two if complex.
    void read(Index first, std::span<float> out) const;

    /// Variance of white noise with the same density at a frequency (relative to the centre), without level drift.
    double localVariance(double frequencyHz) const;

private:
    static constexpr std::size_t sections = 10;

    void design(double slopeDbPerOctave);
    void readWhite(Index first, std::span<float> out) const;
    void readColoured(Index first, std::span<float> out) const;
    void colour(std::span<float> samples) const;
    void applyLevel(Index first, std::span<float> out) const;

    NoiseSettings m_settings;
    double m_sampleRateHz;
    Index m_floats;
    std::uint64_t m_seed;
    bool m_isColoured;
    double m_direct = 1.0; ///< d
    std::array<double, sections> m_poles{};
    std::array<double, sections> m_residues{};
    std::vector<double> m_level; ///< amplitude factors at nodes; empty means 1
    double m_levelStepSeconds = 0.0;
};

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

/// The same with its samples in memory, unless these are more than 2²³ numbers; for those that are read several times.
RecordingPointer simulatedInMemory(const LineScene &scene);

} // namespace faintline

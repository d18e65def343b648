#pragma once

#include "frames/NormalisedFrames.h"
#include "scene/PingScene.h"
#include "scene/PingTruth.h"

namespace faintline {

/// A scene of sonar pings, or of a radar's scans, as normalised frames: a pure function of (scene, ping), computed when
/// read.
///
///   y(r, b) = [ (1/M) Σ_l |√m(r) n_l + echo|² + … ] / m̂(r, b)
///
/// n_l: complex white noise, E|n|² = 1, for each of M looks; m(r): power of noise and reverberation, that of the noise
/// being 1; the echo depends on the target's kind. m̂ is m if known. If estimated, it is the mean of the same ping's
/// cells at ±16 ranges in all beams without the cell's own neighbourhood of ±2 × ±1 (at the ends of the range axis the
/// window shrinks symmetrically, to at least ±4), times NM/(NM - 1), so that y has mean exactly 1 on a level background
/// of N cells. Cost: 2M normals per cell. Memory: two frames. Thread-safe.
class SimulatedPings final : public NormalisedFrames
{
public:
    /// Throws Error as checkScene does.
    explicit SimulatedPings(const PingScene &scene);

    void read(Index first, Index count, std::span<float> out) const override;

    const PingScene &scene() const { return m_scene; }
    const PingTruth &truth() const { return m_truth; }

private:
    void readPing(Index ping, std::span<float> y) const;
    void addEchoes(Index ping, std::span<const float> noise, std::span<float> power) const;
    void divideByEstimate(std::span<float> power) const;

    PingScene m_scene;
    PingTruth m_truth;
    std::vector<float> m_background; ///< m of each range cell
};

} // namespace faintline

#pragma once

#include "base/Random.h"
#include "calibrate/noiseStreams.h"
#include "detect/Detector.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace faintline {

/// State of noise and detector at one moment.
struct NoiseParticle {
    std::vector<float> noise;
    std::shared_ptr<const DetectorState> detector;
    double reached = 0.0; ///< largest D of the frame
};

/// Noise and a detector on it, frame by frame; it can continue from the state of another.
class NoiseWalker
{
public:
    NoiseWalker(std::unique_ptr<Detector> detector, std::unique_ptr<NoiseStream> noise)
        : m_detector(std::move(detector)), m_noise(std::move(noise)), m_y(std::size_t(m_noise->cells())),
          m_statistic(m_y.size())
    {
    }

    /// Takes the next frame; returns its largest D.
    double step(Random &random)
    {
        m_noise->next(random, m_y);
        m_detector->update(m_y, m_statistic);
        return double(*std::max_element(m_statistic.begin(), m_statistic.end()));
    }

    NoiseParticle particle(double reached) const { return {m_noise->state(), m_detector->state(), reached}; }
    void take(const NoiseParticle &particle)
    {
        m_noise->setState(particle.noise);
        m_detector->setState(*particle.detector);
    }
    Index cells() const { return m_noise->cells(); }

private:
    std::unique_ptr<Detector> m_detector;
    std::unique_ptr<NoiseStream> m_noise;
    std::vector<float> m_y;
    std::vector<float> m_statistic;
};

} // namespace faintline

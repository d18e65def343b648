#pragma once

#include "base/Field.h"
#include "detect/Detector.h"

#include <array>
#include <string_view>
#include <vector>

namespace faintline {

/// How the integrator weights the past.
struct IntegratorSettings {
    enum class Shape { Boxcar, Exponential };
    static constexpr std::array<std::string_view, 2> shapeNames{"boxcar", "exponential"};

    Shape shape = Shape::Boxcar;
    /// Length or time constant, in windows of the spectrogram (in frames for ready-made frames).
    double durationWindows = 100.0;

    static const std::vector<Field<IntegratorSettings>> &fields();
    bool operator==(const IntegratorSettings &) const = default;
};

/// Mean power of a cell over the past: the ideal detector of a stable line of known duration.
///
///   boxcar        D(t, f) = (1/n) Σ y(t', f), t-n < t' ≤ t
///   exponential   D(t, f) = (1-a)·y(t, f) + a·D(t-1, f),   a = e^{-1/n}
///
/// with n frames; frames before the first, and the initial D of the exponential, count as 0. A single frame (n = 1,
/// boxcar) gives the energy detector. Source: Billon 2005 section 5. Oracle: direct sums; Marcum's Q. Sums are kept in
/// double precision.
class Integrator final : public Detector
{
public:
    Integrator(Index cells, IntegratorSettings::Shape shape, Index frames);

    void update(std::span<const float> y, std::span<float> statistic) override;
    /// Sets the cells' past to that of noise: D = 1.
    void forget(const Grid &grid, const CellBox &box) override;
    /// Null for a single frame, which has no past.
    std::shared_ptr<const DetectorState> state() const override
    {
        return m_past.size() == 1 ? nullptr : copiedState(*this);
    }
    void setState(const DetectorState &state) override { setCopiedState(*this, state); }
    std::size_t bytes() const; ///< memory used

private:
    Index m_frames;
    double m_decay;
    std::vector<double> m_sum;
    std::vector<std::vector<float>> m_past; ///< boxcar: the frames in the sum
    std::size_t m_next = 0;
};

} // namespace faintline

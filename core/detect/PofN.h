#pragma once

#include "base/Field.h"
#include "detect/Detector.h"

#include <vector>

namespace faintline {

/// Window and thresholds of P-out-of-N detection.
struct PofNSettings {
    int p = 3;
    int n = 4;               ///< frames in the window
    double r1 = 2.0;         ///< a frame has an event if the largest y in the window's band exceeds this
    double r2 = 0.0;         ///< the mean of the P largest must also exceed this
    double widthCells = 1.0; ///< bandwidth of the window, resolution cells

    static const std::vector<Field<PofNSettings>> &fields();
    bool operator==(const PofNSettings &) const = default;
};

/// P-out-of-N detection.
///
///   m(t, f) = max{ y(t, g) : f - ⌊(w-1)/2⌋ ≤ g ≤ f + ⌊w/2⌋ },   w the window's bandwidth in cells
///   D(t, f) = mean of the P largest m(t', f), t-N < t' ≤ t, if the P-th largest exceeds r1 and the mean exceeds r2,
///             else 0
///
/// Cells off the axis and frames before the first count as empty. On a grid of several axes the band lies along the
/// last. Source: Billon 2005 sections 1 and 5. Oracle: sorting each window. Cost: N·min(P, N-P+1) operations per cell.
class PofN final : public Detector
{
public:
    /// `widthCells` of the settings corresponds to `binsPerCell` grid cells each. Throws Error for P > N.
    PofN(const Grid &grid, const PofNSettings &settings, double binsPerCell = 1.0);

    void update(std::span<const float> y, std::span<float> statistic) override;
    void forget(const Grid &grid, const CellBox &box) override;
    std::shared_ptr<const DetectorState> state() const override { return copiedState(*this); }
    void setState(const DetectorState &state) override { setCopiedState(*this, state); }
    std::size_t bytes() const; ///< memory used

private:
    Index m_rowLength; ///< cells along the last axis
    Index m_width;
    PofNSettings m_settings;
    /// The last N frames, padded; the oldest one, m_next, is overwritten next.
    std::vector<std::vector<float>> m_maxima;
    std::size_t m_next = 0;
    std::vector<float> m_means;    ///< means of the P largest, padded to whole vectors
    std::vector<float> m_smallest; ///< smallest of the P largest
};

} // namespace faintline

#pragma once

#include "base/CellBox.h"
#include "model/StateSpace.h"

#include <memory>
#include <span>

namespace faintline {

/// Everything on which a detector's next frame depends.
struct DetectorState {
    virtual ~DetectorState() = default;
    virtual std::size_t bytes() const = 0; ///< memory used
};

/// Converts frames to a statistic, one frame after the other.
///
/// A frame holds one y per cell (noise mean 1); the statistic has one value per cell, larger where a signal is
/// likelier. A detector has state; use one object per thread.
class Detector
{
public:
    virtual ~Detector() = default;

    /// Takes one frame of cellCount values; writes the statistic D of each cell, or -∞ if this frame decides nothing.
    virtual void update(std::span<const float> y, std::span<float> statistic) = 0;

    /// Takes several consecutive frames: gives the same bytes as one at a time, but faster if the detector can look
    /// ahead.
    virtual void updateBlock(std::span<const float> y, std::span<float> statistic, Index cells);

    /// Maximum number of threads per update; it does not change the result.
    virtual void useThreads(int /*threads*/) {}

    /// Forgets the evidence of the past in a box of cells, as if only noise had been there.
    virtual void forget(const Grid &grid, const CellBox &box) = 0;

    /// Specifies the cells, ascending, that trackers follow. Until the next call their states do not count in the
    /// regulation.
    virtual void inhibit(std::span<const Index> /*cells*/) {}

    /// Everything on which the next frame depends; null if the detector cannot save its state.
    virtual std::shared_ptr<const DetectorState> state() const { return {}; }
    /// Continues from a state of this detector, or of one with the same settings, with identical bits.
    virtual void setState(const DetectorState & /*state*/) {}
};

/// Stores a detector's state as a copy of the detector, for detectors with value members only. D::bytes() gives its
/// size.
template <class D>
struct CopiedState final : DetectorState {
    explicit CopiedState(const D &copied) : detector(copied) {}
    std::size_t bytes() const override { return detector.bytes(); }

    D detector;
};

template <class D>
std::shared_ptr<const DetectorState> copiedState(const D &detector)
{
    return std::make_shared<CopiedState<D>>(detector);
}

template <class D>
void setCopiedState(D &detector, const DetectorState &state)
{
    detector = static_cast<const CopiedState<D> &>(state).detector;
}

} // namespace faintline

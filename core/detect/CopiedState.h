#pragma once

#include "detect/Detector.h"

#include <memory>

namespace faintline {

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

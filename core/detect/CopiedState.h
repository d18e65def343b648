#pragma once

#include "detect/Detector.h"

#include <utility>

namespace faintline {

/// A detector's state as a copy of the detector, for those whose members are all values. D::bytes() says what one takes.
template <class D>
struct CopiedState final : Detector::Remembrance {
    explicit CopiedState(const D &copied) : detector(copied) {}
    std::size_t bytes() const override { return detector.bytes(); }

    D detector;
};

template <class D>
std::shared_ptr<const Detector::Remembrance> copiedState(const D &detector)
{
    return std::make_shared<CopiedState<D>>(detector);
}

template <class D>
void recallCopy(D &detector, const Detector::Remembrance &remembrance)
{
    detector = static_cast<const CopiedState<D> &>(remembrance).detector;
}

} // namespace faintline

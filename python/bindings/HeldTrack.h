#pragma once

#include "analysis/analyse.h"

#include <memory>

namespace faintline::python {

/// A track as Python holds it: one of an analysis's, which it keeps alive.
struct HeldTrack {
    std::shared_ptr<const Analysis> analysis;
    std::size_t number = 0;

    const Track &track() const { return analysis->tracks[number]; }
};

} // namespace faintline::python

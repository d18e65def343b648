#pragma once

#include "plan/Analysis.h"

#include <memory>

namespace faintline::python {

/// Python object for a track of an analysis, which it keeps alive.
struct HeldTrack {
    std::shared_ptr<const Analysis> analysis;
    std::size_t number = 0;

    const Track &track() const { return analysis->tracks[number]; }
};

} // namespace faintline::python

#pragma once

#include "analysis/explain.h"

#include <memory>

namespace faintline::python {

/// An explanation as Python holds it, with the analysis that its states are numbered by.
struct HeldExplanation {
    std::shared_ptr<const Analysis> analysis;
    Explanation explanation;
};

} // namespace faintline::python

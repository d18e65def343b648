#pragma once

#include "inspect/explain.h"

#include <memory>

namespace faintline::python {

/// Python object for an explanation, with the analysis to which its state numbers refer.
struct HeldExplanation {
    std::shared_ptr<const Analysis> analysis;
    Explanation explanation;
};

} // namespace faintline::python

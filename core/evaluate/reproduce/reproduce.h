#pragma once

#include "evaluate/reproduce/Reproduction.h"

#include <string_view>
#include <vector>

namespace faintline {

/// All tables and figures that can be made, in the order of publication.
const std::vector<Reproducible> &reproducibles();

/// The one of that name; throws Error naming all.
const Reproducible &reproducible(std::string_view name);

} // namespace faintline

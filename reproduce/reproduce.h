#pragma once

#include "reproduce/Reproduction.h"

#include <string_view>
#include <vector>

namespace faintline {

/// All reproducible tables and figures, in the order of publication.
const std::vector<Reproducible> &reproducibles();

/// The table or figure of that name; throws Error listing all names.
const Reproducible &reproducible(std::string_view name);

} // namespace faintline

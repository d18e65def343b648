#pragma once

#include <cstddef>
#include <string_view>

namespace faintline {

/// Number of letters to insert, remove or replace to get from one word to the other: to suggest what was meant.
std::size_t editDistance(std::string_view a, std::string_view b);

} // namespace faintline

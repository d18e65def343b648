#pragma once

#include <cstddef>

namespace faintline {

// What K members of a family have together, brought to the law of one: exponential of mean 1 on noise. Nothing to do
// for one member.

constexpr std::size_t mostMembers = 64;

/// -ln Q(K, Σ y), Q the regularised upper incomplete gamma function; K = 1 … mostMembers.
float powerOfSum(float sum, std::size_t members);

/// -ln(1 - (1 - e^(-max y))^K).
float powerOfLargest(float maximum, std::size_t members);

} // namespace faintline

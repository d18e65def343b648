#pragma once

#include <cstddef>

namespace faintline {

class LooksLaw;

// What K members of a family have together, brought to the law of one: exponential of mean 1 on noise. Nothing to do
// for one member.

constexpr std::size_t mostMembers = 64;
constexpr std::size_t mostSummed = mostMembers * 64; ///< of members, in as many channels

/// -ln Q(K, Σ y), Q the regularised upper incomplete gamma function; K = 1 … mostSummed.
float powerOfSum(float sum, std::size_t members);

/// The same law, to be kept: of Σ y/K.
const LooksLaw &lawOfSum(std::size_t members);

/// -ln(1 - (1 - e^(-max y))^K).
float powerOfLargest(float maximum, std::size_t members);

} // namespace faintline

#pragma once

#include <cstddef>

namespace faintline {

class LooksLaw;

// Transforms the joint power of K members of a family to the law of one: exponential of mean 1 on noise. The identity
// for one member.

constexpr std::size_t mostMembers = 64;
constexpr std::size_t mostSummed = mostMembers * 64; ///< members × channels

/// -ln Q(K, Σ y), Q the regularised upper incomplete gamma function; K = 1 … mostSummed.
float powerOfSum(float sum, std::size_t members);

/// The same law as a reusable object, as a function of Σ y/K.
const LooksLaw &lawOfSum(std::size_t members);

/// -ln(1 - (1 - e^(-max y))^K).
float powerOfLargest(float maximum, std::size_t members);

} // namespace faintline

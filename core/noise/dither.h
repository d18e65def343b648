#pragma once

#include <cstdint>

namespace faintline {

/// Uniform in 0 … 1, as a function of a counter (Steele and others 2014, splitmix64). Added to quantised values, it
/// gives them a continuous law; as a hash, the same value always gets the same number.
inline float uniformAt(std::uint64_t counter)
{
    std::uint64_t z = counter * 0x9e3779b97f4a7c15u + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return float((z ^ (z >> 31)) >> 40) * 0x1p-24f;
}

} // namespace faintline

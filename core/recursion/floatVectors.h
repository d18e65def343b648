#pragma once

#include "base/multiversion.h"

namespace faintline::vectors {

// Vectors of floats for the inner loops of the recursion. Wide ones never cross a call, because all functions that take
// them are inlined.

// GCC warns that a vector wider than the ABI's registers is returned differently with and without them.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

template <int bytes>
using Floats = typename Vector<float, bytes>::Type;
template <int bytes>
using Integers = typename Vector<int, bytes>::Type;

template <int bytes>
[[gnu::always_inline]] inline Floats<bytes> load(const float *from)
{
    return *reinterpret_cast<const typename Vector<float, bytes>::Unaligned *>(from);
}

template <class Values>
[[gnu::always_inline]] inline void store(float *to, const Values &values)
{
    *reinterpret_cast<typename Vector<float, sizeof(Values)>::Unaligned *>(to) = values;
}

template <class Values>
[[gnu::always_inline]] inline Values larger(const Values &a, const Values &b)
{
    return a > b ? a : b;
}

#pragma GCC diagnostic pop

} // namespace faintline::vectors

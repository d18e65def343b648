#pragma once

#include "recursion/joinKernels.h"

#include <cmath>
#include <limits>
#include <span>

namespace faintline {

/// The (⊕, ⊗) of the recursion. Scores are logarithms under max-plus, plain weights under sum-product.
template <class R>
struct MaxPlus {
    using Real = R;
    static constexpr bool logarithmic = true;
};

struct SumProduct {
    using Real = double;
    static constexpr bool logarithmic = false;
};

/// Neutral element of ⊕.
template <class Semiring>
constexpr typename Semiring::Real neutral()
{
    if constexpr (Semiring::logarithmic)
        return -std::numeric_limits<typename Semiring::Real>::infinity();
    else
        return 0;
}

template <class Semiring>
typename Semiring::Real weightOf(double lnProbability)
{
    return static_cast<typename Semiring::Real>(Semiring::logarithmic ? lnProbability : std::exp(lnProbability));
}

/// to[i] = ⊕_k from_k[i] ⊗ weight_k
template <class Semiring>
void joinSources(typename Semiring::Real *to, Index n, std::span<const ShiftedPlane<typename Semiring::Real>> sources)
{
    if constexpr (Semiring::logarithmic)
        joinMax(to, n, sources);
    else
        joinSum(to, n, sources);
}

} // namespace faintline

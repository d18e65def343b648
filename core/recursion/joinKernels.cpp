#include "recursion/joinKernels.h"

#include "base/multiversion.h"
#include "recursion/floatVectors.h"

#include <algorithm>
#include <limits>

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi" // wide vectors never cross a call: all of their functions are inlined
#endif

namespace faintline {

namespace {

    using namespace vectors;

    constexpr Index lanes = 64; ///< values kept in registers while all sources are joined

    struct MaxJoin {
        template <class Real>
        Real first(Real value, Real weight) const
        {
            return value + weight;
        }
        template <class Real>
        Real next(Real best, Real value, Real weight) const
        {
            const Real candidate = value + weight;
            return candidate > best ? candidate : best;
        }
        template <class Real>
        Real last(Real best, Real) const
        {
            return best;
        }
    };

    /// For equal weights: max(a + w, b + w) = max(a, b) + w to the last bit, because rounding is monotone.
    struct EqualMaxJoin {
        template <class Real>
        Real first(Real value, Real) const
        {
            return value;
        }
        template <class Real>
        Real next(Real best, Real value, Real) const
        {
            return value > best ? value : best;
        }
        template <class Real>
        Real last(Real best, Real weight) const
        {
            return best + weight;
        }
    };

    struct SumJoin {
        double first(double value, double weight) const { return value * weight; }
        double next(double sum, double value, double weight) const { return sum + value * weight; }
        double last(double sum, double) const { return sum; }
    };

    /// to[i] = ⊕_k from_k[i] ⊗ weight_k, in the order of the sources.
    template <class Real, class Join>
    [[gnu::always_inline]] inline void joinAll(Real *to, Index n, const ShiftedPlane<Real> *sources, std::size_t count,
                                               Join join)
    {
        Index i = 0;
        for (; i + lanes <= n; i += lanes) {
            Real sum[lanes];
            for (Index lane = 0; lane < lanes; ++lane)
                sum[lane] = join.first(sources[0].from[i + lane], sources[0].weight);
            for (std::size_t k = 1; k < count; ++k) {
                const Real *from = sources[k].from + i;
                const Real weight = sources[k].weight;
                for (Index lane = 0; lane < lanes; ++lane)
                    sum[lane] = join.next(sum[lane], from[lane], weight);
            }
            for (Index lane = 0; lane < lanes; ++lane)
                to[i + lane] = join.last(sum[lane], sources[0].weight);
        }
        for (; i < n; ++i) {
            Real sum = join.first(sources[0].from[i], sources[0].weight);
            for (std::size_t k = 1; k < count; ++k)
                sum = join.next(sum, sources[k].from[i], sources[k].weight);
            to[i] = join.last(sum, sources[0].weight);
        }
    }

    template <class Real>
    [[gnu::always_inline]] inline bool haveEqualWeights(std::span<const ShiftedPlane<Real>> sources)
    {
        for (const ShiftedPlane<Real> &source : sources)
            if (source.weight != sources.front().weight)
                return false;
        return true;
    }

    template <class Real>
    [[gnu::always_inline]] inline void joinMaxima(Real *to, Index n, std::span<const ShiftedPlane<Real>> sources)
    {
        if (sources.empty())
            std::fill_n(to, n, -std::numeric_limits<Real>::infinity());
        else if (haveEqualWeights(sources))
            joinAll(to, n, sources.data(), sources.size(), EqualMaxJoin());
        else
            joinAll(to, n, sources.data(), sources.size(), MaxJoin());
    }

    /// `joinMaxima` for floats: keeps some cells in registers while iterating over the sources.
    template <int bytes, bool equal>
    [[gnu::always_inline]] inline Index joinVectors(float *to, Index n, std::span<const ShiftedPlane<float>> sources)
    {
        constexpr Index width = Vector<float, bytes>::lanes;
        const float common = sources.front().weight;
        Index i = 0;
        for (; i + 2 * width <= n; i += 2 * width) {
            const float *first = sources.front().from + i;
            Floats<bytes> a = equal ? load<bytes>(first) : load<bytes>(first) + common;
            Floats<bytes> b = equal ? load<bytes>(first + width) : load<bytes>(first + width) + common;
            for (const ShiftedPlane<float> &source : sources.subspan(1)) {
                const float weight = source.weight;
                const Floats<bytes> nextA = load<bytes>(source.from + i);
                const Floats<bytes> nextB = load<bytes>(source.from + i + width);
                a = larger(equal ? nextA : nextA + weight, a);
                b = larger(equal ? nextB : nextB + weight, b);
            }
            store(to + i, equal ? a + common : a);
            store(to + i + width, equal ? b + common : b);
        }
        return i;
    }

} // namespace

void joinMax(float *to, Index n, std::span<const ShiftedPlane<float>> sources)
{
    withVectors([&](auto bytes) __attribute__((always_inline)) {
        Index i = 0;
        if (!sources.empty())
            i = haveEqualWeights(sources) ? joinVectors<bytes, true>(to, n, sources)
                                          : joinVectors<bytes, false>(to, n, sources);
        for (; i < n; ++i) {
            float best = -std::numeric_limits<float>::infinity();
            for (const ShiftedPlane<float> &source : sources) {
                const float candidate = source.from[i] + source.weight;
                best = candidate > best ? candidate : best;
            }
            to[i] = best;
        }
    });
}

FAINTLINE_MULTIVERSION
void joinMax(double *to, Index n, std::span<const ShiftedPlane<double>> sources)
{
    joinMaxima(to, n, sources);
}

FAINTLINE_MULTIVERSION
void joinSum(double *to, Index n, std::span<const ShiftedPlane<double>> sources)
{
    if (sources.empty())
        std::fill_n(to, n, 0.0);
    else
        joinAll(to, n, sources.data(), sources.size(), SumJoin());
}

FAINTLINE_MULTIVERSION
void maxOfTwo(float *to, const float *a, const float *b, Index n)
{
    for (Index i = 0; i < n; ++i)
        to[i] = b[i] > a[i] ? b[i] : a[i];
}

FAINTLINE_MULTIVERSION
void maxOfTwo(double *to, const double *a, const double *b, Index n)
{
    for (Index i = 0; i < n; ++i)
        to[i] = b[i] > a[i] ? b[i] : a[i];
}

FAINTLINE_MULTIVERSION
void addEach(float *to, const float *more, Index n)
{
    for (Index i = 0; i < n; ++i)
        to[i] += more[i];
}

FAINTLINE_MULTIVERSION
void addEach(double *to, const double *more, Index n)
{
    for (Index i = 0; i < n; ++i)
        to[i] += more[i];
}

FAINTLINE_MULTIVERSION
void multiplyEach(double *to, const double *factors, Index n)
{
    for (Index i = 0; i < n; ++i)
        to[i] *= factors[i];
}

} // namespace faintline

#include "detect/joinKernels.h"

#include "base/multiversion.h"

#include <algorithm>
#include <limits>

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi" // wide vectors never cross a call: all of their functions are inlined
#endif

namespace faintline {

namespace {

    constexpr Index lanes = 64; ///< values kept in registers while all sources are joined to them

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

    /// Where all weights are the same: max(a + w, b + w) = max(a, b) + w to the last bit, for rounding is monotone.
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

    /// to[i] = ⊕_k from_k[i] ⊗ weight_k, the sources in their order.
    template <class Real, class Join>
    [[gnu::always_inline]] inline void joinAll(Real *to, Index n, const ShiftedPlane<Real> *sources, std::size_t count, Join join)
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

    // Sixteen floats, in as many registers as the instruction set needs for them: arrays of a plain loop would not stay in registers
    // while the targets go by.
    using Floats = float __attribute__((vector_size(64)));
    using Integers = int __attribute__((vector_size(64)));
    using UnalignedFloats = float __attribute__((vector_size(64), aligned(4)));
    constexpr Index width = 16;

    [[gnu::always_inline]] inline Floats load(const float *from)
    {
        return *reinterpret_cast<const UnalignedFloats *>(from);
    }

    [[gnu::always_inline]] inline void store(float *to, const Floats &values)
    {
        *reinterpret_cast<UnalignedFloats *>(to) = values;
    }

    [[gnu::always_inline]] inline Floats larger(const Floats &a, const Floats &b)
    {
        return a > b ? a : b;
    }

    struct Lane {
        Floats lambda;
        Floats statistic;
        Integers count;
        Floats sum;
    };

    /// The part of a frame that `finishMax` goes through with `vectors` × 16 cells at a time.
    template <int vectors, bool wantsSum>
    [[gnu::always_inline]] inline Index finish(std::span<const TargetPlane> targets, Index i, Index n, Index sourceOffset, Index targetOffset,
                                               const float *lambda, const FrameJoin &join, float *statistic, Continued &continued)
    {
        Lane lane[vectors] = {};
        const Floats floor = Floats{} + join.floor;
        for (; i + vectors * width <= n; i += vectors * width) {
            for (int v = 0; v < vectors; ++v) {
                lane[v].lambda = load(lambda + i + v * width);
                lane[v].statistic = load(statistic + i + v * width);
            }
            for (const TargetPlane &target : targets) {
                const ShiftedPlane<float> *source = target.sources.data();
                const std::size_t count = target.sources.size();
                const Index from = i + sourceOffset;
                const auto end = [&](int v, const Floats &best, float weight) __attribute__((always_inline)) {
                    const Floats going = (best + weight) + join.lnK;
                    const Floats kept = larger(going, floor);
                    const Floats score = lane[v].lambda + kept;
                    store(target.to + targetOffset + i + v * width, score);
                    lane[v].count -= score > lane[v].lambda;
                    lane[v].statistic = larger(score, lane[v].statistic);
                    if constexpr (wantsSum)
                        lane[v].sum += kept;
                };
                // One, two and three of equal weight are nearly all there are.
                const bool equal = count > 0 && count < 4 && source[0].weight == source[count - 1].weight && source[0].weight == source[count / 2].weight;
                if (equal && count == 3) {
                    for (int v = 0; v < vectors; ++v)
                        end(v,
                            larger(larger(load(source[1].from + from + v * width), load(source[0].from + from + v * width)),
                                   load(source[2].from + from + v * width)),
                            source[0].weight);
                } else if (equal && count == 2) {
                    for (int v = 0; v < vectors; ++v)
                        end(v, larger(load(source[1].from + from + v * width), load(source[0].from + from + v * width)), source[0].weight);
                } else if (equal && count == 1) {
                    for (int v = 0; v < vectors; ++v)
                        end(v, load(source[0].from + from + v * width), source[0].weight);
                } else {
                    for (int v = 0; v < vectors; ++v) {
                        Floats best = Floats{} - std::numeric_limits<float>::infinity();
                        for (std::size_t k = 0; k < count; ++k)
                            best = larger(load(source[k].from + from + v * width) + source[k].weight, best);
                        end(v, best, 0.0f);
                    }
                }
            }
            for (int v = 0; v < vectors; ++v)
                store(statistic + i + v * width, lane[v].statistic);
        }
        for (int v = 0; v < vectors; ++v)
            for (Index k = 0; k < width; ++k) {
                continued.count += lane[v].count[k];
                continued.sum += static_cast<double>(lane[v].sum[k]);
            }
        return i;
    }

    [[gnu::always_inline]] inline void finishOne(std::span<const TargetPlane> targets, Index i, Index sourceOffset, Index targetOffset,
                                                 const float *lambda, const FrameJoin &join, float *statistic, Continued &continued)
    {
        for (const TargetPlane &target : targets) {
            float best = -std::numeric_limits<float>::infinity();
            for (const ShiftedPlane<float> &source : target.sources) {
                const float candidate = source.from[i + sourceOffset] + source.weight;
                best = candidate > best ? candidate : best;
            }
            const float going = best + join.lnK;
            const float kept = going > join.floor ? going : join.floor;
            const float score = lambda[i] + kept;
            target.to[targetOffset + i] = score;
            continued.count += score > lambda[i] ? 1 : 0;
            continued.sum += join.wantsSum ? static_cast<double>(kept) : 0.0;
            statistic[i] = score > statistic[i] ? score : statistic[i];
        }
    }

} // namespace

FAINTLINE_MULTIVERSION
void joinMax(float *to, Index n, std::span<const ShiftedPlane<float>> sources)
{
    joinMaxima(to, n, sources);
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

FAINTLINE_MULTIVERSION
Continued finishMax(std::span<const TargetPlane> targets, Index n, Index sourceOffset, Index targetOffset, const float *lambda,
                    const FrameJoin &join, float *statistic)
{
    Continued continued;
    Index i = 0;
    if (join.wantsSum) {
        i = finish<2, true>(targets, i, n, sourceOffset, targetOffset, lambda, join, statistic, continued);
        i = finish<1, true>(targets, i, n, sourceOffset, targetOffset, lambda, join, statistic, continued);
    } else {
        i = finish<2, false>(targets, i, n, sourceOffset, targetOffset, lambda, join, statistic, continued);
        i = finish<1, false>(targets, i, n, sourceOffset, targetOffset, lambda, join, statistic, continued);
    }
    for (; i < n; ++i)
        finishOne(targets, i, sourceOffset, targetOffset, lambda, join, statistic, continued);
    return continued;
}

} // namespace faintline

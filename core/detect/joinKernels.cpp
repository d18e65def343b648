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

    /// `joinMaxima` for floats: two vectors at a time stay in registers while the sources go by.
    template <bool equal>
    [[gnu::always_inline]] inline Index joinVectors(float *to, Index n, std::span<const ShiftedPlane<float>> sources)
    {
        const Floats common = Floats{} + sources.front().weight;
        Index i = 0;
        for (; i + 2 * width <= n; i += 2 * width) {
            const float *first = sources.front().from + i;
            Floats a = equal ? load(first) : load(first) + common;
            Floats b = equal ? load(first + width) : load(first + width) + common;
            for (const ShiftedPlane<float> &source : sources.subspan(1)) {
                const float weight = equal ? 0.0f : source.weight;
                const Floats nextA = equal ? load(source.from + i) : load(source.from + i) + weight;
                const Floats nextB = equal ? load(source.from + i + width) : load(source.from + i + width) + weight;
                a = larger(nextA, a);
                b = larger(nextB, b);
            }
            store(to + i, equal ? a + common : a);
            store(to + i + width, equal ? b + common : b);
        }
        return i;
    }

    /// A target's sources as the inner loop wants them: nearly all have three of equal weight, or fewer, one of which may then count twice.
    struct Joined {
        const float *first;
        const float *second;
        const float *third;
        float weight;
        float *to;
        const TargetPlane *general; ///< where they are more, or differ in weight
    };

    constexpr std::size_t mostAtOnce = 64; ///< targets

    [[gnu::always_inline]] inline Joined joined(const TargetPlane &target, Index sourceOffset, Index targetOffset)
    {
        const std::span<const ShiftedPlane<float>> sources = target.sources;
        Joined result{nullptr, nullptr, nullptr, 0.0f, target.to + targetOffset, &target};
        if (sources.empty() || sources.size() > 3 || !haveEqualWeights(sources))
            return result;
        result.first = sources.front().from + sourceOffset;
        result.second = sources[sources.size() / 2].from + sourceOffset;
        result.third = sources.back().from + sourceOffset;
        result.weight = sources.front().weight;
        result.general = nullptr;
        return result;
    }

    /// The maximum over any sources, their weights included.
    [[gnu::always_inline]] inline Floats bestOf(const TargetPlane &target, Index i)
    {
        Floats best = Floats{} - std::numeric_limits<float>::infinity();
        for (const ShiftedPlane<float> &source : target.sources)
            best = larger(load(source.from + i) + source.weight, best);
        return best;
    }

    /// One or two vectors of cells at a time through all targets: what belongs to the cells stays in registers.
    template <bool pairs, bool wantsSum>
    [[gnu::always_inline]] inline Index finishVectors(std::span<const Joined> targets, Index i, Index n, Index sourceOffset,
                                                      const float *lambda, const FrameJoin &join, bool isFresh, float *statistic,
                                                      Continued &continued)
    {
        constexpr Index step = pairs ? 2 * width : width;
        constexpr Index second = pairs ? width : 0;
        Integers countA{};
        Integers countB{};
        Floats sumA{};
        Floats sumB{};
        const Floats minus = Floats{} - std::numeric_limits<float>::infinity();
        const Floats floor = Floats{} + join.floor;
        const Floats lnK = Floats{} + join.lnK;
        for (; i + step <= n; i += step) {
            const Floats lambdaA = load(lambda + i);
            const Floats lambdaB = load(lambda + i + second);
            Floats statisticA = isFresh ? minus : load(statistic + i);
            Floats statisticB = isFresh ? minus : load(statistic + i + second);
            for (const Joined &t : targets) {
                Floats a;
                Floats b;
                if (t.general) {
                    a = bestOf(*t.general, i + sourceOffset);
                    b = pairs ? bestOf(*t.general, i + sourceOffset + second) : a;
                } else {
                    a = larger(larger(load(t.second + i), load(t.first + i)), load(t.third + i));
                    b = larger(larger(load(t.second + i + second), load(t.first + i + second)), load(t.third + i + second));
                }
                a = larger((a + t.weight) + lnK, floor);
                b = larger((b + t.weight) + lnK, floor);
                if constexpr (wantsSum) {
                    sumA += a;
                    sumB += b;
                }
                a += lambdaA;
                b += lambdaB;
                store(t.to + i, a);
                if constexpr (pairs)
                    store(t.to + i + second, b);
                countA -= a > lambdaA;
                countB -= b > lambdaB;
                statisticA = larger(a, statisticA);
                statisticB = larger(b, statisticB);
            }
            store(statistic + i, statisticA);
            if constexpr (pairs)
                store(statistic + i + second, statisticB);
        }
        for (Index lane = 0; lane < width; ++lane) {
            continued.count += countA[lane] + (pairs ? countB[lane] : 0);
            continued.sum += static_cast<double>(sumA[lane]) + (pairs ? static_cast<double>(sumB[lane]) : 0.0);
        }
        return i;
    }

    [[gnu::always_inline]] inline void finishOne(std::span<const TargetPlane> targets, Index i, Index sourceOffset, Index targetOffset,
                                                 const float *lambda, const FrameJoin &join, bool isFresh, float *statistic,
                                                 Continued &continued)
    {
        statistic[i] = isFresh ? -std::numeric_limits<float>::infinity() : statistic[i];
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

    template <bool wantsSum>
    [[gnu::always_inline]] inline void finishAll(std::span<const TargetPlane> targets, Index n, Index sourceOffset, Index targetOffset,
                                                 const float *lambda, const FrameJoin &join, bool isFresh, float *statistic,
                                                 Continued &continued)
    {
        Joined list[mostAtOnce];
        for (std::size_t k = 0; k < targets.size(); ++k)
            list[k] = joined(targets[k], sourceOffset, targetOffset);
        const std::span<const Joined> all(list, targets.size());
        Index i = finishVectors<true, wantsSum>(all, 0, n, sourceOffset, lambda, join, isFresh, statistic, continued);
        if (i + width <= n)
            i = finishVectors<false, wantsSum>(all, i, n, sourceOffset, lambda, join, isFresh, statistic, continued);
        for (; i < n; ++i)
            finishOne(targets, i, sourceOffset, targetOffset, lambda, join, isFresh, statistic, continued);
    }

} // namespace

FAINTLINE_MULTIVERSION
void joinMax(float *to, Index n, std::span<const ShiftedPlane<float>> sources)
{
    Index i = 0;
    if (!sources.empty())
        i = haveEqualWeights(sources) ? joinVectors<true>(to, n, sources) : joinVectors<false>(to, n, sources);
    for (; i < n; ++i) {
        float best = -std::numeric_limits<float>::infinity();
        for (const ShiftedPlane<float> &source : sources) {
            const float candidate = source.from[i] + source.weight;
            best = candidate > best ? candidate : best;
        }
        to[i] = best;
    }
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
    Index i = 0;
    for (; i + width <= n; i += width)
        store(to + i, larger(load(b + i), load(a + i)));
    for (; i < n; ++i)
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
    for (std::size_t first = 0; first < targets.size(); first += mostAtOnce) {
        const std::span<const TargetPlane> some = targets.subspan(first, std::min(mostAtOnce, targets.size() - first));
        const bool isFresh = join.isFresh && first == 0;
        if (join.wantsSum)
            finishAll<true>(some, n, sourceOffset, targetOffset, lambda, join, isFresh, statistic, continued);
        else
            finishAll<false>(some, n, sourceOffset, targetOffset, lambda, join, isFresh, statistic, continued);
    }
    return continued;
}

} // namespace faintline

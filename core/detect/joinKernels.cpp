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

    /// `joinMaxima` for floats: some cells stay in registers while the sources go by.
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

    /// Each target's second source is the next one's first, if that can be had: then it is loaded once for both.
    bool chain(std::span<Joined> targets)
    {
        for (std::size_t k = 0; k < targets.size(); ++k) {
            Joined &t = targets[k];
            if (t.general)
                return false;
            if (k + 1 < targets.size() && t.second == t.third && targets[k + 1].first == t.first)
                t.second = t.first;
            if (k > 0 && t.first != targets[k - 1].second)
                return false;
        }
        return true;
    }

    /// The maximum over any sources, their weights included.
    template <int bytes>
    [[gnu::always_inline]] inline Floats<bytes> bestOf(const TargetPlane &target, Index i)
    {
        Floats<bytes> best = Floats<bytes>{} - std::numeric_limits<float>::infinity();
        for (const ShiftedPlane<float> &source : target.sources)
            best = larger(load<bytes>(source.from + i) + source.weight, best);
        return best;
    }

    /// So many cells at a time through all targets: what belongs to the cells stays in registers, as arrays of a plain loop would not.
    template <int bytes, Index cells, Counting counting, bool chained>
    [[gnu::always_inline]] inline Index finishCells(std::span<const Joined> targets, Index i, Index n, Index sourceOffset,
                                                    const float *lambda, const FrameJoin &join, bool isFresh, float *statistic,
                                                    Continued &continued)
    {
        constexpr Index width = Vector<float, bytes>::lanes;
        constexpr Index parts = cells / width;
        Integers<bytes> count[parts]{};
        Floats<bytes> sum[parts]{};
        const Floats<bytes> minus = Floats<bytes>{} - std::numeric_limits<float>::infinity();
        const Floats<bytes> floor = Floats<bytes>{} + join.floor;
        const Floats<bytes> lnK = Floats<bytes>{} + join.lnK;
        for (; i + cells <= n; i += cells) {
            Floats<bytes> evidence[parts];
            Floats<bytes> best[parts];
            Floats<bytes> shared[parts];
#pragma GCC unroll 8
            for (Index part = 0; part < parts; ++part) {
                evidence[part] = load<bytes>(lambda + i + part * width);
                best[part] = isFresh ? minus : load<bytes>(statistic + i + part * width);
                if constexpr (chained)
                    shared[part] = load<bytes>(targets.front().first + i + part * width);
            }
            for (const Joined &t : targets)
#pragma GCC unroll 8
                for (Index part = 0; part < parts; ++part) {
                    const Index at = i + part * width;
                    Floats<bytes> score;
                    if constexpr (chained) {
                        const Floats<bytes> second = load<bytes>(t.second + at);
                        score = larger(larger(second, shared[part]), load<bytes>(t.third + at));
                        shared[part] = second;
                    } else if (t.general) {
                        score = bestOf<bytes>(*t.general, at + sourceOffset);
                    } else {
                        score = larger(larger(load<bytes>(t.second + at), load<bytes>(t.first + at)), load<bytes>(t.third + at));
                    }
                    score = larger((score + t.weight) + lnK, floor);
                    if constexpr (counting == Counting::StatesAndSum)
                        sum[part] += score;
                    score += evidence[part];
                    store(t.to + at, score);
                    if constexpr (counting != Counting::Nothing)
                        count[part] -= score > evidence[part];
                    best[part] = larger(score, best[part]);
                }
#pragma GCC unroll 8
            for (Index part = 0; part < parts; ++part)
                store(statistic + i + part * width, best[part]);
        }
        // The sum is rounded in the same order whatever the vectors' width: cells that are sixteen apart first.
        constexpr Index half = std::min<Index>(cells, 16);
        for (Index lane = 0; counting != Counting::Nothing && lane < half; ++lane) {
            double together = 0.0;
            for (Index cell = lane; cell < cells; cell += half) {
                continued.count += count[cell / width][cell % width];
                together += static_cast<double>(sum[cell / width][cell % width]);
            }
            continued.sum += together;
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
            continued.count += join.counting != Counting::Nothing && score > lambda[i] ? 1 : 0;
            continued.sum += join.counting == Counting::StatesAndSum ? static_cast<double>(kept) : 0.0;
            statistic[i] = score > statistic[i] ? score : statistic[i];
        }
    }

    template <int bytes, Counting counting>
    [[gnu::always_inline]] inline void finishAll(std::span<const TargetPlane> targets, Index n, Index sourceOffset, Index targetOffset,
                                                 const float *lambda, const FrameJoin &join, bool isFresh, float *statistic,
                                                 Continued &continued)
    {
        Joined list[mostAtOnce];
        for (std::size_t k = 0; k < targets.size(); ++k)
            list[k] = joined(targets[k], sourceOffset, targetOffset);
        const std::span<Joined> all(list, targets.size());
        Index i = 0;
        if (chain(all)) {
            i = finishCells<bytes, 32, counting, true>(all, i, n, sourceOffset, lambda, join, isFresh, statistic, continued);
            if (i + 16 <= n)
                i = finishCells<bytes, 16, counting, true>(all, i, n, sourceOffset, lambda, join, isFresh, statistic, continued);
        } else {
            i = finishCells<bytes, 32, counting, false>(all, i, n, sourceOffset, lambda, join, isFresh, statistic, continued);
            if (i + 16 <= n)
                i = finishCells<bytes, 16, counting, false>(all, i, n, sourceOffset, lambda, join, isFresh, statistic, continued);
        }
        for (; i < n; ++i)
            finishOne(targets, i, sourceOffset, targetOffset, lambda, join, isFresh, statistic, continued);
    }

} // namespace

void joinMax(float *to, Index n, std::span<const ShiftedPlane<float>> sources)
{
    withVectors([&](auto bytes) __attribute__((always_inline)) {
        Index i = 0;
        if (!sources.empty())
            i = haveEqualWeights(sources) ? joinVectors<bytes, true>(to, n, sources) : joinVectors<bytes, false>(to, n, sources);
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

Continued finishMax(std::span<const TargetPlane> targets, Index n, Index sourceOffset, Index targetOffset, const float *lambda,
                    const FrameJoin &join, float *statistic)
{
    Continued continued;
    for (std::size_t first = 0; first < targets.size(); first += mostAtOnce) {
        const std::span<const TargetPlane> some = targets.subspan(first, std::min(mostAtOnce, targets.size() - first));
        const bool isFresh = join.isFresh && first == 0;
        withVectors([&](auto bytes) __attribute__((always_inline)) {
            const auto finish = [&](auto counting) __attribute__((always_inline)) {
                finishAll<bytes, counting>(some, n, sourceOffset, targetOffset, lambda, join, isFresh, statistic, continued);
            };
            switch (join.counting) {
            case Counting::Nothing:
                return finish(std::integral_constant<Counting, Counting::Nothing>());
            case Counting::States:
                return finish(std::integral_constant<Counting, Counting::States>());
            case Counting::StatesAndSum:
                return finish(std::integral_constant<Counting, Counting::StatesAndSum>());
            }
        });
    }
    return continued;
}

} // namespace faintline

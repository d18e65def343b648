#include "detect/joinKernels.h"

#include "base/multiversion.h"

#include <algorithm>
#include <limits>

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi" // wide vectors never cross a call: all of their functions are inlined
#endif

namespace faintline {

namespace {

    constexpr Index lanes = 64;      ///< values kept in registers while all sources are joined to them
    constexpr Index lineFloats = 16; ///< of a cache line

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

    /// A target's sources as the inner loop wants them: of three, nearly always, the outer two weigh the same; of
    /// fewer, some count twice.
    struct Joined {
        const float *first;
        const float *second;
        const float *third;
        float outer; ///< ln P of the first and the third …
        float inner; ///< … and of the second, ln K included
        float *to;
        const TargetPlane *general; ///< where there are more, or none, or three weights
    };

    constexpr std::size_t mostAtOnce = 64; ///< targets

    [[gnu::always_inline]] inline Joined joined(const TargetPlane &target, Index sourceOffset, Index targetOffset,
                                                float lnK)
    {
        const std::span<const ShiftedPlane<float>> sources = target.sources;
        Joined result{nullptr, nullptr, nullptr, 0.0f, 0.0f, target.to + targetOffset, &target};
        if (sources.empty() || sources.size() > 3
            || (sources.size() == 3 && sources.front().weight != sources.back().weight))
            return result;
        const ShiftedPlane<float> &inner = sources[sources.size() / 2];
        result.first = sources.front().from + sourceOffset;
        result.second = inner.from + sourceOffset;
        result.third = sources.size() == 3 ? sources.back().from + sourceOffset : result.first;
        result.outer = sources.front().weight + lnK;
        result.inner = inner.weight + lnK;
        result.general = nullptr;
        return result;
    }

    /// How a frame's targets lie to each other; the more is known, the less the inner loop loads.
    enum class Layout {
        Any,
        Singles, ///< each has one source
        Threes,  ///< none is general
        Chained, ///< and each one's second source is the next one's first; all else as far apart from target to target
        Uniform, ///< and all sources weigh the same
    };

    /// Of two sources the edge's own comes second.
    Layout arrange(std::span<Joined> targets)
    {
        const auto isGeneral = [](const Joined &t) { return t.general != nullptr; };
        if (std::any_of(targets.begin(), targets.end(), isGeneral))
            return Layout::Any;
        if (std::all_of(targets.begin(), targets.end(), [](const Joined &t) { return t.first == t.second; }))
            return Layout::Singles;
        if (targets.size() < 3)
            return Layout::Threes;
        if (Joined &t = targets.front(); t.first == t.third && t.second != targets[1].first) {
            std::swap(t.first, t.second);
            std::swap(t.outer, t.inner);
            t.third = t.first;
        }
        const Joined &one = targets[0];
        const Joined &two = targets[1];
        bool isUniform = true;
        for (std::size_t k = 0; k < targets.size(); ++k) {
            const Joined &t = targets[k];
            const auto number = Index(k);
            const bool isLast = k + 1 == targets.size();
            if ((k > 0 && t.first != targets[k - 1].second)
                || t.second - one.second != number * (two.second - one.second)
                || t.to - one.to != number * (two.to - one.to)
                || (!isLast && t.third - t.second != one.third - one.second) || t.outer != one.outer
                || t.inner != one.inner)
                return Layout::Threes;
            isUniform = isUniform && t.outer == t.inner;
        }
        return isUniform ? Layout::Uniform : Layout::Chained;
    }

    /// The maximum over any sources, their weights and ln K included.
    template <int bytes>
    [[gnu::always_inline]] inline Floats<bytes> bestOf(const TargetPlane &target, Index i, float lnK)
    {
        Floats<bytes> best = Floats<bytes>{} - std::numeric_limits<float>::infinity();
        for (const ShiftedPlane<float> &source : target.sources)
            best = larger(load<bytes>(source.from + i) + (source.weight + lnK), best);
        return best;
    }

    /// So many cells at a time through all targets: what belongs to the cells stays in registers, as arrays of a plain
    /// loop would not.
    template <int bytes, Index cells, Counting counting, Layout layout>
    [[gnu::always_inline]] inline Index finishCells(std::span<const Joined> targets, Index i, Index n,
                                                    Index sourceOffset, const float *lambda, const FrameJoin &join,
                                                    bool isFresh, float *statistic, Continued &continued)
    {
        constexpr bool isChained = layout == Layout::Chained || layout == Layout::Uniform;
        constexpr Index width = Vector<float, bytes>::lanes;
        constexpr Index parts = cells / width;
        Integers<bytes> count[parts]{};
        Floats<bytes> sum[parts]{};
        const Floats<bytes> minus = Floats<bytes>{} - std::numeric_limits<float>::infinity();
        const Floats<bytes> floor = Floats<bytes>{} + join.floor;
        for (; i + cells <= n; i += cells) {
            for (const float *row : join.ahead)
                for (Index line = 0; line < cells; line += lineFloats)
                    __builtin_prefetch(row + i + line, 0, 2);
            Floats<bytes> evidence[parts];
            Floats<bytes> best[parts];
            Floats<bytes> shared[parts];
#pragma GCC unroll 8
            for (Index part = 0; part < parts; ++part) {
                evidence[part] = load<bytes>(lambda + i + part * width);
                best[part] = isFresh ? minus : load<bytes>(statistic + i + part * width);
                if constexpr (isChained)
                    shared[part] = load<bytes>(targets.front().first + i + part * width);
            }
            const auto finish = [&](Index part, const Floats<bytes> &m, float *to) __attribute__((always_inline))
            {
                Floats<bytes> score = larger(m, floor);
                if constexpr (counting == Counting::StatesAndSum)
                    sum[part] += score;
                score += evidence[part];
                store(to + part * width, score);
                if constexpr (counting != Counting::Nothing)
                    count[part] -= score > evidence[part];
                best[part] = larger(score, best[part]);
            };
            if constexpr (isChained) {
                const Joined &one = targets.front();
                const Index step = targets[1].second - one.second;
                const Index toStep = targets[1].to - one.to;
                const Index over = one.third - one.second;
                const Floats<bytes> outer = Floats<bytes>{} + one.outer;
                const Floats<bytes> inner = Floats<bytes>{} + one.inner;
                const float *from = one.second + i;
                float *to = one.to + i;
                const auto take = [&](const float *third) __attribute__((always_inline))
                {
#pragma GCC unroll 8
                    for (Index part = 0; part < parts; ++part) {
                        const Floats<bytes> second = load<bytes>(from + part * width);
                        const Floats<bytes> around = larger(load<bytes>(third + part * width), shared[part]);
                        finish(part,
                               layout == Layout::Uniform ? larger(second, around) + outer
                                                         : larger(second + inner, around + outer),
                               to);
                        shared[part] = second;
                    }
                };
                for (std::size_t k = 1; k < targets.size(); ++k, from += step, to += toStep)
                    take(from + over);
                take(targets.back().third + i);
            } else {
                for (const Joined &t : targets)
#pragma GCC unroll 8
                    for (Index part = 0; part < parts; ++part) {
                        const Index at = i + part * width;
                        if (layout == Layout::Any && t.general)
                            finish(part, bestOf<bytes>(*t.general, at + sourceOffset, join.lnK), t.to + i);
                        else if (layout == Layout::Singles)
                            finish(part, load<bytes>(t.second + at) + t.inner, t.to + i);
                        else
                            finish(part,
                                   larger(load<bytes>(t.second + at) + t.inner,
                                          larger(load<bytes>(t.third + at), load<bytes>(t.first + at)) + t.outer),
                                   t.to + i);
                    }
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
                together += double(sum[cell / width][cell % width]);
            }
            continued.sum += together;
        }
        return i;
    }

    [[gnu::always_inline]] inline void finishOne(std::span<const TargetPlane> targets, Index i, Index sourceOffset,
                                                 Index targetOffset, const float *lambda, const FrameJoin &join,
                                                 bool isFresh, float *statistic, Continued &continued)
    {
        statistic[i] = isFresh ? -std::numeric_limits<float>::infinity() : statistic[i];
        for (const TargetPlane &target : targets) {
            float best = -std::numeric_limits<float>::infinity();
            for (const ShiftedPlane<float> &source : target.sources) {
                const float candidate = source.from[i + sourceOffset] + (source.weight + join.lnK);
                best = candidate > best ? candidate : best;
            }
            const float kept = best > join.floor ? best : join.floor;
            const float score = lambda[i] + kept;
            target.to[targetOffset + i] = score;
            continued.count += join.counting != Counting::Nothing && score > lambda[i] ? 1 : 0;
            continued.sum += join.counting == Counting::StatesAndSum ? double(kept) : 0.0;
            statistic[i] = score > statistic[i] ? score : statistic[i];
        }
    }

    template <int bytes, Counting counting>
    [[gnu::always_inline]] inline void finishAll(std::span<const TargetPlane> targets, Index n, Index sourceOffset,
                                                 Index targetOffset, const float *lambda, const FrameJoin &join,
                                                 bool isFresh, float *statistic, Continued &continued)
    {
        Joined list[mostAtOnce];
        for (std::size_t k = 0; k < targets.size(); ++k)
            list[k] = joined(targets[k], sourceOffset, targetOffset, join.lnK);
        const std::span<Joined> all(list, targets.size());
        Index i = 0;
        const auto finish = [&](auto cells, auto layout) __attribute__((always_inline))
        {
            i = finishCells<bytes, cells, counting, layout>(all, i, n, sourceOffset, lambda, join, isFresh, statistic,
                                                            continued);
        };
        const auto withLayout = [&](auto layout) __attribute__((always_inline))
        {
            finish(std::integral_constant<Index, 32>(), layout);
            if (i + 16 <= n)
                finish(std::integral_constant<Index, 16>(), layout);
        };
        switch (arrange(all)) {
        case Layout::Any:
            withLayout(std::integral_constant<Layout, Layout::Any>());
            break;
        case Layout::Singles:
            withLayout(std::integral_constant<Layout, Layout::Singles>());
            break;
        case Layout::Threes:
            withLayout(std::integral_constant<Layout, Layout::Threes>());
            break;
        case Layout::Chained:
            withLayout(std::integral_constant<Layout, Layout::Chained>());
            break;
        case Layout::Uniform:
            withLayout(std::integral_constant<Layout, Layout::Uniform>());
            break;
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

Continued finishMax(std::span<const TargetPlane> targets, Index n, Index sourceOffset, Index targetOffset,
                    const float *lambda, const FrameJoin &join, float *statistic)
{
    Continued continued;
    for (std::size_t first = 0; first < targets.size(); first += mostAtOnce) {
        const std::span<const TargetPlane> some = targets.subspan(first, std::min(mostAtOnce, targets.size() - first));
        const bool isFresh = join.isFresh && first == 0;
        withVectors([&](auto bytes) __attribute__((always_inline)) {
            const auto finish = [&](auto counting) __attribute__((always_inline))
            {
                finishAll<bytes, counting>(some, n, sourceOffset, targetOffset, lambda, join, isFresh, statistic,
                                           continued);
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

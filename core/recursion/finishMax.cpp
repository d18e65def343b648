#include "recursion/finishMax.h"

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

    constexpr Index lineFloats = 16; ///< of a cache line

    /// A target's sources in the form of the inner loop: with three, the outer two nearly always have equal weights;
    /// with fewer, some are used twice.
    struct Joined {
        const float *first;
        const float *second;
        const float *third;
        float outer; ///< ln P of the first and the third …
        float inner; ///< … and of the second, ln K included
        float *to;
        const TargetPlane *general; ///< if there are more, none, or three different weights
    };

    constexpr std::size_t mostAtOnce = 64; ///< targets

    /// Data joined with all targets in some cells.
    struct FramePart {
        CellRun cells;
        const float *lambda;
        const FrameJoin &join;
        bool isFresh;
        float *statistic;
    };

    [[gnu::always_inline]] inline Joined joined(const TargetPlane &target, const CellRun &cells, float lnK)
    {
        const std::span<const ShiftedPlane<float>> sources = target.sources;
        Joined result{nullptr, nullptr, nullptr, 0.0f, 0.0f, target.to + cells.inTargets, &target};
        if (sources.empty() || sources.size() > 3
            || (sources.size() == 3 && sources.front().weight != sources.back().weight))
            return result;
        const ShiftedPlane<float> &inner = sources[sources.size() / 2];
        result.first = sources.front().from + cells.inSources;
        result.second = inner.from + cells.inSources;
        result.third = sources.size() == 3 ? sources.back().from + cells.inSources : result.first;
        result.outer = sources.front().weight + lnK;
        result.inner = inner.weight + lnK;
        result.general = nullptr;
        return result;
    }

    /// Layout of a frame's targets; the more is known, the fewer loads the inner loop needs.
    enum class Layout {
        Any,
        Singles, ///< each has one source
        Threes,  ///< none is general
        Chained, ///< and the second source of each is the first of the next, with constant distances otherwise
        Uniform, ///< and all sources have the same weight
    };

    /// With two sources the edge's own comes second.
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

    /// The maximum over any number of sources, including their weights and ln K.
    template <int bytes>
    [[gnu::always_inline]] inline Floats<bytes> bestOf(const TargetPlane &target, Index i, float lnK)
    {
        Floats<bytes> best = Floats<bytes>{} - std::numeric_limits<float>::infinity();
        for (const ShiftedPlane<float> &source : target.sources)
            best = larger(load<bytes>(source.from + i) + (source.weight + lnK), best);
        return best;
    }

    /// Processes `cells` cells at a time through all targets, so that their data stays in registers, as arrays of a
    /// plain loop would not.
    template <int bytes, Index cells, Counting counting, Layout layout>
    [[gnu::always_inline]] inline Index finishCells(std::span<const Joined> targets, Index i, const FramePart &frame,
                                                    Continued &continued)
    {
        const Index n = frame.cells.count;
        const Index sourceOffset = frame.cells.inSources;
        const FrameJoin &join = frame.join;
        const float *const lambda = frame.lambda;
        float *const statistic = frame.statistic;
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
                best[part] = frame.isFresh ? minus : load<bytes>(statistic + i + part * width);
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
        // The sum is rounded in the same order for any vector width: cells at a distance of sixteen first.
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

    /// Processes one cell of the run through all targets.
    [[gnu::always_inline]] inline void finishOne(std::span<const TargetPlane> targets, Index i, const FramePart &frame,
                                                 Continued &continued)
    {
        const FrameJoin &join = frame.join;
        const float lambda = frame.lambda[i];
        float largest = frame.isFresh ? -std::numeric_limits<float>::infinity() : frame.statistic[i];
        for (const TargetPlane &target : targets) {
            float best = -std::numeric_limits<float>::infinity();
            for (const ShiftedPlane<float> &source : target.sources) {
                const float candidate = source.from[i + frame.cells.inSources] + (source.weight + join.lnK);
                best = candidate > best ? candidate : best;
            }
            const float kept = best > join.floor ? best : join.floor;
            const float score = lambda + kept;
            target.to[frame.cells.inTargets + i] = score;
            continued.count += join.counting != Counting::Nothing && score > lambda ? 1 : 0;
            continued.sum += join.counting == Counting::StatesAndSum ? double(kept) : 0.0;
            largest = score > largest ? score : largest;
        }
        frame.statistic[i] = largest;
    }

    template <int bytes, Counting counting>
    [[gnu::always_inline]] inline void finishAll(std::span<const TargetPlane> targets, const FramePart &frame,
                                                 Continued &continued)
    {
        Joined list[mostAtOnce];
        for (std::size_t k = 0; k < targets.size(); ++k)
            list[k] = joined(targets[k], frame.cells, frame.join.lnK);
        const std::span<Joined> all(list, targets.size());
        Index i = 0;
        const auto finish = [&](auto cells, auto layout) __attribute__((always_inline))
        {
            i = finishCells<bytes, cells, counting, layout>(all, i, frame, continued);
        };
        const auto withLayout = [&](auto layout) __attribute__((always_inline))
        {
            finish(std::integral_constant<Index, 32>(), layout);
            if (i + 16 <= frame.cells.count)
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
        for (; i < frame.cells.count; ++i)
            finishOne(targets, i, frame, continued);
    }

} // namespace

Continued finishMax(std::span<const TargetPlane> targets, const CellRun &cells, const float *lambda,
                    const FrameJoin &join, float *statistic)
{
    Continued continued;
    for (std::size_t first = 0; first < targets.size(); first += mostAtOnce) {
        const std::span<const TargetPlane> some = targets.subspan(first, std::min(mostAtOnce, targets.size() - first));
        const FramePart frame{cells, lambda, join, join.isFresh && first == 0, statistic};
        withVectors([&](auto bytes) __attribute__((always_inline)) {
            const auto finish = [&](auto counting) __attribute__((always_inline))
            {
                finishAll<bytes, counting>(some, frame, continued);
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

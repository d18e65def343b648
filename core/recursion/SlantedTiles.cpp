#include "recursion/SlantedTiles.h"

#include "base/logmath.h"
#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

namespace faintline {

namespace {

    constexpr Index tileLimitCells = 4096; ///< cells: copies between tiles should be small compared with it …
    constexpr Index worthwhileTileCells = 512;
    constexpr Index cacheBytes = 7 << 16; ///< … and both windows should fit into the second-level cache
    constexpr Index cacheLineFloats = 16;
    constexpr Index tileVectorCells = 32;

} // namespace

/// Input of all threads.
struct SlantedTiles::Work : Passage {
    Index frameCount;
    bool isLast(Index frame) const { return frame + 1 == frameCount; }
};

/// Cells from … end-1 assigned to one thread; its input begins at low and ends at high.
struct SlantedTiles::ThreadShare {
    Index from;
    Index end;
    Index low;
    Index high;
    std::vector<Continued> continued{}; ///< in each frame, without sums
};

/// One frame's part of a tile: its cells begin at `begin`; those within the stretch are from … end-1.
struct SlantedTiles::TileFrame {
    Index frame;
    Index begin;
    Index from;
    Index end;
};

struct SlantedTiles::TargetList {
    std::vector<ShiftedPlane<float>> sources;
    std::vector<TargetPlane> targets;
};

SlantedTiles::SlantedTiles(Index cells, std::vector<Targets> phases)
    : m_cells(cells), m_phases(std::move(phases)), m_rates(std::ssize(m_phases.front()))
{
    for (const Targets &targets : m_phases)
        for (const std::vector<RateSource> &sources : targets)
            for (const RateSource &source : sources)
                m_reach = std::max(m_reach, std::abs(source.displacement));
    const Index fitting = cacheBytes / (2 * m_rates * Index(sizeof(float))) - 2 * m_reach;
    m_tileCells = std::min(tileLimitCells, fitting / tileVectorCells * tileVectorCells);
    // Targets are aligned to cache lines, and rates are not a power of two apart.
    m_margin = (2 * m_reach + tileVectorCells) / tileVectorCells * tileVectorCells;
    m_stride = m_margin + m_tileCells;
}

bool SlantedTiles::areWorthwhile() const
{
    return m_tileCells >= worthwhileTileCells;
}

std::vector<Continued> SlantedTiles::advance(const Passage &passage, const RunContext &context)
{
    const Work work{passage, std::ssize(passage.frames.y) / m_cells};
    const Index overlap = (work.frameCount - 1) * m_reach;
    std::vector<ThreadShare> stretches;
    for (Index i = 0; i < context.threads; ++i) {
        const Index from = i * m_cells / context.threads;
        const Index end = (i + 1) * m_cells / context.threads;
        stretches.push_back({from, end, std::max<Index>(0, from - overlap), std::min(m_cells, end + overlap),
                             std::vector<Continued>(std::size_t(work.frameCount))});
    }
    m_scratch.resize(std::max(m_scratch.size(), stretches.size()));
    parallelFor(std::ssize(stretches), context, "recursion", [&] {
        return [&](Index i) { goThrough(work, stretches[std::size_t(i)], m_scratch[std::size_t(i)]); };
    });
    std::vector<Continued> all(std::size_t(work.frameCount));
    for (const ThreadShare &stretch : stretches)
        for (std::size_t frame = 0; frame < all.size(); ++frame)
            all[frame].count += stretch.continued[frame].count;
    return all;
}

/// Sources start 2R cells before the targets' first cell, which is that of their own frame's tile, R cells later.
SlantedTiles::TargetList SlantedTiles::listTargets(const Targets &targets, const float *from, float *to,
                                                   Index toStride) const
{
    TargetList list;
    for (const std::vector<RateSource> &ofTarget : targets)
        for (const RateSource &source : ofTarget)
            list.sources.push_back({from + source.rate * m_stride - m_reach - source.displacement, source.weight});
    std::size_t begin = 0;
    for (Index rate = 0; rate < m_rates; ++rate) {
        const std::size_t count = targets[std::size_t(rate)].size();
        list.targets.push_back(
            {std::span<const ShiftedPlane<float>>(list.sources).subspan(begin, count), to + rate * toStride});
        begin += count;
    }
    return list;
}

/// Reads the scores as if a frame's tile began at `begin`.
void SlantedTiles::readScores(const Work &work, Index begin, float *window) const
{
    const Index first = begin - 2 * m_reach;
    const Index count = m_tileCells + 2 * m_reach;
    const Index from = std::clamp<Index>(-first, 0, count);
    const Index end = std::clamp<Index>(m_cells - first, from, count);
    for (Index rate = 0; rate < m_rates; ++rate) {
        float *const to = window + rate * m_stride - 2 * m_reach;
        std::fill(to, to + from, unreached);
        std::copy_n(work.scores.data() + rate * m_cells + first + from, end - from, to + from);
        std::fill(to + end, to + count, unreached);
    }
}

/// Lists the rows that the next frame reads and writes, and this frame's share of those at the borders of tiles.
void SlantedTiles::listAhead(const Work &work, Index frame, Index first, Index n,
                             std::vector<const float *> &rows) const
{
    rows.clear();
    const auto add = [&](std::span<const float> all, Index row, Index cell) {
        if (cell >= 0 && cell + n <= m_cells)
            rows.push_back(all.data() + row * m_cells + cell);
    };
    const bool isLast = work.isLast(frame);
    const Index following = isLast ? 0 : frame + 1;
    const Index there = isLast ? first + frame * m_reach + m_tileCells : first - m_reach;
    add(work.frames.y, following, there);
    add(work.frames.statistic, following, there);
    const Index frames = work.frameCount;
    for (Index rate = frame * m_rates / frames; rate < (frame + 1) * m_rates / frames; ++rate) {
        add(work.scores, rate, first + (frame + 1) * m_reach + m_tileCells);
        add(work.next, rate, first - (frames - 1 - frame) * m_reach);
    }
}

/// Start of the first window's cells, aligned to a cache line.
float *SlantedTiles::prepareWindows(Scratch &own, Index frames) const
{
    own.windows.resize(std::size_t(2 * m_rates * m_stride + cacheLineFloats));
    own.halo.assign(std::size_t(frames * m_rates * 2 * m_reach), unreached);
    own.lambda.resize(std::size_t(m_tileCells));
    own.unused.resize(std::size_t(m_tileCells));
    const auto address = Index(reinterpret_cast<std::uintptr_t>(own.windows.data()) / sizeof(float));
    return own.windows.data() + (cacheLineFloats - address % cacheLineFloats) % cacheLineFloats + m_margin;
}

void SlantedTiles::goThrough(const Work &work, ThreadShare &s, Scratch &own) const
{
    const Index haloSize = m_rates * 2 * m_reach;
    float *const windows = prepareWindows(own, work.frameCount);
    const auto windowOf = [&](Index frame) {
        return windows + (frame + 1) % 2 * m_rates * m_stride;
    }; // the scores are those of frame -1

    std::vector<TargetList> lists;
    for (Index frame = 0; frame < work.frameCount; ++frame) {
        const Targets &targets = m_phases[std::size_t((work.frames.firstStep + frame) % std::ssize(m_phases))];
        const bool isLast = work.isLast(frame);
        lists.push_back(listTargets(targets, windowOf(frame - 1), isLast ? work.next.data() : windowOf(frame),
                                    isLast ? m_cells : m_stride));
    }

    for (Index tile = s.low; tile - (work.frameCount - 1) * m_reach < s.high; tile += m_tileCells) {
        readScores(work, tile + m_reach, windowOf(-1));
        for (Index frame = 0; frame < work.frameCount; ++frame) {
            const Index begin = tile - frame * m_reach;
            const Index from = std::clamp(s.low, begin, begin + m_tileCells);
            const TileFrame part{frame, begin, from, std::clamp(s.high, from, begin + m_tileCells)};
            float *const window = windowOf(frame);
            float *const halo = own.halo.data() + frame * haloSize;
            if (!work.isLast(frame))
                fillOutside(part, halo, window);
            if (part.from < part.end)
                joinFrame(work, lists[std::size_t(frame)], part, s, own);
            for (Index rate = 0; !work.isLast(frame) && rate < m_rates; ++rate)
                std::copy_n(window + rate * m_stride + m_tileCells - 2 * m_reach, 2 * m_reach,
                            halo + rate * 2 * m_reach);
        }
    }
}

/// Fills the part of a frame's window that is not joined: the end of the previous tile, and cells outside the stretch.
void SlantedTiles::fillOutside(const TileFrame &part, const float *halo, float *window) const
{
    for (Index rate = 0; rate < m_rates; ++rate) {
        float *const to = window + rate * m_stride;
        std::copy_n(halo + rate * 2 * m_reach, 2 * m_reach, to - 2 * m_reach);
        std::fill(to, to + part.from - part.begin, unreached);
        std::fill(to + part.end - part.begin, to + m_tileCells, unreached);
    }
}

void SlantedTiles::joinFrame(const Work &work, const TargetList &list, const TileFrame &part, ThreadShare &s,
                             Scratch &own) const
{
    const auto [frame, begin, from, end] = part;
    const bool isLast = work.isLast(frame);
    FrameJoin join = work.join;
    join.isFresh = true;
    work.likelihood.apply(work.frames.y.subspan(std::size_t(frame * m_cells + from), std::size_t(end - from)),
                          own.lambda);
    // Cells outside the stretch are counted and output by the neighbour.
    const std::array<Index, 4> cuts{from, std::clamp(s.from, from, end), std::clamp(s.end, from, end), end};
    for (std::size_t third = 0; third < 3; ++third) {
        const Index first = cuts[third];
        const Index n = cuts[third + 1] - first;
        const bool isOwn = third == 1;
        if (n <= 0 || (isLast && !isOwn))
            continue;
        listAhead(work, frame, first, n, own.ahead);
        join.ahead = own.ahead;
        join.counting = isOwn ? work.join.counting : Counting::Nothing;
        float *const statistic = isOwn ? work.frames.statistic.data() + frame * m_cells + first : own.unused.data();
        s.continued[std::size_t(frame)].count +=
            finishMax(list.targets, {n, first - begin, isLast ? first : first - begin},
                      own.lambda.data() + (first - from), join, statistic)
                .count;
    }
    if (!work.frames.inhibited.empty())
        inhibit(work, list, part, s, own.lambda);
}

/// Leaves inhibited cells out of what continued in this part of a frame, and forgets them for the next one.
void SlantedTiles::inhibit(const Work &work, const TargetList &list, const TileFrame &part, ThreadShare &s,
                           std::span<const float> lambda) const
{
    const auto [frame, begin, from, end] = part;
    const bool isLast = work.isLast(frame);
    const std::vector<Index> &cells = work.frames.inhibited[std::size_t(frame)];
    for (auto at = std::ranges::lower_bound(cells, from); at != cells.end() && *at < end; ++at) {
        const bool isOwn = *at >= s.from && *at < s.end;
        if (isLast && !isOwn)
            continue;
        for (const TargetPlane &target : list.targets) {
            float &score = target.to[isLast ? *at : *at - begin];
            if (isOwn && score > lambda[std::size_t(*at - from)])
                --s.continued[std::size_t(frame)].count;
            if (!isLast)
                score = std::min(score, 0.0f);
        }
    }
}

} // namespace faintline

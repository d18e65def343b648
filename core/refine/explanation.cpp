#include "refine/explanation.h"

#include "frames/FrameStream.h"
#include "plan/chain.h"
#include "refine/constants.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace faintline {

Explanations::Explanations(Index cells, const std::function<double(double)> &bound,
                           const std::function<double(double)> &exact)
{
    const double farthest = std::min(leakageCells, double(cells));
    for (double distance = 0.0; distance <= farthest; distance += 1.0 / leakageEntriesPerCell) {
        m_bound.push_back(float(bound(distance)));
        m_exact.push_back(std::min(m_bound.back(), float(exact(distance))));
    }
}

/// Whether a signal is as narrow as the window allows, as far as is known.
bool Explanations::isSharp(const ExplainedSignal &signal, std::size_t at)
{
    const std::size_t before = at > 0 ? at - 1 : 0;
    const std::size_t after = std::min(at + 1, signal.positions.size() - 1);
    return !signal.skirts.empty()
           && std::abs(signal.positions[after] - signal.positions[before])
                  <= steadyCellsPerFrame * double(after - before);
}

std::span<const float> Explanations::skirtAt(const ExplainedSignal &signal, std::size_t at) const
{
    if (signal.skirts.empty())
        return {};
    return signal.skirts[std::min(at / std::size_t(ExplainedSignal::skirtFrames), signal.skirts.size() - 1)];
}

/// Distance, in cells, within which a signal's contribution is not negligible.
double Explanations::reachAt(const ExplainedSignal &signal, std::size_t at) const
{
    const double least = negligiblePowerRatio / (explainedPowerFactor * std::max(1e-3, double(signal.levels[at])));
    const auto end =
        std::partition_point(m_bound.begin(), m_bound.end(), [least](float share) { return double(share) > least; });
    return std::max(double(end - m_bound.begin()) / leakageEntriesPerCell, double(skirtAt(signal, at).size()));
}

void Explanations::add(ExplainedSignal signal)
{
    const auto last = std::size_t(signal.endFrame() / explainedBlockFrames); // including the frame after it
    if (m_byTime.size() <= last)
        m_byTime.resize(last + 1);
    for (auto i = std::size_t(std::max<Index>(0, signal.firstFrame - 1) / explainedBlockFrames); i <= last; ++i) {
        const Index begin = Index(i) * explainedBlockFrames - signal.firstFrame;
        const Index end = std::ssize(signal.positions) - 1;
        Entry entry{m_signals.size(), std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};
        for (Index at = std::clamp<Index>(begin, 0, end);
             at <= std::clamp<Index>(begin + explainedBlockFrames - 1, 0, end); ++at) {
            const auto number = std::size_t(at);
            const double reach = reachAt(signal, number);
            entry.lowest = std::min(entry.lowest, signal.positions[number] - reach);
            entry.highest = std::max(entry.highest, signal.positions[number] + reach);
        }
        m_byTime[i].push_back(entry);
    }
    m_signals.push_back(std::move(signal));
}

template <class Take>
void Explanations::forEachAt(Index frame, Index firstCell, Index count, Take take) const
{
    const auto number = std::size_t(frame / explainedBlockFrames);
    if (number >= m_byTime.size())
        return;
    for (const Entry &entry : m_byTime[number]) {
        const ExplainedSignal &signal = m_signals[entry.signal];
        const bool isBeside = entry.highest < double(firstCell) || entry.lowest > double(firstCell + count);
        if (!isBeside && frame >= signal.firstFrame - 1 && frame <= signal.endFrame())
            take(signal,
                 std::size_t(std::clamp<Index>(frame - signal.firstFrame, 0, std::ssize(signal.positions) - 1)));
    }
}

void Explanations::read(Index frame, Index firstCell, std::span<float> floor) const
{
    std::fill(floor.begin(), floor.end(), 1.0f);
    forEachAt(frame, firstCell, std::ssize(floor), [&](const ExplainedSignal &signal, std::size_t at) {
        const double position = signal.positions[at] - double(firstCell);
        const auto level = double(signal.levels[at]);
        const std::span<const float> skirt = skirtAt(signal, at);
        const double end = reachAt(signal, at);
        const std::vector<float> &leakage = isSharp(signal, at) ? m_exact : m_bound;
        const auto size = double(floor.size());
        const auto first = Index(std::clamp(std::floor(position - end), 0.0, size));
        const auto last = Index(std::clamp(std::ceil(position + end) + 1.0, 0.0, size));
        for (Index cell = first; cell < last; ++cell) {
            const double distance = std::abs(double(cell) - position);
            double share = double(leakage[std::min(std::size_t(distance * leakageEntriesPerCell), leakage.size() - 1)]);
            if (const auto step = std::size_t(std::lround(distance)); step < skirt.size())
                share = std::max(share, double(skirt[step]));
            floor[std::size_t(cell)] *= float(1.0 + explainedPowerFactor * level * share);
        }
    });
}

void Explanations::hide(Index frame, Index firstCell, std::span<float> y, float value) const
{
    forEachAt(frame, firstCell, std::ssize(y), [&](const ExplainedSignal &signal, std::size_t at) {
        const double position = signal.positions[at] - double(firstCell);
        const auto first = std::max<Index>(0, Index(std::ceil(position - signal.hides)));
        const auto last = std::min<Index>(std::ssize(y) - 1, Index(std::floor(position + signal.hides)));
        for (Index cell = first; cell <= last; ++cell)
            y[std::size_t(cell)] = value;
    });
}

std::vector<Explanations::RaisedStretch> Explanations::stretches() const
{
    std::vector<RaisedStretch> all;
    for (const ExplainedSignal &signal : m_signals)
        if (!signal.positions.empty())
            all.push_back({signal.firstFrame - 1, signal.endFrame(), std::ssize(signal.positions) + 2});
    std::ranges::sort(all, {}, &RaisedStretch::first);
    std::vector<RaisedStretch> joined;
    for (RaisedStretch next : all) {
        while (!joined.empty() && next.first - next.raised <= joined.back().last + joined.back().raised) {
            const RaisedStretch before = joined.back();
            joined.pop_back();
            const Index more = next.first > before.last ? next.raised : std::max<Index>(0, next.last - before.last);
            next = {before.first, std::max(before.last, next.last), before.raised + more};
        }
        joined.push_back(next);
    }
    for (RaisedStretch &stretch : joined) {
        stretch.first -= stretch.raised;
        stretch.last += stretch.raised;
    }
    return joined;
}

namespace {

    /// y at which λ has a value; λ increases with y.
    double powerOf(const Likelihood &likelihood, double lambda)
    {
        double low = 0.0;
        double high = 50.0;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (likelihood.at(middle) < lambda ? low : high) = middle;
        }
        return low;
    }

    /// Share of a track's points at which stronger signals raise the floor in its cell or up to `reach` beside it.
    double hiddenShare(const Track &track, const Explanations &explanations, Index reach)
    {
        std::vector<float> floor(std::size_t(2 * reach + 1));
        double hidden = 0.0;
        for (const TrackPoint &point : track.points) {
            explanations.read(point.frame, point.cell - reach, floor);
            hidden += *std::max_element(floor.begin(), floor.end()) >= float(raisedFloorRatio) ? 1.0 : 0.0;
        }
        return hidden / double(track.points.size());
    }

    /// Sends the frames of a stretch through a chain of its own.
    std::vector<Track> searchIn(const Explanations::RaisedStretch &stretch, const Analysis &analysis,
                                const Explanations &explanations, float hidden, const RunContext &context)
    {
        const NormalisedFrames &frames = *analysis.frames;
        const Index cells = frames.grid().size();
        const Index frameCount = frames.time().count;
        const Index phases = analysis.model.space.axes().front().phaseCount();
        std::unique_ptr<PathDetector> detector = makePathDetector(analysis);
        detector->useThreads(context.threads);
        const auto chain = makeChain(analysis, std::move(detector));
        std::vector<float> floor(static_cast<std::size_t>(cells));
        std::vector<float> statistic;
        FrameStream stream(frames, context.threads > 1, std::max<Index>(0, stretch.first) / phases * phases,
                           std::min(frameCount, stretch.last + 1));
        for (std::vector<float> block = stream.next(); !block.empty(); block = stream.next()) {
            const Index first = stream.position() - std::ssize(block) / cells;
            context.checkpoint(double(first) / double(frameCount), "searching behind strong signals");
            for (Index i = 0; i < std::ssize(block) / cells; ++i) {
                const std::span<float> y = std::span(block).subspan(std::size_t(i * cells), floor.size());
                explanations.read(first + i, 0, floor);
                for (std::size_t cell = 0; cell < floor.size(); ++cell)
                    y[cell] /= floor[cell];
                explanations.hide(first + i, 0, y, hidden);
            }
            statistic.resize(block.size());
            chain->updateAll(first, block, statistic);
        }
        chain->finish();
        return chain->takeJoinedTracks();
    }

} // namespace

std::vector<Track> searchBehind(const Analysis &analysis, const Explanations &explanations, const RunContext &context)
{
    const KinematicAxis &axis = analysis.model.space.axes().front();
    const auto hidden =
        float(powerOf(analysis.model.likelihood,
                      -(analysis.calibration->lnK + std::log(axis.rateChange.front())) - hidingNatsPerFrame));
    std::vector<Track> found;
    for (const Explanations::RaisedStretch &stretch : explanations.stretches())
        std::ranges::move(searchIn(stretch, analysis, explanations, hidden, context), std::back_inserter(found));
    const auto reach = Index(std::ceil(analysis.frames->geometry().binsPerCell));
    const double sure = analysis.sureStatistic();
    std::erase_if(found, [&](const Track &track) {
        return track.peakStatistic < sure || hiddenShare(track, explanations, reach) < hiddenPointsShare;
    });
    return found;
}

} // namespace faintline

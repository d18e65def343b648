#include "inspect/StateReplay.h"

#include <algorithm>
#include <limits>

namespace faintline {

StateReplay::StateReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget)
    : m_analysis(std::move(analysis)), m_replay(*m_analysis, byteBudget / 2),
      m_mostKept(std::max<std::size_t>(1, byteBudget / 2
                                              / (sizeof(float) * std::size_t(m_analysis->model.space.stateCount()))))
{
}

std::shared_ptr<const StateScores> StateReplay::at(Index frame, std::size_t model, const RunContext &context)
{
    frame = std::clamp<Index>(frame, 0, m_analysis->time().count - 1);
    const auto kept = std::find_if(m_kept.begin(), m_kept.end(),
                                   [&](const auto &one) { return one->frame == frame && one->model == model; });
    if (kept != m_kept.end())
        return *kept;
    m_replay.seek(frame);
    m_replay.stepTo(frame + 1, context, "replaying the recording", [&](Index now) {
        if (frame - now >= Index(m_mostKept))
            return;
        m_kept.push_back(std::make_shared<const StateScores>(scoresNow(*m_analysis, m_replay.chain(), now, model)));
        if (m_kept.size() > m_mostKept)
            m_kept.pop_front();
    });
    return m_kept.back();
}

StateScores scoresNow(const Analysis &analysis, const DetectionChain &chain, Index frame, std::size_t model)
{
    StateScores result;
    result.frame = frame;
    result.model = model;
    const std::span<const float> scores = chain.detector().scores(model);
    result.values.assign(scores.begin(), scores.end());
    if (const auto offset = float(chain.detector().offset(model)); offset != 0.0f)
        for (float &value : result.values)
            value += offset;
    if (const auto shift = float(analysis.offsetAt(model)); shift != 0.0f)
        for (float &value : result.values)
            value -= shift;
    for (const HmmTracker &tracker : chain.trackers())
        if (tracker.model() == model)
            tracker.paintStates(result.values);
    return result;
}

float shownScore(const Analysis &analysis, const DetectionChain &chain, std::size_t model, float score)
{
    return score + float(chain.detector().offset(model)) - float(analysis.offsetAt(model));
}

std::vector<Axis> stateAxes(const Analysis &analysis, std::size_t model)
{
    std::vector<Axis> axes = analysis.grid().axes;
    const std::vector<KinematicAxis> &kinematic = analysis.modelAt(model).space.axes();
    for (std::size_t i = 0; i < kinematic.size(); ++i) {
        const Axis &axis = analysis.grid().axes[i];
        const double rate = axis.step / analysis.time().step / kinematic[i].ratesPerCell;
        axes.push_back({axis.name + " rate", axis.unit + "/s", kinematic[i].firstRate * rate, rate,
                        kinematic[i].rateCount, false});
    }
    return axes;
}

std::vector<float> cutStates(const StateSpace &space, std::span<const float> scores, const StateSlice &slice)
{
    // Axes in memory order: rates first, then cells.
    const std::size_t count = space.axes().size();
    struct Along {
        Index size;
        Index stride;
        Index step; ///< in the picture
        std::optional<Index> place;
    };
    std::vector<Along> along(2 * count);
    std::vector<Index> sizes(2 * count); // by the number of the state's axis
    for (std::size_t i = 0; i < count; ++i) {
        sizes[i] = space.axes()[i].cells;
        sizes[count + i] = space.axes()[i].rateCount;
    }
    Index stride = 1;
    for (std::size_t memory = 2 * count; memory-- > 0;) {
        const std::size_t axis = memory < count ? memory + count : memory - count;
        const Index step = axis == slice.rows ? sizes[slice.columns] : axis == slice.columns ? 1 : 0;
        along[memory] = {sizes[axis], stride, step, step == 0 ? slice.places[axis] : std::nullopt};
        stride *= sizes[axis];
    }
    std::vector<float> picture(std::size_t(sizes[slice.rows] * sizes[slice.columns]),
                               -std::numeric_limits<float>::infinity());
    const auto descend = [&](auto &&self, std::size_t memory, Index state, Index pixel) -> void {
        if (memory == along.size()) {
            float &value = picture[std::size_t(pixel)];
            value = std::max(value, scores[std::size_t(state)]);
            return;
        }
        const Along &axis = along[memory];
        if (axis.place)
            return self(self, memory + 1, state + *axis.place * axis.stride, pixel);
        for (Index i = 0; i < axis.size; ++i)
            self(self, memory + 1, state + i * axis.stride, pixel + i * axis.step);
    };
    descend(descend, 0, 0, 0);
    return picture;
}

std::vector<Index> bestRates(const StateSpace &space, std::span<const float> scores, Index cell)
{
    Index best = 0;
    for (Index plane = 1; plane < space.planeCount(); ++plane)
        if (scores[std::size_t(plane * space.cellCount() + cell)]
            > scores[std::size_t(best * space.cellCount() + cell)])
            best = plane;
    const StateSpace::Coordinates coordinates = space.coordinates(best * space.cellCount() + cell);
    return {coordinates.rates.begin(), coordinates.rates.end()};
}

} // namespace faintline

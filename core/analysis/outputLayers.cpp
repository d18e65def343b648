#include "analysis/outputLayers.h"

#include "analysis/StateReplay.h"
#include "detect/Smd.h"

#include <algorithm>
#include <limits>

namespace faintline {

namespace {

    constexpr float unreached = -std::numeric_limits<float>::infinity();
    constexpr std::int32_t notKnown = 1 << 30; ///< an age: so many frames and those since it was said
    /// Of noise's paths, of which most are reset after a few frames, the oldest of many.
    constexpr Index ageOfSome = 512;

    /// Of a rate of one cell a frame along an axis.
    double rateUnit(const Analysis &analysis, std::size_t axis)
    {
        return analysis.grid().axes[axis].step / analysis.time().step;
    }

    /// In the axis's unit a second, by model and plane; along an axis that is not there 0.
    std::vector<std::vector<float>> ratesOfPlanes(const Analysis &analysis, std::size_t axis)
    {
        std::vector<std::vector<float>> rates(analysis.modelCount());
        for (std::size_t model = 0; model < rates.size(); ++model) {
            const StateSpace &space = analysis.modelAt(model).space;
            for (Index plane = 0; plane < space.planeCount(); ++plane)
                rates[model].push_back(axis < space.axes().size()
                                           ? float(space.ratesOfPlane(plane)[axis] * rateUnit(analysis, axis))
                                           : 0.0f);
        }
        return rates;
    }

} // namespace

LayerReplay::LayerReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget)
    : m_replay(std::move(analysis), byteBudget / 2), m_checkpoints(m_replay.interval(), byteBudget / 2)
{
    for (std::size_t model = 0; model < this->analysis()->modelCount(); ++model) {
        m_models.push_back(this->analysis()->modelAt(model));
        m_ages.states.emplace_back(std::size_t(m_models.back().space.stateCount()));
    }
    m_before.resize(m_models.size());
    const auto cells = std::size_t(m_models.front().space.cellCount());
    m_layers.statistic.resize(cells);
    m_layers.model.resize(cells);
    m_layers.plane.resize(cells);
    m_layers.age.resize(cells);
    m_layers.resetFraction.resize(cells);
    m_layers.isInhibited.resize(cells);
}

const CellLayers &LayerReplay::at(Index frame, const RunContext &context, const Cells &aged)
{
    frame = std::clamp<Index>(frame, 0, analysis()->time().count - 1);
    const Index lookback = aged.end - aged.begin > 1 ? ageOfSome : 0;
    const bool isOnItsWay = m_now >= 0 && m_now < frame && frame - m_now < lookback;
    if (frame != m_now)
        walk(isOnItsWay ? m_replay.next() : std::max<Index>(0, frame - lookback), frame, context);
    while (!knowsAges(aged))
        walk(std::max<Index>(0, frame - 2 * (frame + 1 - m_ages.since)), frame, context);
    return m_layers;
}

bool LayerReplay::knowsAges(const Cells &cells) const
{
    const auto begin = m_layers.age.begin() + std::min(cells.begin, std::ssize(m_layers.age));
    const auto end = m_layers.age.begin() + std::min(cells.end, std::ssize(m_layers.age));
    return m_ages.since == 0 || std::all_of(begin, end, [](std::int32_t age) { return age < notKnown; });
}

void LayerReplay::walk(Index begin, Index frame, const RunContext &context)
{
    seek(begin);
    const Index first = m_replay.next();
    while (m_replay.next() <= frame) {
        context.checkpoint(double(m_replay.next() - first) / double(frame + 1 - first), "following all paths");
        step();
    }
}

void LayerReplay::seek(Index frame)
{
    m_replay.seek(frame);
    if (m_replay.next() == m_now + 1)
        return;
    m_now = m_replay.next() - 1;
    if (const auto known = m_checkpoints.at(m_replay.next()))
        m_ages = *known;
    else
        forgetAges();
}

void LayerReplay::forgetAges()
{
    m_ages.since = m_replay.next();
    for (std::vector<std::int32_t> &states : m_ages.states)
        std::fill(states.begin(), states.end(), notKnown);
    m_ages.trackers.clear();
    for (const HmmTracker &tracker : m_replay.chain().trackers())
        for (const HmmTracker::Origin &origin : tracker.origins())
            m_ages.trackers[tracker.track().id][origin.state] = notKnown;
}

/// A model's scores as the next frame's step will find them, what it is about to forget forgotten.
std::vector<float> LayerReplay::scoresBefore(std::size_t model) const
{
    const PathDetector &detector = m_replay.chain().detector();
    std::vector<float> scores(detector.scores(model).begin(), detector.scores(model).end());
    const auto background = std::max(0.0f, float(-detector.offset(model)));
    const Index cells = analysis()->grid().size();
    for (const CellBox &box : m_replay.chain().forgotten())
        box.forEachCell(analysis()->grid(), [&](Index cell) {
            for (auto state = std::size_t(cell); state < scores.size(); state += std::size_t(cells))
                scores[state] = std::min(scores[state], background);
        });
    return scores;
}

void LayerReplay::step()
{
    const Index frame = m_replay.next();
    const bool isFirst = frame == 0;
    for (std::size_t model = 0; model < m_models.size() && !isFirst; ++model)
        m_before[model] = scoresBefore(model);
    const std::span<const float> statistic = m_replay.step();
    for (std::size_t model = 0; model < m_models.size(); ++model)
        if (isFirst)
            std::fill(m_ages.states[model].begin(), m_ages.states[model].end(), 0);
        else
            followPaths(model, frame);
    followTrackers();
    m_now = m_layers.frame = frame;
    project(statistic);
    if (m_replay.beginning() != m_beginning) {
        m_checkpoints.clear(); // as the replay's
        m_beginning = m_replay.beginning();
    }
    const Index next = m_replay.next();
    if (next % m_checkpoints.interval() != 0 || next == m_beginning)
        return;
    if (const auto known = m_checkpoints.at(next); !known || known->since > m_ages.since)
        m_checkpoints.keep(next, std::make_shared<const Ages>(m_ages), m_ages.bytes());
}

std::size_t LayerReplay::Ages::bytes() const
{
    constexpr std::size_t stateBytes =
        sizeof(TrackerAges::mapped_type::value_type) + 2 * sizeof(void *); // a node and its bucket
    std::size_t total = sizeof *this;
    for (const std::vector<std::int32_t> &ages : states)
        total += sizeof ages + ages.capacity() * sizeof(std::int32_t);
    for (const auto &[track, ages] : trackers)
        total += sizeof ages + 4 * sizeof(void *) + ages.size() * stateBytes;
    return total;
}

/// One axis's part of the step: of the ways into a state along it, the best, in the order that decides ties.
void LayerReplay::move(const MarkovModel &model, std::size_t axis, Index step, const Paths &from, Paths &to)
{
    const std::vector<KinematicAxis> &axes = model.space.axes();
    const KinematicAxis &own = axes[axis];
    Index inner = 1; // what lies side by side while the axis's own coordinates stay
    Index outerCells = 1;
    Index innerRates = 1;
    Index outerRates = 1;
    for (const KinematicAxis &other : axes) {
        if (&other == &own)
            continue;
        (&other < &own ? outerCells : inner) *= other.cells;
        (&other < &own ? outerRates : innerRates) *= other.rateCount;
    }
    to.scores.assign(from.scores.size(), unreached);
    to.ages.assign(from.ages.size(), 0);
    const Index cells = model.space.cellCount();
    const auto plane = [&](Index outer, Index rate, Index innermost) {
        return ((outer * own.rateCount + rate) * innerRates + innermost) * cells;
    };
    const auto take = [&](Index target, Index source, Index count, float ln) {
        const float *score = from.scores.data() + source;
        const std::int32_t *age = from.ages.data() + source;
        float *best = to.scores.data() + target;
        std::int32_t *its = to.ages.data() + target;
        for (Index i = 0; i < count; ++i) {
            const float other = score[i] + ln;
            const bool isBetter = other > best[i];
            its[i] = isBetter ? age[i] : its[i];
            best[i] = isBetter ? other : best[i];
        }
    };
    for (const KinematicAxis::Move &move : own.moves(step)) {
        const auto ln = float(move.lnProbability * model.transitionScale);
        const Index shift = move.cells;
        if (std::abs(shift) >= own.cells)
            continue;
        for (Index outerRate = 0; outerRate < outerRates; ++outerRate)
            for (Index innerRate = 0; innerRate < innerRates; ++innerRate)
                for (Index outer = 0; outer < outerCells; ++outer) {
                    const Index block = outer * own.cells * inner;
                    const Index target = plane(outerRate, move.toRate, innerRate) + block;
                    const Index source = plane(outerRate, move.fromRate, innerRate) + block;
                    take(target + std::max<Index>(shift, 0) * inner, source + std::max<Index>(-shift, 0) * inner,
                         (own.cells - std::abs(shift)) * inner, ln);
                    if (own.cyclic && shift > 0)
                        take(target, source + (own.cells - shift) * inner, shift * inner, ln);
                    if (own.cyclic && shift < 0)
                        take(target + (own.cells + shift) * inner, source, -shift * inner, ln);
                }
    }
}

void LayerReplay::followPaths(std::size_t model, Index frame)
{
    std::swap(m_paths.scores, m_before[model]);
    std::swap(m_paths.ages, m_ages.states[model]);
    for (std::size_t axis = m_models[model].space.axes().size();
         axis-- > 0;) { // the last one first: rates of the first decide ties
        move(m_models[model], axis, frame, m_paths, m_moved);
        std::swap(m_paths, m_moved);
    }
    const auto lnK = float(m_replay.chain().detector().regulation(model).stepLnK);
    for (std::size_t state = 0; state < m_paths.ages.size(); ++state)
        m_paths.ages[state] = m_paths.scores[state] + lnK > 0.0f ? m_paths.ages[state] + 1 : 0;
    std::swap(m_paths.ages, m_ages.states[model]);
}

void LayerReplay::followTrackers()
{
    TrackerAges now;
    for (const HmmTracker &tracker : m_replay.chain().trackers()) {
        const auto earlier = m_ages.trackers.find(tracker.track().id);
        const bool isNew = tracker.age() == 1 || earlier == m_ages.trackers.end();
        auto &ages = now[tracker.track().id];
        for (const auto &[state, before] : tracker.origins()) {
            if (isNew) {
                ages[state] = m_ages.states[tracker.track().model][std::size_t(state)];
                continue;
            }
            const auto from = earlier->second.find(before);
            ages[state] = 1 + (from == earlier->second.end() ? 0 : from->second);
        }
    }
    m_ages.trackers = std::move(now);
}

void LayerReplay::project(std::span<const float> statistic)
{
    const DetectionChain &chain = m_replay.chain();
    const auto cells = std::size_t(analysis()->grid().size());
    std::copy(statistic.begin(), statistic.end(), m_layers.statistic.begin());
    std::fill(m_layers.isInhibited.begin(), m_layers.isInhibited.end(), '\0');
    for (std::size_t cell = 0; cell < cells; ++cell)
        m_layers.model[cell] = static_cast<unsigned char>(chain.detector().winnerAt(Index(cell)));
    std::fill(m_layers.resetFraction.begin(), m_layers.resetFraction.end(), 0.0f);
    std::vector<float> best(cells, unreached);
    for (std::size_t model = 0; model < m_models.size(); ++model) {
        const std::span<const float> scores = chain.detector().scores(model);
        for (std::size_t plane = 0, state = 0; state < scores.size(); ++plane)
            for (std::size_t cell = 0; cell < cells; ++cell, ++state) {
                if (m_layers.model[cell] != model)
                    continue;
                const std::int32_t age = m_ages.states[model][state];
                m_layers.resetFraction[cell] += age == 0 ? 1.0f : 0.0f; // counted, so far
                if (plane == 0 || scores[state] > best[cell]) {
                    best[cell] = scores[state];
                    m_layers.plane[cell] = std::int32_t(plane);
                    m_layers.age[cell] = age;
                }
            }
    }
    for (std::size_t cell = 0; cell < cells; ++cell)
        m_layers.resetFraction[cell] /= float(m_models[m_layers.model[cell]].space.planeCount());
    std::unordered_map<std::size_t, double> followed; ///< the statistic where a tracker has a say
    for (const HmmTracker &tracker : chain.trackers())
        for (const auto &[state, age] : m_ages.trackers[tracker.track().id]) {
            const auto cell = std::size_t(state) % cells;
            const auto [shown, isFirst] = followed.try_emplace(cell);
            if (isFirst)
                shown->second = double(shownScore(*analysis(), chain, m_layers.model[cell], best[cell]));
            Index candidate = 0;
            if (const double score = tracker.scoreAt(Index(cell), &candidate);
                candidate == state && score > shown->second) {
                shown->second = score;
                m_layers.model[cell] = static_cast<unsigned char>(tracker.track().model);
                m_layers.plane[cell] = std::int32_t(std::size_t(state) / cells);
                m_layers.age[cell] = age;
                m_layers.resetFraction[cell] = 0.0f; // a tracker's paths are not reset
            }
        }
    for (const CellBox &box : chain.inhibited())
        box.forEachCell(analysis()->grid(), [&](Index cell) { m_layers.isInhibited[std::size_t(cell)] = 1; });
}

const std::vector<float> &LayerPicture::values(OutputLayer layer) const
{
    switch (layer) {
    case OutputLayer::Rate:
        return rate;
    case OutputLayer::SecondRate:
        return secondRate;
    case OutputLayer::Age:
        return age;
    case OutputLayer::Reset:
        return resetFraction;
    case OutputLayer::Inhibited:
        return inhibited;
    case OutputLayer::Statistic:
        break;
    }
    return statistic;
}

Index LayerPicture::pixelAt(Index row, Index column) const
{
    const Index r = row / perRow - firstRow;
    const Index c = column / perColumn - firstColumn;
    return row < 0 || column < 0 || r < 0 || r >= rows || c < 0 || c >= columns ? -1 : r * columns + c;
}

namespace {

    /// A picture of a window that grows cell by cell.
    class LayerPainter
    {
    public:
        LayerPainter(const Analysis &analysis, const LayerWindow &window, Index rows, Index columns)
            : m_rows(rows), m_columns(columns), m_frameSeconds(float(analysis.time().step)),
              m_rates(ratesOfPlanes(analysis, 0)), m_secondRates(ratesOfPlanes(analysis, 1))
        {
            const Index endRow = std::min(window.endRow, rows);
            const Index endColumn = std::min(window.endColumn, columns);
            const Index beginRow = std::clamp<Index>(window.beginRow, 0, endRow);
            const Index beginColumn = std::clamp<Index>(window.beginColumn, 0, endColumn);
            const auto per = [](Index length, Index most) {
                return std::max<Index>(1, (length + most - 1) / std::max<Index>(1, most));
            };
            const auto count = [](Index begin, Index end, Index by) {
                return end > begin ? (end - 1) / by - begin / by + 1 : 0;
            };
            picture.perRow = per(endRow - beginRow, window.mostRows);
            picture.perColumn = per(endColumn - beginColumn, window.mostColumns);
            picture.firstRow = beginRow / picture.perRow;
            picture.firstColumn = beginColumn / picture.perColumn;
            picture.rows = count(beginRow, endRow, picture.perRow);
            picture.columns = count(beginColumn, endColumn, picture.perColumn);
            const auto size = std::size_t(picture.rows * picture.columns);
            picture.statistic.assign(size, unreached);
            for (std::vector<float> *values :
                 {&picture.rate, &picture.secondRate, &picture.age, &picture.resetFraction, &picture.inhibited})
                values->assign(size, 0.0f);
        }

        Index firstRow() const { return picture.firstRow * picture.perRow; }
        Index endRow() const { return std::min((picture.firstRow + picture.rows) * picture.perRow, m_rows); }

        Index firstColumn() const { return picture.firstColumn * picture.perColumn; }
        Index endColumn() const
        {
            return std::min((picture.firstColumn + picture.columns) * picture.perColumn, m_columns);
        }

        /// One row of the window, whose first cell is `first` of the layers.
        void paintRow(Index row, const CellLayers &layers, Index first)
        {
            for (Index column = firstColumn(); column < endColumn(); ++column)
                paint(std::size_t(picture.pixelAt(row, column)), layers, std::size_t(first + column));
        }

        LayerPicture picture;

    private:
        void paint(std::size_t pixel, const CellLayers &layers, std::size_t cell)
        {
            if (layers.isInhibited[cell])
                picture.inhibited[pixel] = 1.0f;
            if (!(layers.statistic[cell] > picture.statistic[pixel]))
                return;
            const auto plane = std::size_t(layers.plane[cell]);
            picture.statistic[pixel] = layers.statistic[cell];
            picture.rate[pixel] = m_rates[layers.model[cell]][plane];
            picture.secondRate[pixel] = m_secondRates[layers.model[cell]][plane];
            picture.age[pixel] = float(layers.age[cell]) * m_frameSeconds;
            picture.resetFraction[pixel] = layers.resetFraction[cell];
        }

        Index m_rows;
        Index m_columns;
        float m_frameSeconds;
        std::vector<std::vector<float>> m_rates;
        std::vector<std::vector<float>> m_secondRates;
    };

} // namespace

LayerPicture layerPicture(LayerReplay &replay, const LayerWindow &window, const RunContext &context)
{
    const Analysis &analysis = *replay.analysis();
    LayerPainter painter(analysis, window, analysis.time().count, analysis.grid().size());
    const Index first = painter.firstRow();
    const Index end = painter.endRow();
    for (Index frame = first; frame < end; ++frame) {
        const double done = double(frame - first) / double(end - first);
        context.checkpoint(done, "layers");
        painter.paintRow(frame,
                         replay.at(frame, context.part(done, done), {painter.firstColumn(), painter.endColumn()}), 0);
    }
    return std::move(painter.picture);
}

LayerPicture layerPictureOf(LayerReplay &replay, Index ping, const LayerWindow &window, const RunContext &context)
{
    const Analysis &analysis = *replay.analysis();
    const Index columns = analysis.grid().axes[1].count;
    LayerPainter painter(analysis, window, analysis.grid().axes[0].count, columns);
    const CellLayers &layers = replay.at(ping, context);
    for (Index row = painter.firstRow(); row < painter.endRow(); ++row)
        painter.paintRow(row, layers, row * columns);
    return std::move(painter.picture);
}

double largestRate(const Analysis &analysis, std::size_t axis)
{
    double cellsPerFrame = 0.0;
    for (std::size_t model = 0; model < analysis.modelCount(); ++model) {
        const KinematicAxis &own = analysis.modelAt(model).space.axes()[axis];
        cellsPerFrame = std::max({cellsPerFrame, std::abs(own.rate(0)), std::abs(own.rate(own.rateCount - 1))});
    }
    return (cellsPerFrame > 0.0 ? cellsPerFrame : 1.0) * rateUnit(analysis, axis);
}

CellReading readCell(const Analysis &analysis, const CellLayers &layers, Index cell)
{
    const auto i = std::size_t(cell);
    const std::vector<double> rates = analysis.modelAt(layers.model[i]).space.ratesOfPlane(layers.plane[i]);
    return {rates[0] * rateUnit(analysis, 0), rates.size() > 1 ? rates[1] * rateUnit(analysis, 1) : 0.0,
            double(layers.age[i]) * analysis.time().step, layers.isInhibited[i] != 0, double(layers.statistic[i])};
}

CellReading readPixel(const LayerPicture &picture, Index pixel)
{
    const auto i = std::size_t(pixel);
    return {double(picture.rate[i]), double(picture.secondRate[i]), double(picture.age[i]), picture.inhibited[i] > 0.0f,
            double(picture.statistic[i])};
}

} // namespace faintline

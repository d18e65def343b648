#include "app/features/inspect/StateCut.h"

#include "app/base/tr.h"
#include "app/document/FrameKind.h"
#include "frames/pictureCuts.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"

#include <QCoreApplication>
#include <QStringList>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// A single rate by the word for its kind; drifts in a suitable unit.
    std::vector<Axis> readableAxes(const Analysis &analysis, std::size_t model)
    {
        std::vector<Axis> axes = stateAxes(analysis, model);
        if (!analysis.grid().isSpectrum())
            return axes;
        Axis &rate = axes.back();
        rate.name = lineFrames().rateName(analysis.grid().axes.front()).toStdString();
        if (rate.unit != "Hz/s")
            return axes;
        const FrequencyUnit unit = rateUnit(std::max(std::abs(rate.first), std::abs(rate.last())));
        rate.unit = unit.name.toStdString();
        rate.first /= unit.hz;
        rate.step /= unit.hz;
        return axes;
    }

    /// The cell of a place and its best rates, one index per axis of the states.
    std::vector<Index> bestState(const FramePlace &place, const std::vector<Axis> &axes, const StateSpace &space,
                                 const Grid &grid, std::span<const float> scores)
    {
        std::vector<Index> state;
        for (std::size_t i = 0; i < place.position.size(); ++i)
            state.push_back(axes[i].nearest(place.position[i]));
        const std::vector<Index> rates = bestRates(space, scores, grid.cell(state));
        state.insert(state.end(), rates.begin(), rates.end());
        return state;
    }

} // namespace

double StateCut::scoreAtCursor() const
{
    return score(rows().nearest(values[slice.rows]), columns().nearest(values[slice.columns]));
}

std::optional<SliceMarks::Best> StateCut::bestIn(const Viewport::Box &visible) const
{
    std::optional<SliceMarks::Best> result;
    for (Index row = 0; row < rows().count; ++row)
        for (Index column = 0; column < columns().count; ++column) {
            const SliceMarks::Best here{rows().value(double(row)), columns().value(double(column)), score(row, column)};
            if ((!result || here.score > result->score) && visible.time.contains(here.row)
                && visible.frequency.contains(here.column))
                result = here;
        }
    return result;
}

std::vector<Viewport::Point> StateCut::pathsOf(const std::vector<Track> &tracks, const Analysis &analysis) const
{
    std::vector<Viewport::Point> result;
    const StateSpace &space = analysis.modelAt(model).space;
    for (const Track &track : tracks) {
        const Index i = frame - (track.points.empty() ? 0 : track.points.front().frame);
        if (i < 0 || i >= std::ssize(track.points))
            continue;
        const TrackPoint &point = track.points[std::size_t(i)];
        if (modelAt(point.frame, track.model, track.modelChanges) != model)
            continue;
        std::vector<Index> state = analysis.grid().coordinates(point.cell);
        const StateSpace::Coordinates coordinates = space.coordinates(point.plane * space.cellCount() + point.cell);
        state.insert(state.end(), coordinates.rates.begin(), coordinates.rates.end());
        bool isInSlice = true;
        for (std::size_t axis = 0; axis < state.size(); ++axis)
            if (axis != slice.rows && axis != slice.columns && slice.places[axis])
                isInSlice = isInSlice && *slice.places[axis] == state[axis];
        if (isInSlice)
            result.push_back({rows().value(double(state[slice.rows])), columns().value(double(state[slice.columns]))});
    }
    return result;
}

QString StateCut::otherWords() const
{
    QStringList others;
    for (std::size_t i = 0; i < slice.places.size(); ++i)
        if (i != slice.rows && i != slice.columns)
            others << (slice.places[i] ? tr("%1 %2 %3")
                                             .arg(labelText(axes[i].name, mostUnitLetters),
                                                  numberText(values[i], decimalsFor(axes[i].step)),
                                                  labelText(axes[i].unit, mostUnitLetters))
                                       : tr("best %1").arg(labelText(axes[i].name, mostUnitLetters)));
    return others.join(QStringLiteral(", "));
}

QString StateCut::bestWords(const SliceMarks &marks) const
{
    const Axis &slope = axes.back();
    const auto stateWords = [&](double hz, double rate) {
        const QString unit = labelText(slope.unit, mostUnitLetters);
        return tr("%1, %2 %3").arg(hertzText(hz, axes.front().step), numberText(rate, decimalsFor(slope.step)), unit);
    };
    QString words =
        tr("at the cursor %1 nat (%2)").arg(numberText(scoreAtCursor(), 1), stateWords(values.front(), values.back()));
    if (const auto seen = marks.best())
        words +=
            tr("; best in view ○ %1 nat (%2)").arg(numberText(seen->score, 1), stateWords(seen->column, seen->row));
    if (!marks.paths().empty())
        words += tr("; ◇ a track's state");
    return words;
}

StateCut cutThrough(StateReplay &replay, const StateCut::Wanted &wanted, const RunContext &context)
{
    const Analysis &analysis = *replay.analysis();
    const auto states = replay.at(analysis.time().nearest(wanted.place.seconds), wanted.model, context);
    if (states->values.empty())
        throw Error("state space", "this detector has no states; choose the sequential Markov detector");
    const StateSpace &space = analysis.modelAt(wanted.model).space;
    StateCut cut;
    cut.slice = wanted.slice;
    cut.axes = readableAxes(analysis, wanted.model);
    cut.model = wanted.model;
    cut.frame = states->frame;
    const std::vector<Index> state = bestState(wanted.place, cut.axes, space, analysis.grid(), states->values);
    for (std::size_t i = 0; i < state.size(); ++i) {
        cut.values.push_back(cut.axes[i].value(double(state[i])));
        cut.slice.places.push_back(wanted.isMaximised ? std::nullopt : std::optional(state[i]));
    }
    cut.scores = cutStates(space, states->values, cut.slice);
    cut.best = double(*std::max_element(cut.scores.begin(), cut.scores.end()));
    cut.picture = pictureOf(cut.rows(), cut.columns(), cut.scores, ByteScale(ByteScale::Kind::ScoreNats));
    return cut;
}

} // namespace faintline

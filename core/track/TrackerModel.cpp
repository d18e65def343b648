#include "track/TrackerModel.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    std::vector<Index> halfWidths(const StateSpace &space, const TrackSettings &settings)
    {
        std::vector<Index> result;
        for (std::size_t axis = 0; axis < space.axes().size(); ++axis) {
            const double wanted = settings.windowCells.empty()
                                      ? 12.0
                                      : settings.windowCells[std::min(axis, settings.windowCells.size() - 1)];
            const Index largest = (space.axes()[axis].cells - 1) / 2;
            result.push_back(std::clamp(Index(std::llround(wanted)), Index(0), largest));
        }
        return result;
    }

    std::vector<Index> reaches(const StateSpace &space)
    {
        std::vector<Index> result;
        for (const KinematicAxis &axis : space.axes())
            result.push_back(axis.largestDisplacement());
        return result;
    }

    std::vector<Index> sides(const std::vector<Index> &half, const std::vector<Index> &margin)
    {
        std::vector<Index> result;
        for (std::size_t i = 0; i < half.size(); ++i)
            result.push_back(2 * (half[i] + margin[i]) + 1);
        return result;
    }

    /// Offsets of a box's cells from its middle, cell by cell, one per axis.
    std::vector<Index> offsetsFromMiddle(const StateSpace &box)
    {
        std::vector<Index> result;
        for (Index cell = 0; cell < box.cellCount(); ++cell) {
            const std::vector<Index> c = box.coordinates(cell).cells;
            for (std::size_t axis = 0; axis < c.size(); ++axis)
                result.push_back(c[axis] - (box.axes()[axis].cells - 1) / 2);
        }
        return result;
    }

} // namespace

const std::vector<Field<TrackSettings>> &TrackSettings::fields()
{
    using S = TrackSettings;
    static const std::vector<Field<S>> table{
        field(&S::windowCells, "windowCells", "bins", 0.0, 10000.0,
              "Half width of the window of states that follows a signal, per axis; the last number repeats.")
            .labelled("Window half width")
            .advanced()
            .advised("Widen it for signals that turn quickly. The time per track is proportional to it, and a track "
                     "changes to a neighbouring signal more easily."),
        field(&S::decayNats, "decayNats", "nat", 0.0, 1000.0,
              "Amount subtracted from a track's level every frame, so "
              "that a track on noise fades.")
            .labelled("Decay per frame")
            .advanced()
            .advised("Raise it to end tracks sooner after their signal; lower it to bridge longer pauses."),
        field(&S::ceilingNats, "ceilingNats", "nat", 0.0, 1e6, "Upper limit of a track's level above the threshold.")
            .labelled("Ceiling")
            .advanced()
            .advised("Lower it to end the tracks of strong signals sooner; raise it to let strong signals bridge "
                     "longer pauses."),
        field(&S::endNats, "endNats", "nat", 0.0, 1e6, "A track ends when its level is this far below the threshold.")
            .labelled("End below")
            .advised("Raise it to bridge longer pauses. A track then continues longer in the noise after its signal."),
        field(&S::confirmNats, "confirmNats", "nat", 0.0, 1e6,
              "A track is confirmed when its level is this far above the threshold.")
            .labelled("Confirm above")
            .advised("Raise it to have fewer confirmed tracks on noise. Weak signals are confirmed later or never."),
        field(&S::confirmFrames, "confirmFrames", "frames", 1.0, 1e6, "Lowest age at which a track is confirmed.")
            .labelled("Confirm after")
            .advised("Raise it to have fewer confirmed tracks of short bursts. Every signal is confirmed later."),
        field(&S::smoothingFrames, "smoothingFrames", "frames", 1.0, 10000.0, "Lag of the smoothing of a track's path.")
            .labelled("Smoothing lag")
            .advanced()
            .advised("Raise it for a smoother path. The path is known this many frames later; time and memory per "
                     "track are proportional to it."),
        field(&S::bothWays, "bothWays",
              "Whether complete tracks of lines are also followed backward to refine onset, "
              "end and frequency.")
            .labelled("Both ways")
            .advanced()
            .advised("Switch it off to keep the tracks of the causal chain, as in the published papers, and to save "
                     "the time of the second pass. Events are detected in the same frames. Source: docs/theory.md."),
    };
    return table;
}

TrackerModel::TrackerModel(const MarkovModel &model, const Grid &frameGrid, const TrackSettings &trackSettings,
                           double thresholdNats)
    : space(model.space), grid(frameGrid), settings(trackSettings), threshold(thresholdNats),
      transitionScale(model.transitionScale), halfWidth(halfWidths(space, settings)), reach(reaches(space)),
      window(space.window(sides(halfWidth, std::vector<Index>(halfWidth.size(), 0)))),
      padded(space.window(sides(halfWidth, reach))), recursion(padded, model.transitionScale),
      scores(std::size_t(padded.stateCount()))
{
    for (std::size_t axis = 0; axis < halfWidth.size(); ++axis)
        largestExtent = std::max(largestExtent, 2 * (halfWidth[axis] + reach[axis]));
    windowOffsets = offsetsFromMiddle(window);
    paddedOffsets = offsetsFromMiddle(padded);
}

Index TrackerModel::gridCell(const std::vector<Index> &centre, const std::vector<Index> &offsets, Index cell) const
{
    const std::size_t axisCount = centre.size();
    const Index *offset = offsets.data() + std::size_t(cell) * axisCount;
    Index flat = 0;
    for (std::size_t axis = 0; axis < axisCount; ++axis) {
        const Index inside = grid.axes[axis].wrapped(centre[axis] + offset[axis]);
        if (inside < 0)
            return -1;
        flat = flat * grid.axes[axis].count + inside;
    }
    return flat;
}

Index TrackerModel::inPadded(Index cell, const std::vector<Index> &moved) const
{
    const std::size_t axisCount = moved.size();
    const Index *offset = windowOffsets.data() + std::size_t(cell) * axisCount;
    Index flat = 0;
    for (std::size_t axis = 0; axis < axisCount; ++axis) {
        const Index cells = padded.axes()[axis].cells;
        const Index inside = offset[axis] + moved[axis] + halfWidth[axis] + reach[axis];
        if (inside < 0 || inside >= cells)
            return -1;
        flat = flat * cells + inside;
    }
    return flat;
}

} // namespace faintline

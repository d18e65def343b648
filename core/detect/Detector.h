#pragma once

#include "base/Grid.h"
#include "model/StateSpace.h"

#include <memory>
#include <span>
#include <vector>

namespace faintline {

/// A box of cells on a grid: centre ± halfWidth along every axis, wrapped on cyclic axes, cut off on bounded ones.
struct CellBox {
    std::vector<Index> centre;
    std::vector<Index> halfWidth;

    bool contains(const Grid &grid, const std::vector<Index> &coordinates) const;

    /// Calls visit(flat cell index) for every cell of the box.
    template <class Visit>
    void forEachCell(const Grid &grid, Visit visit) const;
};

/// Something that turns frames into a statistic, one frame after the other.
///
/// A frame is one y per cell (noise mean 1); the statistic is one value per cell, larger where a signal is likelier.
/// A detector has state; one object per thread.
class Detector
{
public:
    virtual ~Detector() = default;

    /// Takes one frame of cellCount values; writes the statistic D of every cell, -∞ where this frame decides nothing.
    virtual void update(std::span<const float> y, std::span<float> statistic) = 0;

    /// Takes several frames, one after the other in `y`: the same bytes as one at a time, faster where a detector can look ahead.
    virtual void updateBlock(std::span<const float> y, std::span<float> statistic, Index cells);

    /// How many threads one update may use; changes no byte.
    virtual void useThreads(int /*threads*/) {}

    /// Forgets the evidence of the past in a box of cells, as if only noise had been there.
    virtual void forget(const Grid &grid, const CellBox &box) = 0;

    /// Names the cells, ascending, that a tracker looks after: until the next call their states do not count in the regulation.
    virtual void inhibit(std::span<const Index> /*cells*/) {}

    /// The scores of all states after the last frame (StateSpace order), empty for detectors without states.
    virtual std::span<const float> scores() const { return {}; }

    /// Whether the statistic is the score of one path, which can be traced (tracePath) and followed on.
    virtual bool hasPaths() const { return false; }

    /// What the detector's regulation did in the last frame.
    struct Regulation {
        double lnK = 0.0;               ///< what the law gave for the last frame
        double continuedFraction = 0.0; ///< of the states, those whose path went on rather than being reset
        double stepLnK = 0.0;           ///< what was added on the way into the last frame (under Mean, the ln K of the frame before)
    };
    virtual Regulation regulation() const { return {}; }

    /// All that the next frame depends on; recalling it resumes bit for bit. Null: the detector cannot tell.
    struct Remembrance {
        virtual ~Remembrance() = default;
        virtual std::size_t bytes() const = 0; ///< that it takes
    };
    virtual std::shared_ptr<const Remembrance> remembrance() const { return {}; }
    /// One of this detector's, or of another one made alike.
    virtual void recall(const Remembrance & /*remembrance*/) {}

    /// A bank of models is made of detectors; any other detector is its own only member.
    virtual std::size_t memberCount() const { return 1; }
    virtual const Detector &member(std::size_t /*number*/) const { return *this; }
    /// The member whose statistic a cell shows after the last frame.
    virtual std::size_t winnerAt(Index /*cell*/) const { return 0; }
};

template <class Visit>
void CellBox::forEachCell(const Grid &grid, Visit visit) const
{
    const auto descend = [&](auto &&self, std::size_t axis, Index flat) -> void {
        if (axis == grid.axes.size()) {
            visit(flat);
            return;
        }
        const Axis &a = grid.axes[axis];
        const bool whole = a.cyclic && 2 * halfWidth[axis] + 1 >= a.count;
        const Index from = whole ? 0 : centre[axis] - halfWidth[axis];
        const Index to = whole ? a.count - 1 : centre[axis] + halfWidth[axis];
        for (Index i = from; i <= to; ++i)
            if (const Index inside = a.wrapped(i); inside >= 0)
                self(self, axis + 1, flat * a.count + inside);
    };
    descend(descend, 0, 0);
}

} // namespace faintline

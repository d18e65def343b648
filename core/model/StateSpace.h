#pragma once

#include "model/KinematicAxis.h"

#include <vector>

namespace faintline {

/// The product of kinematic axes: each combination of one rate and one cell per axis is a state.
///
/// Memory order: (rate of axis 1, …, rate of axis A, cell of axis 1, …, cell of axis A), the last index contiguous. The
/// states of one rate combination form a *plane* of cellCount() values in the layout of a frame.
class StateSpace
{
public:
    StateSpace() = default;
    /// Throws Error if an axis is invalid.
    explicit StateSpace(std::vector<KinematicAxis> axes);

    const std::vector<KinematicAxis> &axes() const { return m_axes; }
    Index cellCount() const { return m_cellCount; }   ///< cells of a frame
    Index planeCount() const { return m_planeCount; } ///< rate combinations
    Index stateCount() const { return m_cellCount * m_planeCount; }

    /// Coordinates of a state.
    struct Coordinates {
        std::vector<int> rates; ///< rate indices, 0 … rateCount-1
        std::vector<Index> cells;
    };
    Coordinates coordinates(Index state) const;
    Index state(const Coordinates &coordinates) const;

    Index planeOf(Index state) const { return state / m_cellCount; }
    Index cellOf(Index state) const { return state % m_cellCount; }

    /// Rates of one plane's states, in cells per step, one per axis.
    std::vector<double> ratesOfPlane(Index plane) const;

    /// Number of steps after which the moves of all axes repeat: the least common multiple of theirs.
    Index phaseCount() const;

    struct Predecessor {
        Index state;
        double lnProbability;
    };
    /// The states that can move into `state` in step number `step`, lowest rate first, then lowest cell; ties are
    /// decided in this order.
    std::vector<Predecessor> predecessors(Index state, Index step = 0) const;

    /// The same axes over a box of cells, none of them cyclic: the state space of a tracker's window.
    StateSpace window(const std::vector<Index> &cells) const;

private:
    std::vector<KinematicAxis> m_axes;
    std::vector<std::vector<std::vector<KinematicAxis::Move>>> m_moves; ///< for each axis and phase
    Index m_cellCount = 0;
    Index m_planeCount = 0;
};

} // namespace faintline

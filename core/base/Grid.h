#pragma once

#include "base/Axis.h"

#include <vector>

namespace faintline {

/// The product of axes a frame lies on, slowest axis first, the last one contiguous in memory.
///
/// A spectrogram frame lies on one axis (frequency), a sonar ping on two (range, bearing), a radar scan on four.
struct Grid {
    std::vector<Axis> axes;

    Index size() const;

    /// Whether a frame is a spectrum, its cells on one axis; if not, it is a ping or a scan, on several.
    bool isSpectrum() const { return axes.size() == 1; }

    /// Distance in memory between neighbours along one axis.
    Index stride(std::size_t axis) const;

    /// Coordinates of a flat cell index, one per axis.
    std::vector<Index> coordinates(Index cell) const;

    /// Where a cell lies, in the units of the axes.
    std::vector<double> position(Index cell) const;

    /// Flat index of coordinates, or -1 where one of them lies off a bounded axis.
    Index cell(const std::vector<Index> &coordinates) const;

    bool operator==(const Grid &) const = default;
};

} // namespace faintline

#pragma once

#include "base/Axis.h"

#include <string>
#include <vector>

namespace faintline {

/// The product of axes on which a frame lies: slowest axis first, the last one contiguous in memory.
///
/// A spectrogram frame lies on one axis (frequency), a sonar ping on two (range, bearing), a radar scan on four.
struct Grid {
    std::vector<Axis> axes;

    Index size() const;

    /// Whether a frame is a spectrum (one axis) rather than a ping or a scan (several axes).
    bool isSpectrum() const { return axes.size() == 1; }
    /// Whether a frame is a surface (two axes), such as a ping over range and bearing, which is shown as a whole.
    bool isSurface() const { return axes.size() == 2; }
    bool hasAxis(std::size_t axis) const { return axis < axes.size(); }
    /// Whether a list has one element per axis, as the coordinates and positions of this grid have.
    template <class Value>
    bool fits(const std::vector<Value> &values) const
    {
        return values.size() == axes.size();
    }
    /// "1 axis", "3 axes".
    std::string axisCountWords() const;

    /// Memory stride between neighbouring cells along one axis.
    Index stride(std::size_t axis) const;

    /// Coordinates of a flat cell index, one per axis.
    std::vector<Index> coordinates(Index cell) const;

    /// Position of a cell in the units of the axes.
    std::vector<double> position(Index cell) const;

    /// Flat index of coordinates, or -1 if any of them lies off a bounded axis.
    Index cell(const std::vector<Index> &coordinates) const;

    bool operator==(const Grid &) const = default;
};

} // namespace faintline

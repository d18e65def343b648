#pragma once

#include <cmath>
#include <cstddef>
#include <string>

namespace faintline {

using Index = std::ptrdiff_t;

/// One sampled dimension: index i ↔ physical value first + i·step (unit as named).
///
/// A cyclic axis wraps: the cell after the last one is the first one (a sonar's bearings).
/// All conversions between indices and physical values go through this class.
struct Axis {
    std::string name;
    std::string unit;
    double first = 0.0;
    double step = 1.0;
    Index count = 0;
    bool cyclic = false;
    bool isNamed = true; ///< false: its source gives no name, and `name` only numbers it

    double value(double index) const { return first + index * step; }

    /// Fractional index of a value; not clamped, not wrapped.
    double position(double value) const { return (value - first) / step; }

    /// Index of the nearest cell: wrapped on a cyclic axis, clamped to 0 … count-1 otherwise; 0 for NaN.
    Index nearest(double value) const;

    /// Wraps an index into 0 … count-1; returns -1 if it lies off a bounded axis.
    Index wrapped(Index index) const
    {
        if (index >= 0 && index < count)
            return index;
        if (!cyclic || count == 0)
            return -1;
        const Index rest = index % count;
        return rest < 0 ? rest + count : rest;
    }

    /// Steps from one index to another, the shorter way round on a cyclic axis.
    Index steps(Index from, Index to) const
    {
        const Index direct = to - from;
        if (cyclic && 2 * direct > count)
            return direct - count;
        return cyclic && 2 * direct < -count ? direct + count : direct;
    }

    /// An axis whose source says nothing but how many cells it has; `number` counts from 1.
    static Axis unnamed(std::size_t number, Index count)
    {
        return {"axis " + std::to_string(number), "", 0.0, 1.0, count, false, false};
    }

    double last() const { return value(double(count - 1)); }

    bool operator==(const Axis &) const = default;
};

} // namespace faintline

#pragma once

#include <algorithm>

namespace faintline {

/// An interval of time or frequency.
struct Span {
    double low = 0.0;
    double high = 0.0;

    double width() const { return high - low; }
    double middle() const { return 0.5 * (low + high); }
    bool contains(double value) const { return value >= low && value <= high; }
    bool isEmpty() const { return !(high > low); }

    /// Grown to at least `smallest`, shrunk to `full`, then moved inside it.
    Span within(const Span &full, double smallest = 0.0) const
    {
        const double size = std::min(std::max(width(), smallest), full.width());
        const double latest = std::max(full.low, full.high - size); // rounding may put the difference below full.low
        const double start = std::clamp(middle() - 0.5 * size, full.low, latest);
        return {start, start + size};
    }

    bool operator==(const Span &) const = default;
};

} // namespace faintline

#pragma once

#include "frames/PeakPyramid.h"
#include "widgets/base/Span.h"

#include <cmath>
#include <optional>

namespace faintline {

/// Where values stand on a scale of colours. Linear; of a statistic, linear up to one and a half thresholds and
/// logarithmic above, so that faint lines keep colours of their own beside lines of thousands of nats.
struct ColourScale {
    std::optional<double> threshold; ///< of the statistic; none: linear

    /// The scale of a picture's values.
    static ColourScale of(const ByteScale &scale, std::optional<double> threshold)
    {
        const bool isBent = scale.kind() == ByteScale::Kind::ScoreNats && threshold && *threshold > 0.0;
        return {isBent ? threshold : std::nullopt};
    }

    double linearUntil() const { return 1.5 * *threshold; }

    double place(double value) const
    {
        if (!threshold || !(value > linearUntil()))
            return value;
        return linearUntil() + bend() * std::log1p((value - linearUntil()) / bend());
    }
    /// The value at a place.
    double value(double place) const
    {
        if (!threshold || !(place > linearUntil()))
            return place;
        return linearUntil() + bend() * std::expm1((place - linearUntil()) / bend());
    }
    Span places(const Span &values) const { return {place(values.low), place(values.high)}; }
    Span values(const Span &places) const { return {value(places.low), value(places.high)}; }

    /// 0 … 1 from the first to the last colour of a range; outside it beyond.
    double share(double value, const Span &range) const
    {
        const Span all = places(range);
        return (place(value) - all.low) / all.width();
    }

private:
    double bend() const { return *threshold / 3.0; }
};

} // namespace faintline

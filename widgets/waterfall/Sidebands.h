#pragma once

#include <cmath>
#include <cstdlib>

namespace faintline {

/// A carrier and its sidebands: lines at carrier + n·spacing, n = -5 … 5.
struct Sidebands {
    static constexpr int orders = 5; ///< on either side

    double carrierHz = 0.0;
    double spacingHz = 0.0;

    double hz(int order) const { return carrierHz + order * spacingHz; }

    /// The order whose line is nearest to a frequency: -5 … 5, 0 the carrier.
    int nearestOrder(double hz) const
    {
        const double n = spacingHz > 0.0 ? std::round((hz - carrierHz) / spacingHz) : 0.0;
        return int(n < -orders ? -orders : n > orders ? +orders : n);
    }

    /// The spacing that places the line of a non-zero order on a frequency.
    double spacingFor(int order, double hz) const { return std::abs((hz - carrierHz) / order); }

    bool operator==(const Sidebands &) const = default;
};

} // namespace faintline

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// Speeds of propagation, m/s.
namespace propagation {
    constexpr double air = 343.0;
    constexpr double water = 1500.0;
    constexpr double light = 299'792'458.0;
} // namespace propagation

/// A source that passes a sensor at rest: at constant speed v on a straight line, with a tone of constant frequency.
///
/// Its distance is r(τ) = √(R² + v²(τ - t0)²). What it sends at time τ arrives at t = τ + r(τ)/c, with the frequency
///
///   f(t) = f0·dτ/dt = f0 / (1 + v²(τ - t0) / (c·r(τ))).
///
/// Times are those of the sensor's clock, on which t0 is the moment of closest approach *at the source*. What it sends
/// then is heard at t0 + R/c, and exactly there f = f0. Relativity's time dilation is not in it: of light, f0 is lower
/// than the source's own frequency by v²/2c² of it (3e-10 for a satellite).
struct DopplerPass {
    double restHz = 0.0;          ///< f0
    double metresPerSecond = 0.0; ///< v, 0 … c
    double rangeMetres = 0.0;     ///< R, at the closest approach
    double closestSeconds = 0.0;  ///< t0, at the source
};

/// Where the sound that arrives at a time was sent: τ - t0 in seconds, the solution before t of (t - τ)c = r(τ),
/// for w = t - t0 and D = R/c:  τ - t0 = (w - √(v²w²/c² + (1 - v²/c²)D²)) / (1 - v²/c²). Precondition: 0 ≤ v < c.
double emissionSeconds(const DopplerPass &pass, double propagation, double seconds);

/// f(t), Hz. Precondition: 0 ≤ v < c, R > 0. Oracle: bisection for τ, differences of the phase.
double receivedHz(const DopplerPass &pass, double propagation, double seconds);

/// One frequency of a track.
struct DopplerPoint {
    double seconds = 0.0;
    double hz = 0.0;
    double deviationHz = 1.0; ///< standard deviation; a factor common to all points changes nothing
};

/// A 90 % interval; an end that the track does not bound is open.
struct DopplerBounds {
    std::optional<double> low, high;

    bool isBounded() const { return low && high; }
    bool contains(double value) const { return (!low || *low <= value) && (!high || value <= *high); }
};

/// What a track tells of a pass, and what it does not (dopplerFit.h).
struct DopplerFit {
    DopplerPass pass;
    double propagation = 0.0; ///< c, m/s
    DopplerBounds restHz, metresPerSecond, rangeMetres, closestSeconds;

    std::vector<double> residualHz;     ///< measured less fitted, one per point
    std::vector<char> isLeftOut;        ///< 1: an outlier that did not take part
    double rmsHz = 0.0;                 ///< of the residuals that did
    double deviationScale = 1.0;        ///< the errors' standard deviations over those given
    double effectivePoints = 0.0;       ///< as many independent points have the same mean's error
    bool isBent = true;                 ///< a straight line does not explain the track
    std::vector<std::string> sentences; ///< what cannot be told, most important first

    double heardSeconds() const { return pass.closestSeconds + pass.rangeMetres / propagation; }
    /// df/dt there, -f0·v²/(c·R): what a track around the closest approach tells best.
    double slopeHzPerSecond() const
    {
        return -pass.restHz * pass.metresPerSecond * pass.metresPerSecond / (propagation * pass.rangeMetres);
    }
};

} // namespace faintline

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

/// A source passing a stationary sensor on a straight line at constant speed v, with a tone of constant frequency.
///
/// Its distance is r(τ) = √(R² + v²(τ - t0)²). A signal emitted at time τ arrives at t = τ + r(τ)/c, with the frequency
///
///   f(t) = f0·dτ/dt = f0 / (1 + v²(τ - t0) / (c·r(τ))).
///
/// Times are on the sensor's clock; t0 is the moment of closest approach *at the source*. A signal emitted then is
/// heard at t0 + R/c, where f = f0 exactly. Time dilation is not modelled: for light, f0 is lower than the source's own
/// frequency by the fraction v²/2c² (3e-10 for a satellite).
struct DopplerPass {
    double restHz = 0.0;          ///< f0
    double metresPerSecond = 0.0; ///< v, 0 … c
    double rangeMetres = 0.0;     ///< R, at the closest approach
    double closestSeconds = 0.0;  ///< t0, at the source
};

/// Emission time of a signal received at t: τ - t0 in seconds, the solution before t of (t - τ)c = r(τ), for w = t - t0
/// and D = R/c:  τ - t0 = (w - √(v²w²/c² + (1 - v²/c²)D²)) / (1 - v²/c²). Precondition: 0 ≤ v < c.
double emissionSeconds(const DopplerPass &pass, double propagation, double seconds);

/// f(t), Hz. Precondition: 0 ≤ v < c, R > 0. Oracle: bisection for τ, differences of the phase.
double receivedHz(const DopplerPass &pass, double propagation, double seconds);

/// One frequency of a track.
struct DopplerPoint {
    double seconds = 0.0;
    double hz = 0.0;
    double deviationHz = 1.0; ///< standard deviation; a common factor has no effect
};

/// A 90 % interval; open at an end that the track does not determine.
struct DopplerBounds {
    std::optional<double> low, high;

    bool isBounded() const { return low && high; }
    bool contains(double value) const { return (!low || *low <= value) && (!high || value <= *high); }
};

/// Result of a Doppler fit, with its limitations (dopplerFit.h).
struct DopplerFit {
    DopplerPass pass;
    double propagation = 0.0; ///< c, m/s
    DopplerBounds restHz, metresPerSecond, rangeMetres, closestSeconds;

    std::vector<double> residualHz;     ///< measured minus fitted, one per point
    std::vector<char> isLeftOut;        ///< 1: an outlier, excluded from the fit
    double rmsHz = 0.0;                 ///< of the residuals in the fit
    double deviationScale = 1.0;        ///< ratio of the errors' standard deviations to those given
    double effectivePoints = 0.0;       ///< number of independent points with the same error of the mean
    bool isBent = true;                 ///< a straight line does not explain the track
    std::vector<std::string> sentences; ///< limitations of the result, most important first

    /// Whether the track shows a pass and limits all of its parameters; only the range may have no lower limit, as where
    /// the frequency falls at once.
    bool isDetermined() const
    {
        return isBent && restHz.isBounded() && metresPerSecond.isBounded() && rangeMetres.high
               && closestSeconds.isBounded();
    }
    double heardSeconds() const { return pass.closestSeconds + pass.rangeMetres / propagation; }
    /// df/dt there, -f0·v²/(c·R): best determined by a track around the closest approach.
    double slopeHzPerSecond() const
    {
        return -pass.restHz * pass.metresPerSecond * pass.metresPerSecond / (propagation * pass.rangeMetres);
    }
};

/// Limitations of a fit, most important first: open intervals and their reasons, evidence against a straight pass, and
/// what one sensor cannot determine.
std::vector<std::string> dopplerSentences(const DopplerFit &fit, const std::vector<DopplerPoint> &points);

} // namespace faintline

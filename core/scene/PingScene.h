#pragma once

#include "base/Grid.h"
#include "base/json.h"
#include "scene/Fluctuation.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// Effect of a target's echo on the power y of its cell; S is the SNR as a power ratio, n the complex noise, E|n|² = 1.
enum class Echo {
    Constant,    ///< y = |n|² + S: constant added power (Parsons 2008, section 3)
    Fluctuating, ///< y ~ (1 + S)·Exp(1), independent in each ping and look: Swerling 2 (Grossi and Lops 2006, eq. 10)
    Complex      ///< y = |n + √S e^{iφ}|²: constant amplitude, random phase (Billon 2005)
};
inline constexpr std::array<std::string_view, 3> echoNames{"constant", "fluctuating", "complex"};

/// Rates of range and bearing for a number of pings. Physical rates and rates in cells add up, so either may be given.
struct PingLeg {
    int pings = 0; ///< duration; 0: to the end
    double rangeRateMetresPerSecond = 0.0;
    double bearingRateDegreesPerSecond = 0.0;
    double rangeCellsPerPing = 0.0;
    double beamsPerPing = 0.0;
    int turnPings = 1;                          ///< pings over which the rates change from the previous leg's to these
    double elevationRateDegreesPerSecond = 0.0; ///< has no effect without elevations

    static const std::vector<Field<PingLeg>> &fields();
    bool operator==(const PingLeg &) const = default;
};

/// A point target: start, motion, strength.
///
/// With v(k) the rate k pings after it appears, its position is p(k+1) = p(k) + (v(k) + v(k+1))/2 on each axis, and it
/// fills the nearest cell. Bearings wrap; a target beyond the cells of another axis is silent until it returns. On a
/// Doppler axis it is at its own range rate.
///
/// With fluctuation S is multiplied by a power of mean 1: one for the whole track (Swerling 1 and 3), or one for each
/// ping (2 and 4). A track and not a leg is the look of cases 1 and 3, because legs describe the motion: a detector
/// integrates across them. Swerling's targets have the echo Complex; with Constant the added power fluctuates.
struct PingTarget {
    double snrDb = 7.0;
    Echo echo = Echo::Constant;
    Fluctuation fluctuation = Fluctuation::None;
    double rangeMetres = 0.0;
    double bearingDegrees = 0.0;
    int appearPing = 0;
    int vanishPing = 0;             ///< first ping without it; 0: never
    double weaveCellsPerPing = 0.0; ///< amplitude of a sinusoid added to the range rate
    double weavePings = 20.0;       ///< its period
    std::vector<PingLeg> legs{};    ///< in order; without legs the target is stationary
    double elevationDegrees = 0.0;  ///< at which it appears; has no effect without elevations

    /// The target's own members, without legs.
    static const std::vector<Field<PingTarget>> &fields();
    bool operator==(const PingTarget &) const = default;
};

/// Mean by which the pings are divided if there is reverberation.
enum class PingNormalisation {
    Known,    ///< the true mean
    Estimated ///< the mean of the surrounding cells in the same ping (SimulatedPings)
};
inline constexpr std::array<std::string_view, 2> pingNormalisationNames{"known", "estimated"};

/// Reverberation: a background power levelDb above the noise in the first range cell that falls with
/// (range)^-decayPower.
struct Reverberation {
    double levelDb = 20.0;
    double decayPower = 3.0;
    PingNormalisation normalisation = PingNormalisation::Known;

    static const std::vector<Field<Reverberation>> &fields();
    bool operator==(const Reverberation &) const = default;
};

/// A scene of active sonar pings to simulate: a grid of range × bearing, targets, noise. The defaults are Parsons'
/// simulation (2008, section 3): 2500 range cells of 10 m, 20 beams over 360°, a ping every 40 s. A radar's scans have
/// two more axes, elevation and Doppler; with a single cell an axis does not exist.
struct PingScene {
    int pings = 60;
    double priSeconds = 40.0; ///< between pings
    int rangeCells = 2500;
    double firstRangeMetres = 3000.0; ///< centre of the first range cell
    double rangeStepMetres = 10.0;
    int beams = 20;
    double firstBearingDegrees = 0.0;
    double beamStepDegrees = 0.0; ///< 0: beams over 360°, 360°/beams
    int elevationCells = 1;
    double firstElevationDegrees = 0.0;
    double elevationStepDegrees = 2.0;
    int dopplerCells = 1;
    double firstDopplerMetresPerSecond = 0.0; ///< range rate, outward positive
    double dopplerStepMetresPerSecond = 10.0;
    int looks = 1; ///< M: powers averaged in a cell; y is χ² with 2M degrees of freedom and mean 1
    int seed = 1;
    std::optional<Reverberation> reverberation{};
    std::vector<PingTarget> targets{};

    /// The scene's own members.
    static const std::vector<Field<PingScene>> &fields();
    bool operator==(const PingScene &) const = default;
};

/// Axes of a ping: range, bearing, then elevation and Doppler if there are any. The bearing is cyclic if the beams
/// cover 360°.
Grid pingGrid(const PingScene &scene);

/// Times of the pings.
Axis pingTime(const PingScene &scene);

/// Power of noise and reverberation in a range cell; that of the noise is 1.
double backgroundPower(const PingScene &scene, Index rangeCell);

/// Checks the scene. Throws Error naming the key.
void checkScene(const PingScene &scene);

/// Whether JSON describes a ping scene: {"kind": "pings", …}.
bool isPingScene(const Json &json);

/// Reads a scene from {"kind": "pings", "reverberation": {…}, "targets": [{…, "legs": [{…}]}], …}. Unknown keys are
/// errors; missing ones take their defaults. Throws Error as checkScene does.
PingScene pingSceneFromJson(const Json &json);

Json toJson(const PingScene &scene);

} // namespace faintline

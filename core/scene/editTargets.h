#pragma once

#include "scene/PingScene.h"

#include <vector>

namespace faintline {

/// Editing of a ping scene's targets by places on the map. The scene is a value: each function returns a changed copy
/// of a target and leaves the scene alone.
///
/// A target's path is that of `pingTruth`. Its *corners* are its start and the ends of its legs, as far as they lie
/// within the scene; corner i > 0 is the end of leg i - 1. Placing a corner changes the rates of its own leg only, so
/// the legs that follow keep their rates and move along. Rates are linear in the place: with A the distance that the
/// corner moves for a rate of one cell per ping, A = Σ of the leg's share of the rate over the pings before the corner,
///
///     v' = v + (place - corner)/A
///
/// Oracle: pingTruth of the changed target.

/// Units of a leg's rates.
enum class RateUnit {
    PerSecond, ///< m/s and °/s
    PerPing    ///< cells/ping and beams/ping
};

/// A position in the scene's units, range in m and bearing in degrees.
struct ScenePlace {
    double rangeMetres = 0.0;
    double bearingDegrees = 0.0;
};

struct TargetCorner {
    int ping = 0;
    ScenePlace place;
};

/// Number of pings of a leg that is drawn, unless the scene or the target ends before.
constexpr int usualLegPings = 20;

/// The start and the ends of the legs, in order; empty if the target appears after the scene's end.
std::vector<TargetCorner> cornersOf(const PingScene &scene, const PingTarget &target);

/// The target with one corner at a place, clamped to the cells of the map, with rates in this unit. Across a turn of
/// 360° a leg takes the shorter way. Values are rounded to a power of ten that moves the corner by at most a tenth of a
/// cell. Unchanged if there is no such corner.
PingTarget withCornerAt(const PingScene &scene, const PingTarget &target, std::size_t corner, const ScenePlace &place,
                        RateUnit unit);

/// The target with another leg, from its last corner to a place, of `usualLegPings`. Throws Error if no ping is left.
PingTarget withLegTo(const PingScene &scene, const PingTarget &target, const ScenePlace &place, RateUnit unit);

/// The unit that the scene's legs use: pings if any rate is in cells or beams per ping, otherwise seconds.
RateUnit rateUnitOf(const PingScene &scene);

/// The sum of a leg's rates in both units, in one of them.
double rangeRateOf(const PingLeg &leg, const PingScene &scene, RateUnit unit);
double bearingRateOf(const PingLeg &leg, const PingScene &scene, RateUnit unit);

/// Sets a rate in one unit; that in the other becomes 0.
void setRangeRate(PingLeg &leg, double rate, RateUnit unit);
void setBearingRate(PingLeg &leg, double rate, RateUnit unit);

} // namespace faintline

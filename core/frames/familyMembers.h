#pragma once

#include "frames/Family.h"

#include <span>
#include <string>
#include <vector>

namespace faintline {

// The individual members of a family that FamilyMap combines.

/// The bins of a band in which the members of a family at `hz` lie, in the order of the settings; -1: outside.
/// `hasRealEnds` as in FamilyMap. Without a family: the bin at `hz`.
std::vector<Index> memberBins(const FamilySettings &settings, double hz, const Axis &band, bool hasRealEnds);

/// y of the family from y of its members, each in all channels, as in FamilyMap. NaN: not observed, so not counted as a
/// member. Thread-safe.
float familyPower(FamilySettings::Present present, std::span<const float> members, std::size_t channels = 1);

/// "3×", or "+50 Hz" of offsets.
std::string memberName(const FamilySettings &settings, double member);

} // namespace faintline

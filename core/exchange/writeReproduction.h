#pragma once

#include "evaluate/reproduce/Reproduction.h"

#include <string>

namespace faintline {

/// The reproduction as a table for reading: for each cell the paper's figure, ours, its 95 % interval, the gap, and
/// whether it lies inside its tolerance; then the notes.
std::string reproductionText(const Reproduction &reproduction);

/// The same as JSON text.
std::string reproductionJson(const Reproduction &reproduction);

/// Writes NAME.json, NAME.csv and a picture NAME.svg (NAME-2.svg …) of every chart into a folder, made if need be; the
/// name's colon becomes a hyphen. Throws Error.
void writeReproduction(const Reproduction &reproduction, const std::string &folder);

} // namespace faintline

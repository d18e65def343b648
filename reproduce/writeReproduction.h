#pragma once

#include "reproduce/Reproduction.h"

#include <string>

namespace faintline {

/// The reproduction as a text table: for each cell the published number, ours, its 95 % interval, the difference, and
/// whether it is within its tolerance; then the notes.
std::string reproductionText(const Reproduction &reproduction);

/// The same as JSON text.
std::string reproductionJson(const Reproduction &reproduction);

/// Writes NAME.json, NAME.csv and a picture NAME.svg (NAME-2.svg …) of each chart to a folder, which is created if
/// necessary; the name's colon becomes a hyphen. Throws Error.
void writeReproduction(const Reproduction &reproduction, const std::string &folder);

} // namespace faintline

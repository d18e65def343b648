#pragma once

#include "signal/fileFormats.h"

namespace faintline {

/// The table of how to read raw samples, for forms: of its many types, those of most receivers and sound cards first.
std::vector<Field<OpenOptions>> rawFields();

} // namespace faintline

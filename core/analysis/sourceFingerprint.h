#pragma once

#include <string_view>

namespace faintline {

/// Stands for the sources of all that a calibration can depend on: another text, other sources. Defined in a file that
/// the build writes (cmake/fingerprint.cmake).
std::string_view sourceFingerprint();

} // namespace faintline

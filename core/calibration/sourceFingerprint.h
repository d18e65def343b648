#pragma once

#include <string_view>

namespace faintline {

/// Identifies the sources on which a calibration or a survey's events can depend: it changes when they do. Defined in a
/// file that the build writes (cmake/fingerprint.cmake).
std::string_view sourceFingerprint();

} // namespace faintline

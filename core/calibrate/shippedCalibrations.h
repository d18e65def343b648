#pragma once

#include <span>
#include <string_view>

namespace faintline {

/// A calibration that is part of the program: a file of resources/calibrations.
struct ShippedCalibration {
    std::string_view name; ///< of the file, without ending
    std::string_view key;
    std::string_view text; ///< as a CalibrationStore writes it
};

/// All of them, in the order of their names.
std::span<const ShippedCalibration> shippedCalibrations();

} // namespace faintline

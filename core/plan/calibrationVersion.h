#pragma once

namespace faintline {

/// Version of calibrations. A kept calibration is valid for its key, which is its settings, and for this number; a
/// survey is continued only by a program with the same number.
///
/// Raise it with every change after which the same key gives thresholds or rates outside the intervals stated for the
/// old ones: of the simulated noise, spectrogram, background, detectors or causal chain; of the default of a setting in
/// the key, which holds only what differs from the defaults; or of what a file holds. A faster simulation of the same
/// is no reason. Then make the shipped calibrations again, which takes about ten minutes of processor time:
///
///   faintline-cli calibrate --shipped resources/calibrations
inline constexpr int calibrationVersion = 2;

} // namespace faintline

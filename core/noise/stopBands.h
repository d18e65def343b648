#pragma once

#include "frames/Spectrogram.h"
#include "noise/NoiseBackground.h"

#include <utility>
#include <vector>

namespace faintline {

/// Stop bands of the filter that a recording went through, at the ends of its spectrum (the upper one of real samples):
/// the noise there is what the filter leaves of the pass band, and so are its lines. A stop band
/// - is at least 20 dB (a hundredth) below the upper quartile of the spectrum throughout, over a fiftieth of it,
/// - begins with a fall of at least 20 dB within a twentieth of the spectrum, and
/// - follows the level of as wide a band beside it in time: correlation of ln level above 3/4, slope above 0.4.
/// A noise of constant level therefore has none: whether its quiet end is a filter's or the world's cannot be told.
/// `lnPower`: times × cells, finite; none in fewer than 16 times.
std::vector<StopBand> stopBands(const Axis &frequency, std::vector<std::vector<double>> lnPower, bool isComplex);

/// Of a spectrogram's recording, whatever its window, from medians of 8 spectra of 1024 samples at up to 64 times; none
/// if a band is selected, or the selection has fewer than 131 072 samples.
std::vector<StopBand> stopBands(const Spectrogram &spectrogram);

/// The first cell of an axis in a stop band, and the one behind the last.
std::pair<Index, Index> cellsIn(const StopBand &band, const Axis &frequency);

} // namespace faintline

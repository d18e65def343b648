#pragma once

#include "base/RunContext.h"
#include "plan/Analysis.h"

#include <optional>

namespace faintline {

/// A box of frames and cells: begin … end-1, all of which must exist.
struct FrameBox {
    Index beginFrame = 0;
    Index endFrame = 0;
    Index beginCell = 0;
    Index endCell = 0;
};

struct BoxLevels {
    double meanDb = 0.0;         ///< 10·lg of the mean y
    std::optional<double> snrDb; ///< nothing if the box holds no more than its noise
};

/// The area SNR of a box: its power above the adjacent noise, as that of one line,
///
///     SNR = 10·lg r,   r = 1/(T k_f) Σ_t Σ_f ( y(t, f)/N − 1 )
///
/// y   power over noise of the frames (mean 1 on noise), over the box's T frames and its cells
/// k_f bins per resolution cell; 1 where frames are no spectrogram
/// N   mean noise of the cells beside the box, in the same frames, as wide as the box on either side (at least 8
///     resolution cells) and 2 resolution cells away; truncated at five times itself, so that other lines count
///     little
///
/// For Σ w² = 1 Parseval gives Σ_f |S|² = k_f·T_FT·Σ|w·x|², so r is the line's SNR in one cell of a rectangular window
/// for any window shape, as long as its main lobe is in the box: the snrDb of scenarios and injected lines
/// (toneAmplitude). Oracle: a simulated line. Its standard error on noise alone is about √(cells / (k_f·T)). If the box
/// has more than 4096 frames, 4096 evenly spread ones are used. Requires frames on one axis; throws Error on others,
/// Cancelled. Thread-safe.
BoxLevels boxLevels(const Analysis &analysis, const FrameBox &box, const RunContext &context = {});

} // namespace faintline

#include "noise/coarseFrames.h"

namespace faintline {

Spectrogram coarseFrames(const Spectrogram &spectrogram, const NormaliserSettings &settings, int stepsPerWindow)
{
    SpectrogramSettings coarse = spectrogram.settings();
    coarse.windowSeconds = spectrogram.windowSeconds();
    coarse.stepsPerWindow = stepsPerWindow;
    coarse.binsPerCell = 1;
    SelectionSettings wide = spectrogram.selection();
    if (!isWholeBand(wide)) {
        const double margin = 2.0 * settings.halfWidthCells / coarse.windowSeconds;
        wide.lowHz -= margin;
        wide.highHz += margin;
    }
    return {spectrogram.recordingPointer(), coarse, wide};
}

} // namespace faintline

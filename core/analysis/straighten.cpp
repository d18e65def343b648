#include "analysis/straighten.h"

#include "analysis/smoothFrequency.h"
#include "base/Error.h"

#include <algorithm>

namespace faintline {

Straightened straightened(const Analysis &analysis, const Event &event, double smoothingSeconds,
                          std::optional<double> targetHz)
{
    if (!analysis.recording)
        throw Error("straightening", "requires a recording; these are ready-made frames");
    constexpr double leastCells = 40.0;
    const int channel = analysis.settings.selection.channel;
    const FrequencyCurve curve = smoothFrequency(analysis, *trackOfId(analysis.tracks, event.id), smoothingSeconds);
    Straightened result;
    result.recording =
        std::make_shared<StraightenedRecording>(analysis.recording, channel, curve, targetHz.value_or(curve.meanHz()));
    const auto [least, most] = std::minmax_element(curve.hz().begin(), curve.hz().end());
    const double half = 0.5 * analysis.time().step;
    result.before = {channel, event.onsetSeconds - half, event.endSeconds + half, 0.5 * (*least + *most), 0.0};
    result.before.halfBandHz =
        std::max(2.0 * (*most - *least), leastCells / (result.before.toSeconds - result.before.fromSeconds));
    result.after = result.before;
    result.after.channel = 0;
    result.after.hz = result.recording->targetHz();
    return result;
}

} // namespace faintline

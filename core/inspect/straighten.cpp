#include "inspect/straighten.h"

#include "base/Error.h"
#include "refine/smoothFrequency.h"
#include "signal/ResampledRecording.h"
#include "signal/StraightenedRecording.h"

#include <algorithm>
#include <memory>
#include <string>

namespace faintline {

namespace {

    /// Time and band in which an event's line, `multiple` times the curve, is examined.
    Stretch stretchOf(const Analysis &analysis, const Event &event, const FrequencyCurve &curve, double multiple)
    {
        constexpr double leastCells = 40.0;
        const auto [least, most] = std::minmax_element(curve.hz().begin(), curve.hz().end());
        const double half = 0.5 * analysis.time().step;
        Stretch stretch{analysis.settings.selection.channel, event.onsetSeconds - half, event.endSeconds + half,
                        0.5 * multiple * (*least + *most), 0.0};
        stretch.halfBandHz =
            std::max(2.0 * multiple * (*most - *least), leastCells / (stretch.toSeconds - stretch.fromSeconds));
        return stretch;
    }

} // namespace

Straightening straighteningOf(std::string_view name)
{
    const auto found = std::find(straighteningNames.begin(), straighteningNames.end(), name);
    if (found == straighteningNames.end())
        throw Error("method = " + std::string(name), "must be shift or resample");
    return Straightening(found - straighteningNames.begin());
}

Straightening usualStraightening(const AnalysisPlan &plan)
{
    return plan.settings.family.relation == FamilySettings::Relation::Harmonics ? Straightening::Resample
                                                                                : Straightening::Shift;
}

Straightened straightened(const Analysis &analysis, const Event &event, const StraightenChoice &choice)
{
    if (!analysis.recording)
        throw Error("straightening", "requires a recording; these are ready-made frames");
    const FamilySettings &family = analysis.settings.family;
    const int channel = analysis.settings.selection.channel;
    const FrequencyCurve curve =
        smoothFrequency(analysis, *trackOfId(analysis.tracks, event.id), choice.smoothingSeconds);
    const double target = choice.targetHz.value_or(curve.meanHz());
    const Straightening kind = choice.kind.value_or(usualStraightening(analysis));
    const bool isResampled = kind == Straightening::Resample;
    const double multiple =
        isResampled && family.relation == FamilySettings::Relation::Harmonics ? family.members.front() : 1.0;
    const Stretch before = stretchOf(analysis, event, curve, multiple);
    Stretch after = before;
    after.channel = 0;
    after.hz = multiple * target;
    if (!isResampled)
        return {std::make_shared<StraightenedRecording>(analysis.recording, channel, curve, target),
                curve,
                target,
                kind,
                before,
                after};
    const auto made = std::make_shared<ResampledRecording>(analysis.recording, channel, curve, target);
    after.fromSeconds = made->secondsOf(before.fromSeconds);
    after.toSeconds = made->secondsOf(before.toSeconds);
    return {made, curve, target, kind, before, after};
}

} // namespace faintline

#pragma once

#include "analysis/analyse.h"

#include <memory>
#include <vector>

namespace faintline {

/// Normalised frames first … first+count-1 held in memory, so that another detector can go through them at once.
struct KeptFrames {
    NormalisedFramesPointer source;
    Index first = 0;
    Index count = 0;
    std::vector<float> values; ///< count × cells

    /// Whether these are what `wanted` frames of a source would be.
    bool holds(const NormalisedFramesPointer &frames, Index from, Index to) const
    {
        return source == frames && first <= from && to <= first + count;
    }
};

/// Reads them. Throws Cancelled.
std::shared_ptr<const KeptFrames> keepFrames(NormalisedFramesPointer source, Index first, Index count,
                                             const RunContext &context = {});

/// What a changed detector makes of a few frames, before anything has been calibrated for it.
struct StatisticPreview {
    /// D of the frames shown, its time axis begins with the first of them.
    std::shared_ptr<const PeakPyramid> statistic;
    double lnK = 0.0; ///< in force; of detectors without K as before
};

/// The frames that are needed to show `first … last`: these, and some before them for the detector to settle on. Empty
/// where they hold more than 7·10⁷ cells, on which a preview would take as long as everything else. Of pings, whose
/// frames have as many states as a recording's minute, 16 before those shown.
struct FrameRange {
    Index readFirst = 0;
    Index first = 0;
    Index end = 0;
    bool isKeepable = false; ///< in memoryShares::previewFrames; more than that is read as it is needed

    bool isEmpty() const { return first >= end; }
};
FrameRange previewRange(const NormalisedFrames &frames, Index first, Index last);

/// Runs the detector that the settings describe over a range of frames, kept ones where there are: the same recursion,
/// but no threshold, no trackers and none of their feedback, so where something was detected D goes on growing.
///
/// K, where it would be calibrated to 50 % of noise states continued, is found on these frames themselves: regulated
/// toward that over the first of them (ResetLaw::Half) and held from then on. Most cells are noise, so it lies near the
/// calibrated one; it is a preview's. Depends on nothing but the frames and settings. Cost: one pass of the recursion;
/// no simulation. Oracle: Smd run with the same ln K. A bank's models keep the offsets that make their false alarms
/// equal. Precondition: `kept` is null or holds the range.
StatisticPreview previewStatistic(const Analysis &before, const AnalysisSettings &settings, const FrameRange &range,
                                  const KeptFrames *kept, const RunContext &context = {});

/// Whether a change of settings is worth a preview: the detector or its model, and nothing before it.
bool isWorthAPreview(const Analysis &before, const AnalysisSettings &settings);

} // namespace faintline

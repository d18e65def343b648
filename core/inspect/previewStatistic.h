#pragma once

#include "base/RunContext.h"
#include "plan/Analysis.h"

#include <memory>
#include <vector>

namespace faintline {

/// Normalised frames first … first+count-1 of a source held in memory, so that another detector can process them at
/// once. Only these can be read, by the source's numbers.
class KeptFrames final : public NormalisedFrames
{
public:
    /// Reads the frames. Throws Cancelled.
    KeptFrames(NormalisedFramesPointer source, Index first, Index count, const RunContext &context = {});

    void read(Index first, Index count, std::span<float> out) const override;

    /// Whether these include the frames from … to-1 of a source.
    bool holds(const NormalisedFramesPointer &frames, Index from, Index to) const
    {
        return m_source == frames && m_first <= from && to <= m_first + m_count;
    }

private:
    NormalisedFramesPointer m_source;
    Index m_first;
    Index m_count;
    std::vector<float> m_values; ///< count × cells
};

/// Output of a changed detector on a few frames, before anything has been calibrated for it.
struct StatisticPreview {
    /// D of the displayed frames; its time axis begins with the first of them.
    std::shared_ptr<const PeakPyramid> statistic;
    double lnK = 0.0; ///< in force; for detectors without K as before
};

/// The frames needed to display `first … last`: these, and some before them on which the detector settles. Empty if
/// they hold more than 7·10⁷ cells, for which a preview would take as long as the analysis. For pings, whose frames
/// have as many states as a minute of a recording, 16 before those displayed.
struct FrameRange {
    Index readFirst = 0;
    Index first = 0;
    Index end = 0;
    bool isKeepable = false; ///< fits into memoryShares::previewFrames; otherwise frames are read when needed

    bool isEmpty() const { return first >= end; }
};
FrameRange previewRange(const NormalisedFrames &frames, Index first, Index last);

/// Runs the detector that the settings describe over a range of frames, kept ones or the analysis's: the same recursion,
/// but without threshold, trackers and their feedback, so D continues to grow where something was detected.
///
/// If K would be calibrated to 50 % of noise states continued, it is determined on these frames: regulated toward that
/// over the first of them (ResetLaw::Half) and then held. Most cells are noise, so it is near the calibrated one, which
/// is sufficient for a preview. Depends only on the frames and settings. Cost: one pass of the recursion; no
/// simulation. Oracle: Smd run with the same ln K. A bank's models keep the offsets that make their false alarms equal.
StatisticPreview previewStatistic(const Analysis &before, const AnalysisSettings &settings, const FrameRange &range,
                                  const NormalisedFrames &frames, const RunContext &context = {});

/// Whether a change of settings justifies a preview: it concerns the detector or its model, and nothing before it.
bool isWorthAPreview(const Analysis &before, const AnalysisSettings &settings);

} // namespace faintline

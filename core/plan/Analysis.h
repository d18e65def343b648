#pragma once

#include "base/Checkpoints.h"
#include "frames/PeakPyramid.h"
#include "plan/AnalysisPlan.h"
#include "plan/WindowChoice.h"
#include "track/Area.h"
#include "track/DetectionChain.h"
#include "track/Track.h"

#include <memory>
#include <optional>
#include <vector>

namespace faintline {

/// Range of ln K on settled noise: mean ± 4 standard deviations. One global K regulates all states, so strong signals
/// without a track lower it, and thereby all other paths; a value outside the band shows that this has begun. Source:
/// Parsons 2008 has no such check; eight targets of 7 dB take K from -1.5 to -2.9 within 25 pings.
struct NoiseBand {
    double mean = 0.0;
    double deviation = 0.0;

    double low() const { return mean - 4.0 * deviation; }
    double high() const { return mean + 4.0 * deviation; }
    bool contains(double lnK) const { return lnK >= low() && lnK <= high(); }
};

struct SecondView;

/// Result of a run of the chain, with its plan. Immutable; parts that remain valid after a change of settings are
/// shared.
struct Analysis : AnalysisPlan {
    std::shared_ptr<const PeakPyramid> input;     ///< y in dB
    std::shared_ptr<const PeakPyramid> statistic; ///< D in nats
    /// Both pictures along each axis, the maximum over the others; for lines, the pictures themselves.
    std::vector<std::shared_ptr<const PeakPyramid>> inputAlong, statisticAlong;
    /// For frames on several axes: the boxes inhibited in each frame, and their tracks.
    std::vector<std::vector<DetectionChain::Inhibition>> inhibitions;
    std::vector<Track> tracks; ///< ordered by detection, then cell
    /// Tracks that the recording's own noise explains (ownNoiseLaw.h), not among `tracks`.
    std::vector<Track> explainedByNoise;
    /// What the tracks of a trial were made from, so that it can be completed (secondLook.h).
    std::shared_ptr<const SecondView> firstView;
    std::vector<Area> areas; ///< regions of raised level without a line, ordered by time (secondLook.h)
    /// For frames on several axes: the tracks found by thresholding each frame separately.
    std::vector<Track> conventional;
    std::vector<float> lnK;               ///< per frame, from frame `firstLnK` on
    Index firstLnK = 0;                   ///< 0, but for the newest frames of a run that goes on
    NoiseBand lnKBand;                    ///< its range on noise, under a law that regulates it (regulation.h)
    std::vector<float> continuedFraction; ///< per frame
    /// Cells whose D lies in [i/4 - 4, (i+1)/4 - 4) nat: histogram of the data. Of a whole analysis (AnalysisDepth).
    std::vector<double> statisticCounts;

    /// States of the chain, evenly spaced, for repeating a part of the run: ≤ 32 MiB for any number of tracks; none for
    /// detectors that cannot save their state.
    Checkpoints<ChainState> checkpoints;

    std::optional<WindowChoice> choice; ///< if the recording determined the window (chooseWindow.h)
    /// In that case: analyses with the other windows, the shortest first, of which `tracks` have what they know better
    /// (otherWindows.h). Without pictures.
    std::vector<std::shared_ptr<const Analysis>> others;
    /// If strong lines were subtracted: analysis of the unchanged recording, without pictures. The frames and all other
    /// results are then those of the remainder; `tracks` has both (subtractLines.h). Null if nothing was subtracted.
    std::shared_ptr<const Analysis> unsubtracted;
    /// The analysis of the unchanged recording: that one, or this one.
    const Analysis &ofUnchanged() const { return unsubtracted ? *unsubtracted : *this; }

    /// Whether this analysis has the given settings.
    bool answers(const AnalysisSettings &wanted) const
    {
        return settings == wanted || (choice && choice->asked == wanted);
    }
};

} // namespace faintline

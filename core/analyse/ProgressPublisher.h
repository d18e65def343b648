#pragma once

#include "analyse/PicturesSoFar.h"
#include "base/RunContext.h"
#include "frames/Spectrogram.h"
#include "plan/AnalysisSettings.h"

#include <chrono>
#include <memory>

namespace faintline {

/// Publishes pictures of a run that takes long or waits for a calibration, at a rate that does not slow the run.
class ProgressPublisher
{
public:
    ProgressPublisher() = default; ///< publishes nothing
    ProgressPublisher(const PictureSink &sink, const Axis &time, const Axis &frequency,
                      const AnalysisSettings &settings);

    void publishQuickLook(std::shared_ptr<const Spectrogram> spectrogram, const NormaliserSettings &settings,
                          const RunContext &context);
    /// Publishes the part processed so far.
    void publish(const std::shared_ptr<PeakPyramid> &input, const PeakPyramid &statistic);

private:
    PictureSink m_sink;
    PicturesSoFar m_pictures;
    bool m_isWanted = false;
    std::chrono::steady_clock::time_point m_last{};
};

} // namespace faintline

#pragma once

#include "analyse/AnalysisRequest.h"
#include "base/RunContext.h"
#include "frames/Spectrogram.h"
#include "noise/NoiseNormaliser.h"

#include <chrono>
#include <memory>

namespace faintline {

/// Publishes pictures of a run, if they are wanted, at a rate that does not slow it.
class ProgressPublisher
{
public:
    ProgressPublisher() = default; ///< publishes nothing
    ProgressPublisher(const PictureSink &sink, const Axis &time, const Axis &frequency);

    void publishQuickLook(std::shared_ptr<const Spectrogram> spectrogram, const NormaliserSettings &settings,
                          const RunContext &context);
    /// Publishes the part processed so far.
    void publish(const std::shared_ptr<PeakPyramid> &input, const PeakPyramid &statistic);
    void publishWhole(std::shared_ptr<const PeakPyramid> input, std::shared_ptr<const PeakPyramid> statistic);

private:
    PictureSink m_sink;
    PicturesSoFar m_pictures;
    std::chrono::steady_clock::time_point m_last{};
};

} // namespace faintline

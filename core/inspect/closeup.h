#pragma once

#include "base/RunContext.h"
#include "plan/Analysis.h"

#include <optional>

namespace faintline {

/// Frames begin … end-1.
struct FrameStretch {
    Index begin = 0;
    Index end = 0;

    bool isEmpty() const { return begin >= end; }
    bool contains(const FrameStretch &other) const { return begin <= other.begin && other.end <= end; }
    bool operator==(const FrameStretch &) const = default;
};

/// The frames of a close-up of the `visible` part of a picture: the visible frames, and as many beside them as fit.
///
/// Empty if a close-up would show no more detail: the picture's rows are single frames or smaller than a pixel, or so
/// much of it is visible that the byte budget would merge rows as far. Begins with a row of the picture's finest level.
FrameStretch closeupStretch(const PeakPyramid &picture, const FrameStretch &visible, double framesPerPixel,
                            std::size_t byteBudget);

/// Frames per row of a picture with this number of frames within a byte budget.
Index framesPerRowWithin(std::size_t byteBudget, Index frames, Index cells);

/// A stretch of an analysis's input and of its statistic, with the rows that an analysis of the whole would have with
/// unlimited memory: the frames are read again, and the chain continues from the checkpoint before them. Time axes
/// begin with the stretch's first frame.
///
/// Cost: for the input, reading; for the statistic, also the chain over the stretch and up to an interval of
/// checkpoints, or over all preceding frames if the detector cannot save its state. Throws Cancelled. Oracle: the
/// analysis's own pictures where they are not merged.
std::shared_ptr<const PeakPyramid> inputCloseup(const Analysis &analysis, const FrameStretch &stretch,
                                                std::size_t byteBudget, const RunContext &context = {});
std::shared_ptr<const PeakPyramid> statisticCloseup(const Analysis &analysis, const FrameStretch &stretch,
                                                    std::size_t byteBudget, const RunContext &context = {});

/// The power itself, in dB over a reference: what the input was before the noise was divided out.
struct PlainPicture {
    std::shared_ptr<const PeakPyramid> picture;
    double referenceDb; ///< level that a twentieth of the noise stays below, whole dB re full scale² per Hz
};

/// Of frames of single lines of a recording; nothing of others, or of silence. Throws Cancelled.
std::optional<PlainPicture> plainPicture(const Analysis &analysis, std::size_t byteBudget,
                                         const RunContext &context = {});

/// One channel of a recording: y in dB, power over that channel's own noise, on the axes of its spectrogram.
struct ChannelPicture {
    std::shared_ptr<const PeakPyramid> picture;
    Axis frequency; ///< Hz
};

/// The input of an analysis of that channel alone, without a family and with all lines: as `analyse` would draw it
/// within the byte budget, without running a detector. Cost: the noise estimate and one reading. Throws Error if the
/// channel holds no usable sample, Cancelled. Oracle: the input of such an analysis.
ChannelPicture channelPicture(const RecordingPointer &recording, const AnalysisSettings &settings, int channel,
                              std::size_t byteBudget, const RunContext &context = {});

} // namespace faintline

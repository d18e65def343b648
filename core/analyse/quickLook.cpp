#include "analyse/quickLook.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr double affordableSamples = 33554432.0;
    constexpr Index mostFrames = 256;
    constexpr Index fewestShownFrames = 32;

} // namespace

std::shared_ptr<const PeakPyramid> quickLook(std::shared_ptr<const Spectrogram> spectrogram,
                                             const NormaliserSettings &settings, const RunContext &context)
{
    const auto background = estimateBackground(*spectrogram, settings, context, BackgroundDepth::Sketch);
    const NormalisedSpectrogram frames(spectrogram, background, settings);
    const Index all = frames.time().count;
    const double perFrame = spectrogram->windowSamples() * spectrogram->settings().binsPerCell;
    const auto affordable = Index(affordableSamples / perFrame);
    const Index count = std::min(all, std::clamp(affordable, fewestShownFrames, mostFrames));

    Axis time = frames.time();
    time.step *= double(all) / double(count);
    time.count = count;
    auto picture = std::make_shared<PeakPyramid>(time, frames.grid().size(), ByteScale(ByteScale::Kind::PowerDb));
    std::vector<float> frame(std::size_t(frames.grid().size()));
    for (Index i = 0; i < count; ++i) {
        context.checkpoint(double(i) / double(count), "first look");
        frames.read((2 * i + 1) * all / (2 * count), 1, frame);
        picture->append(frame);
    }
    picture->finish();
    return picture;
}

} // namespace faintline

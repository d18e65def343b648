#include "analyse/ProgressPublisher.h"

#include "analyse/constants.h"
#include "frames/PeakPyramid.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace faintline {

namespace {

    /// A quick look at a recording of any length: frames spread evenly over it, in dB over a background from a few of
    /// them.
    ///
    /// At most 256 frames, fewer for long windows: some 2²⁵ samples are transformed, which takes a fraction of a
    /// second. Its time axis is that of the frames it holds. For display only: it shows nothing between these frames.
    std::shared_ptr<const PeakPyramid> quickLook(std::shared_ptr<const Spectrogram> spectrogram,
                                                 const NormaliserSettings &settings, const RunContext &context)
    {
        const auto background = estimateBackground(*spectrogram, settings, context, BackgroundDepth::Sketch);
        const NormalisedSpectrogram frames(spectrogram, background, settings);
        const Index all = frames.time().count;
        const double perFrame = spectrogram->windowSamples() * spectrogram->settings().binsPerCell;
        const auto affordable = Index(quickLookSamples / perFrame);
        const Index count = std::min(all, std::clamp(affordable, fewestQuickLookFrames, quickLookFrameLimit));

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

} // namespace

ProgressPublisher::ProgressPublisher(const PictureSink &sink, const Axis &time, const Axis &frequency) : m_sink(sink)
{
    m_pictures.time = time;
    m_pictures.frequency = frequency;
}

void ProgressPublisher::publishQuickLook(std::shared_ptr<const Spectrogram> spectrogram,
                                         const NormaliserSettings &settings, const RunContext &context)
{
    if (!m_sink)
        return;
    m_pictures.quickLook = quickLook(std::move(spectrogram), settings, context);
    m_sink(m_pictures);
}

void ProgressPublisher::publish(const std::shared_ptr<PeakPyramid> &input, const PeakPyramid &statistic)
{
    constexpr std::chrono::milliseconds interval{400};
    const auto now = std::chrono::steady_clock::now();
    if (!m_sink || now - m_last < interval)
        return;
    m_last = now;
    m_pictures.input = input ? std::make_shared<const PeakPyramid>(input->soFar()) : nullptr;
    m_pictures.statistic = std::make_shared<const PeakPyramid>(statistic.soFar());
    m_sink(m_pictures);
}

void ProgressPublisher::publishWhole(std::shared_ptr<const PeakPyramid> input,
                                     std::shared_ptr<const PeakPyramid> statistic)
{
    if (!m_sink)
        return;
    m_pictures.input = std::move(input);
    m_pictures.statistic = std::move(statistic);
    m_sink(m_pictures);
}

} // namespace faintline

#include "frames/NormalisedFrames.h"

#include "frames/Spectrogram.h"

#include <algorithm>

namespace faintline {

double FrameGeometry::likeness() const
{
    return isOfSpectra() ? cellLikeness(sampleWindow(window, windowSamples)) : 1.0;
}

double FrameGeometry::overlap() const
{
    if (!isOfSpectra())
        return 1.0;
    const double scatter = overlapFactor(sampleWindow(window, windowSamples), int(framesPerWindow));
    return scatter * scatter;
}

FrameGeometry NormalisedFrames::geometry() const
{
    FrameGeometry geometry;
    geometry.windowSeconds = m_time.step;
    if (const Spectrogram *of = spectrogram()) {
        geometry.framesPerWindow = double(of->settings().stepsPerWindow);
        geometry.binsPerCell = of->binsPerCell();
        geometry.window = of->settings().window;
        geometry.windowSeconds = of->windowSeconds();
        geometry.windowSamples = of->windowSamples();
        geometry.hopSamples = of->hopSamples();
        geometry.firstSample = of->firstSample();
        geometry.hasRealEnds = of->hasRealEnds();
    }
    return geometry;
}

bool NormalisedFrames::isObserved(Index frame) const
{
    return !spectrogram() || spectrogram()->isObserved(frame);
}

void NormalisedFrames::readPower(Index first, Index count, std::span<float> out, const RunContext &context) const
{
    spectrogram()->read(first, count, out, context);
}

void FrameArray::read(Index first, Index count, std::span<float> out) const
{
    const Index cells = grid().size();
    std::copy_n(m_values.begin() + first * cells, count * cells, out.begin());
}

} // namespace faintline

#include "analyse/usable.h"

#include "base/Error.h"

#include <algorithm>
#include <vector>

namespace faintline {

std::string silenceWords(const Spectrogram &spectrogram, const NoiseBackground &background, const RunContext &context)
{
    const auto isSilent = [](float ln) { return ln <= 0.5f * NoiseBackground::silence; };
    if (!std::all_of(background.lnPower.begin(), background.lnPower.end(), isSilent))
        return {};
    // The background only samples a long recording.
    constexpr Index blockSamples = 1 << 16;
    const Recording &recording = spectrogram.recording();
    const int channel = spectrogram.selection().channel;
    const Index first = spectrogram.firstSample();
    const Index end = first + (spectrogram.time().count - 1) * spectrogram.hopSamples() + spectrogram.windowSamples();
    const Index before = recording.nonFiniteCount();
    std::vector<float> samples(std::size_t(blockSamples * recording.info().floatsPerSample()));
    for (Index at = first; at < end; at += blockSamples) {
        context.checkpoint(0.0, "checking for usable samples");
        recording.read(channel, at, std::min(blockSamples, end - at), samples);
        const auto used = samples.begin() + std::min(blockSamples, end - at) * recording.info().floatsPerSample();
        if (std::any_of(samples.begin(), used, [](float value) { return value != 0.0f; }))
            return {};
    }
    const Index nonFinite = recording.nonFiniteCount() - before;
    const std::string all = "has no usable samples: all of the " + std::to_string(end - first) + " samples read ";
    if (nonFinite >= (end - first) * recording.info().floatsPerSample())
        throw Error(recording.info().path, all + "are not finite in single precision");
    if (nonFinite > 0)
        throw Error(recording.info().path, all + "are 0 or not finite");
    return silenceWords(end - first);
}

std::string silenceWords(Index samples)
{
    return "the recording is silent: all of the " + std::to_string(samples)
           + " samples read are 0 or below 1e-45, the smallest value in single precision";
}

} // namespace faintline

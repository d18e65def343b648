#include "noise/normalise.h"

#include "noise/CausalSpectrogram.h"
#include "noise/NoiseNormaliser.h"

namespace faintline {

NormalisedFramesPointer normalise(std::shared_ptr<const Spectrogram> spectrogram, const NormaliserSettings &settings,
                                  const RunContext &context)
{
    if (settings.causal)
        return std::make_shared<CausalSpectrogram>(std::move(spectrogram), settings);
    const auto background = estimateBackground(*spectrogram, settings, context);
    return std::make_shared<NormalisedSpectrogram>(std::move(spectrogram), background, settings);
}

} // namespace faintline

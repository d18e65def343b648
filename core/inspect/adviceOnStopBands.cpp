#include "inspect/advice.h"

#include "base/numberText.h"

#include <algorithm>
#include <cmath>

namespace faintline {

std::optional<Advice> adviceOnStopBands(const Analysis &analysis)
{
    if (!analysis.background || analysis.background->stopBands.empty() || analysis.settings.noise.causal)
        return {};
    const NoiseBackground &background = *analysis.background;
    const Axis &axis = background.frequency;
    std::string bands;
    double depthDb = background.stopBands.front().depthDb;
    for (const StopBand &band : background.stopBands) {
        bands +=
            (bands.empty() ? "" : " and in ") + formatToStep(std::max(band.lowHz, axis.first), 10.0 * axis.step, 1);
        bands += " … " + formatToStep(std::min(band.highHz, axis.last()), 10.0 * axis.step, 1) + " Hz";
        depthDb = std::min(depthDb, band.depthDb);
    }
    return Advice{"stopBands",
                  "no signal is looked for in " + bands + ": the noise there is " + formatPlainly(std::floor(depthDb))
                      + " dB or more below that beside it and follows its level, as a filter or resampling leaves it; "
                        "select such a band to look there",
                  {},
                  analysis.settings};
}

} // namespace faintline

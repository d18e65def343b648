#include "calibration/fitReset.h"

#include "base/Error.h"
#include "base/Field.h"
#include "calibration/noiseCounts.h"
#include "plan/Calibration.h"

#include <cmath>

namespace faintline {

namespace {

    /// Fraction of states continued, and mean ln K, on one noise field.
    ResetFit measureReset(const NormalisedFrames &noise, const MarkovModel &model, const ResetRule &rule)
    {
        Smd detector(model, rule);
        const auto cells = std::size_t(noise.grid().size());
        const Index frames = noise.time().count;
        std::vector<float> y(cells);
        std::vector<float> statistic(cells);
        double sum = 0.0;
        double sumLnK = 0.0;
        double counted = 0.0;
        for (Index frame = 0; frame < frames; ++frame) {
            noise.read(frame, 1, y);
            detector.update(y, statistic);
            if (frame < settlingFrames)
                continue;
            sum += detector.regulation().continuedFraction;
            sumLnK += detector.regulation().lnK;
            counted += 1.0;
        }
        return {sumLnK / counted, sum / counted};
    }

    ResetFit measureReset(const std::vector<NormalisedFramesPointer> &noise, const MarkovModel &model,
                          const ResetRule &rule)
    {
        ResetFit mean;
        for (const NormalisedFramesPointer &field : noise) {
            const ResetFit fit = measureReset(*field, model, rule);
            mean.lnK += fit.lnK / double(noise.size());
            mean.continuedFraction += fit.continuedFraction / double(noise.size());
        }
        return mean;
    }

    /// ln K at which half of the states continue, by bisection: the fraction increases with K.
    double lnKForHalf(const std::vector<NormalisedFramesPointer> &noise, const MarkovModel &model)
    {
        constexpr double largest = 20.0;
        double low = -largest;
        double high = largest;
        while (high - low > 5e-4) {
            const double middle = 0.5 * (low + high);
            (measureReset(noise, model, {ResetLaw::Fixed, middle}).continuedFraction > 0.5 ? high : low) = middle;
        }
        const double end = low > -largest ? largest : -largest;
        const bool isInside = low > -largest && high < largest;
        const double percent =
            isInside ? 50.0 : 100.0 * measureReset(noise, model, {ResetLaw::Fixed, end}).continuedFraction;
        if (isInside || std::isnan(percent)) // nothing can be measured on a few frames
            return 0.5 * (low + high);
        throw fieldError("model.snr", formatNumber(model.likelihood.snr()),
                         "permits no ln K at which half of the states continue on noise: at " + formatNumber(end)
                             + " nat " + formatNumber(std::round(10.0 * percent) / 10.0) + " % do; choose a "
                             + (end > 0.0 ? "lower" : "higher") + " one");
    }

} // namespace

ResetFit fitReset(const std::vector<NormalisedFramesPointer> &noise, const MarkovModel &model, const SmdSettings &smd)
{
    const bool isFound = smd.reset == SmdSettings::Reset::Calibrated || smd.reset == SmdSettings::Reset::Half;
    const double lnK = isFound ? lnKForHalf(noise, model) : smd.lnK;
    const ResetFit measured = measureReset(noise, model, resetRule(smd, lnK));
    return {smd.reset == SmdSettings::Reset::Mean ? measured.lnK : lnK, measured.continuedFraction};
}

} // namespace faintline

#include "calibrate/CalibrationRequest.h"
#include "calibrate/calibrate.h"
#include "calibrate/constants.h"
#include "calibrate/followTail.h"
#include "frames/Spectrogram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace faintline {

namespace {

    /// What a narrow band's ends leave of the rate at a level.
    double leftAt(const Calibration &wide, const Calibration &narrow, double level)
    {
        return std::exp(narrow.rates.lnRateAt(level) - wide.rates.lnRateAt(level));
    }

    /// The band in which a calibration counts events, which has two ends as well; none if it is a ring.
    std::optional<Index> countedBins(const AnalysisSettings &bare)
    {
        if (bare.family.isSum(channelCount(bare.selection)))
            return {};
        return bare.spectrogram.transformLength(calibrationWindowSamples);
    }

    /// Where the ends of a band do not meet, a band twice as wide loses half of the events; where they do, half of the
    /// logarithm of what is left.
    enum class Ends { Apart, Meeting };

    /// The calibration of a narrow band whose ends remove a `share` of its rate, while those of the band in which the
    /// events were counted have already removed `counted` of it.
    std::shared_ptr<const Calibration> withShareOfEnds(const Calibration &wide, const Calibration &narrow, Ends ends,
                                                       double share, double counted)
    {
        auto result = std::make_shared<Calibration>(narrow);
        RareRates &rates = result->rates;
        for (std::size_t i = 0; i < rates.levels.size(); ++i) {
            const double lnLeft = narrow.rates.lnRates[i] - wide.rates.lnRates[i];
            const double lnOfShare =
                ends == Ends::Meeting ? share * lnLeft : std::log(1.0 - share * (1.0 - std::exp(lnLeft)));
            rates.lnRates[i] = wide.rates.lnRates[i] + lnOfShare - std::log1p(-counted);
            rates.relativeErrors[i] =
                wide.rates.relativeErrors[i] + share * (narrow.rates.relativeErrors[i] - wide.rates.relativeErrors[i]);
        }
        const std::size_t before = rates.levels.size() - std::min<std::size_t>(4, rates.levels.size());
        result->eventRate = std::exp(rates.lnRateAt(result->anchorNats));
        result->relativeError = rates.relativeErrorAt(result->anchorNats);
        result->tailSlope =
            (rates.lnRates[before] - rates.lnRates.back()) / (rates.levels.back() - rates.levels[before]);
        return result;
    }

    /// A wide band's calibration reduced by the effect of a narrow band's ends.
    std::shared_ptr<const Calibration> narrowed(const Calibration &wide, const RareRates &band)
    {
        const RareRates &closed = wide.excursions;
        Calibration narrow = wide;
        narrow.excursions = {};
        RareRates &rates = narrow.rates;
        for (std::size_t i = 0; i < rates.levels.size(); ++i) {
            const double level = rates.levels[i];
            rates.lnRates[i] += std::min(0.0, band.lnRateAt(level) - closed.lnRateAt(level));
            rates.relativeErrors[i] = std::hypot(
                rates.relativeErrors[i], std::hypot(band.relativeErrorAt(level), closed.relativeErrorAt(level)));
        }
        return withShareOfEnds(wide, narrow, Ends::Apart, 1.0, 0.0);
    }

    /// Width of the band that is simulated for a narrower or wider one: steps of √2 below the width from which on the
    /// ends do not meet, so that one simulation serves many simulatedWidths.
    Index simulatedFor(Index bins, Index endsDoNotMeet)
    {
        if (bins < simulatedWidths.front() || bins >= endsDoNotMeet)
            return std::min(bins, endsDoNotMeet);
        return *(std::upper_bound(simulatedWidths.begin(), simulatedWidths.end(), bins) - 1);
    }

} // namespace

std::shared_ptr<const Calibration> makeBandCalibration(const CalibrationRequest &request,
                                                       const CalibrationEffort &effort, const RunContext &context)
{
    const auto wide = calibrate(request.settings, context.part(0.0, 0.6), request.depth);
    if (wide->rates.isEmpty())
        return wide;
    const RareRates band =
        followBand(request.settings, wide->lnK, request.bins, effort.splitting, context.part(0.6, 1.0));
    return band.isEmpty() ? wide : narrowed(*wide, band);
}

std::shared_ptr<const Calibration> calibrateBand(const AnalysisSettings &settings, Index bins,
                                                 const RunContext &context, CalibrationDepth depth)
{
    const bool isMoving = settings.model.motion == Motion::Slopes
                          && (settings.model.lowestSlope != 0.0 || settings.model.highestSlope != 0.0);
    const double steepest = std::max(std::abs(settings.model.lowestSlope), std::abs(settings.model.highestSlope));
    const auto wideEnough = Index(double(wideFromBins) * std::clamp(steepest, 1.0, 4.0));
    // From here on the loss at the ends hardly depends on the width. Narrow bands are as measured with 64 bins.
    const bool isNarrow = bins < wideFromBins;
    const auto endsDoNotMeet = Index(64.0 * (isNarrow ? 1.0 : std::clamp(0.5 * steepest, 1.0, 2.0)));
    if (bins >= wideEnough || !isMoving)
        return calibrate(settings, context, depth);
    auto wide = calibrate(settings, context.part(0.0, 0.6), depth);
    if (wide->rates.isEmpty())
        return wide;
    const AnalysisSettings bare = dimensionless(settings);
    const Index simulated = simulatedFor(bins, endsDoNotMeet);
    const auto narrow = requestedCalibration(
        {bare, wide->isFirstEstimate ? depth : CalibrationDepth::Refined, simulated}, context.part(0.6, 1.0));
    if (bins == simulated || narrow->rates.isEmpty() || *narrow == *wide)
        return narrow;
    const std::optional<Index> counted = isNarrow ? std::nullopt : countedBins(bare);
    const double lost = 1.0 - std::min(1.0, leftAt(*wide, *narrow, wide->anchorNats));
    return withShareOfEnds(*wide, *narrow, simulated < endsDoNotMeet ? Ends::Meeting : Ends::Apart,
                           double(simulated) / double(bins),
                           counted ? lost * double(simulated) / double(*counted) : 0.0);
}

std::shared_ptr<const Calibration> calibrateBand(AnalysisSettings settings, const Spectrogram &spectrogram,
                                                 const RunContext &context, CalibrationDepth depth)
{
    const std::vector<int> channels = channelsOf(spectrogram.selection(), spectrogram.recording().info());
    settings.selection.channels.assign(channels.begin(), channels.end());
    settings.spectrogram.windowSeconds = spectrogram.windowSeconds();
    return calibrateBand(settings, familyAxis(settings.family, spectrogram.frequency()).count, context, depth);
}

} // namespace faintline

#include "plan/Calibration.h"

#include "noise/stopBands.h"
#include "plan/constants.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

double Calibration::eventRateAt(double nats) const
{
    if (!rates.isEmpty())
        return std::exp(rates.lnRateAt(nats));
    return eventRate * std::exp(-tailSlope * (nats - anchorNats));
}

double Calibration::thresholdForEventRate(double eventsPerCellFrame) const
{
    if (rates.isEmpty())
        return anchorNats + std::log(eventRate / eventsPerCellFrame) / tailSlope;
    double low = rates.levels.front() - 100.0 / tailSlope;
    double high = rates.levels.back() + 1000.0 / tailSlope;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (eventRateAt(middle) > eventsPerCellFrame ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double Calibration::rateUncertaintyAt(double nats) const
{
    const double error =
        rates.isEmpty() ? std::hypot(relativeError, (nats - anchorNats) * slopeError) : rates.relativeErrorAt(nats);
    return std::exp(1.96 * error);
}

double Calibration::thresholdUncertainty(double eventsPerCellFrame) const
{
    const double threshold = thresholdForEventRate(eventsPerCellFrame);
    const double slope =
        std::log(eventRateAt(threshold - tailSlopeHalfWidthNats) / eventRateAt(threshold + tailSlopeHalfWidthNats))
        / (2.0 * tailSlopeHalfWidthNats);
    return std::log(rateUncertaintyAt(threshold)) / slope;
}

double Calibration::exceedanceAt(double nats) const
{
    // Simulated down to there, extrapolated with the tail's slope beyond.
    std::size_t last = levelCount() - 1;
    while (last > 0 && exceedance(last) < simulatedExceedance)
        --last;
    if (nats <= level(0))
        return exceedance(0);
    if (nats >= level(last))
        return exceedance(last) * eventRateAt(nats)
               / eventRateAt(level(last)); // time above a level per event is nearly constant
    const double position = (nats - level(0)) / (level(1) - level(0));
    const std::size_t lower = std::min(std::size_t(position), last - 1);
    const double fraction = position - double(lower);
    return std::exp((1.0 - fraction) * std::log(exceedance(lower)) + fraction * std::log(exceedance(lower + 1)));
}

double Calibration::thresholdForPfa(double probability) const
{
    double low = level(0);
    double high = level(levelCount() - 1) + 1000.0 / tailSlope;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (exceedanceAt(middle) > probability ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double Calibration::levelExceededBy(double probability) const
{
    if (above.empty())
        return -std::numeric_limits<double>::infinity();
    std::size_t number = 0;
    while (number + 1 < levelCount() && exceedance(number) > probability)
        ++number;
    return level(number);
}

double thresholdNats(const DecideSettings &decide, const Calibration &calibration, double cellFramesPerHour)
{
    switch (decide.by) {
    case DecideSettings::By::FalseAlarmsPerHour:
        return calibration.thresholdForEventRate(decide.falseAlarmsPerHour / cellFramesPerHour);
    case DecideSettings::By::PfaPerCell:
        return calibration.thresholdForPfa(decide.pfaPerCell);
    case DecideSettings::By::Nats:
        break;
    }
    return decide.thresholdNats;
}

std::vector<StopBand> bandsNotSearched(const AnalysisSettings &settings, const Spectrogram &spectrogram)
{
    return settings.noise.causal ? std::vector<StopBand>() : stopBands(spectrogram);
}

double cellFramesInAnHour(const AnalysisSettings &settings, const Spectrogram &spectrogram)
{
    Index cells = familyAxis(settings.family, spectrogram.frequency()).count;
    if (settings.family.isNone())
        for (const StopBand &band : bandsNotSearched(settings, spectrogram)) {
            const auto [first, end] = cellsIn(band, spectrogram.frequency());
            cells -= end - first;
        }
    return double(cells) * 3600.0 / spectrogram.time().step;
}

ResetRule resetRule(const SmdSettings &settings, double lnK)
{
    switch (settings.reset) {
    case SmdSettings::Reset::Calibrated:
    case SmdSettings::Reset::Fixed:
        return {ResetLaw::Fixed, lnK};
    case SmdSettings::Reset::Half:
        return {ResetLaw::Half, lnK};
    case SmdSettings::Reset::Mean:
        return {ResetLaw::Mean};
    }
    return {};
}

FrameGeometry frameGeometry(const SpectrogramSettings &settings)
{
    return {double(settings.stepsPerWindow), double(settings.binsPerCell)};
}

} // namespace faintline

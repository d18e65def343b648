#include "plan/firstSettings.h"

namespace faintline {

AnalysisSettings firstSettings(const Grid &grid)
{
    if (grid.isSpectrum())
        return {};
    return preset(grid.isSurface() ? "sonar" : "radar").settings;
}

AnalysisSettings firstSettings(const RecordingInfo &recording)
{
    return withFittedOrder({}, recording);
}

AnalysisSettings withFittedOrder(AnalysisSettings settings, const RecordingInfo &recording)
{
    const DecideSettings usual;
    DecideSettings &decide = settings.decide;
    const double hours = recording.durationSeconds() / 3600.0;
    if (recording.sampleRateHz < 1.0 && hours * usual.falseAlarmsPerHour > 1.0
        && decide.by == DecideSettings::By::FalseAlarmsPerHour && decide.falseAlarmsPerHour == usual.falseAlarmsPerHour)
        decide.falseAlarmsPerHour = 1.0 / hours;
    return settings;
}

} // namespace faintline

#include "analysis/keptCalibration.h"

#include "analysis/CalibrationStore.h"
#include "analysis/calibrateOn.h"
#include "analysis/knownCalibration.h"
#include "base/Field.h"

#include <map>
#include <mutex>

namespace faintline {

DecideSettings withoutThreshold(DecideSettings decide)
{
    const DecideSettings defaults;
    decide.falseAlarmsPerHour = defaults.falseAlarmsPerHour;
    decide.pfaPerCell = defaults.pfaPerCell;
    decide.thresholdNats = defaults.thresholdNats;
    decide.by = defaults.by;
    return decide;
}

AnalysisSettings dimensionless(AnalysisSettings settings)
{
    settings.selection = {};
    settings.decide = withoutThreshold(settings.decide);
    settings.conventional = {};
    settings.track.bothWays = TrackSettings{}.bothWays; // works on what was found
    if (settings.spectrogram.windowSeconds > 0.0)
        settings.family = scaledFamily(settings.family, settings.spectrogram.windowSeconds / calibrationWindowSamples);
    settings.spectrogram.windowSeconds = calibrationWindowSamples;
    return settings;
}

std::string calibrationKey(const AnalysisSettings &bare, CalibrationDepth depth)
{
    return settingsToJson(bare) + formatNumber(effortOf(depth).cellFrames);
}

std::shared_ptr<const Calibration> keptCalibration(const std::string &key,
                                                   const std::function<std::shared_ptr<const Calibration>()> &make)
{
    static std::mutex mutex;
    static std::map<std::string, std::shared_ptr<const Calibration>> known;
    {
        const std::scoped_lock lock(mutex);
        if (const auto found = known.find(key); found != known.end())
            return found->second;
    }
    const CalibrationStore store(CalibrationStore::usualFolder());
    auto made = store.load(key);
    if (!made) {
        made = make();
        if (!made)
            return nullptr;
        store.save(key, *made);
    }
    const std::scoped_lock lock(mutex);
    return known.emplace(key, std::move(made)).first->second;
}

std::shared_ptr<const Calibration> knownCalibration(const AnalysisSettings &settings)
{
    return keptCalibration(calibrationKey(dimensionless(settings), CalibrationDepth::Refined), [] { return nullptr; });
}

} // namespace faintline

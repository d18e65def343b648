#include "calibration/keptCalibration.h"

#include "base/Field.h"
#include "calibration/CalibrationStore.h"
#include "calibration/calibrateOn.h"
#include "calibration/knownCalibration.h"

#include <chrono>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <string_view>
#include <thread>

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

namespace {

    SelectionSettings onlyCounted(const SelectionSettings &selection)
    {
        SelectionSettings counted;
        if (const std::vector<double> &channels = selection.channels; channels.size() > 1) {
            counted.channels.resize(channels.size());
            std::iota(counted.channels.begin(), counted.channels.end(), 0.0);
        } else if (channels == std::vector{-1.0}) {
            counted.channels = channels;
        }
        return counted;
    }

} // namespace

AnalysisSettings dimensionless(AnalysisSettings settings)
{
    settings.selection = onlyCounted(settings.selection);
    settings.decide = withoutThreshold(settings.decide);
    settings.conventional = {};
    settings.noise.blankDc = NormaliserSettings{}.blankDc;
    settings.track.bothWays = TrackSettings{}.bothWays; // applies after detection
    if (settings.spectrogram.windowSeconds > 0.0)
        settings.family = scaledFamily(settings.family, settings.spectrogram.windowSeconds / calibrationWindowSamples);
    settings.spectrogram.windowSeconds = calibrationWindowSamples;
    return settings;
}

std::string calibrationKey(const AnalysisSettings &bare, CalibrationDepth depth)
{
    return settingsToJson(bare) + formatNumber(effortOf(depth).cellFrames);
}

namespace {

    using Made = std::shared_ptr<const Calibration>;

    /// This program's cache entry of one key.
    struct Entry {
        std::mutex making; ///< held by the thread that makes it
        std::mutex guard;
        Made made;
    };

    Entry &entryOf(const std::string &key)
    {
        static std::mutex guard;
        static std::map<std::string, Entry> entries;
        const std::scoped_lock lock(guard);
        return entries[key];
    }

    /// From memory or from disk; null if it must be made.
    Made known(Entry &entry, const std::string &key, const CalibrationStore &store)
    {
        const std::scoped_lock lock(entry.guard);
        if (!entry.made)
            entry.made = store.load(key);
        return entry.made;
    }

    using Clock = std::chrono::steady_clock;

    /// Waits until `isSo`, or until `end`.
    template <class Condition>
    void waitUntil(Condition isSo, Clock::time_point end, std::string_view what, const RunContext &context)
    {
        while (!isSo() && Clock::now() < end) {
            context.checkpoint(0.0, what);
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }

} // namespace

std::shared_ptr<const Calibration> keptCalibration(const std::string &key, const std::function<Made()> &make,
                                                   const RunContext &context)
{
    const CalibrationStore store(CalibrationStore::usualFolder());
    Entry &entry = entryOf(key);
    if (Made made = known(entry, key, store))
        return made;
    std::unique_lock making(entry.making, std::defer_lock);
    waitUntil([&] { return making.try_lock(); }, Clock::time_point::max(), "waiting for the calibration", context);
    std::optional<CalibrationLock> lock;
    const Clock::time_point end = Clock::now() + std::chrono::minutes(2); // another program may have been suspended
    waitUntil([&] { return store.lock(lock, key); }, end, "waiting for another program's calibration", context);
    if (Made made = known(entry, key, store))
        return made;
    Made made = make();
    if (!made)
        return nullptr;
    store.save(key, *made);
    const std::scoped_lock keeping(entry.guard);
    if (!entry.made)
        entry.made = std::move(made);
    return entry.made;
}

std::shared_ptr<const Calibration> knownCalibration(const AnalysisSettings &settings)
{
    const std::string key = calibrationKey(dimensionless(settings), CalibrationDepth::Refined);
    return known(entryOf(key), key, CalibrationStore(CalibrationStore::usualFolder()));
}

} // namespace faintline

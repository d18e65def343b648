#include "calibrate/keptCalibration.h"

#include "calibrate/CalibrationStore.h"

#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>

namespace faintline {

namespace {

    using Made = std::shared_ptr<const Calibration>;
    using Clock = std::chrono::steady_clock;

    /// This program's cache entry of one key.
    struct CacheEntry {
        std::mutex making; ///< held by the thread that makes it
        std::mutex guard;
        Made made;
    };

    CacheEntry &entryOf(const std::string &key)
    {
        static std::mutex guard;
        static std::map<std::string, CacheEntry> entries;
        const std::scoped_lock lock(guard);
        return entries[key];
    }

    /// From memory or from disk; null if it must be made.
    Made known(CacheEntry &entry, const std::string &key, const CalibrationStore &store)
    {
        const std::scoped_lock lock(entry.guard);
        if (!entry.made)
            entry.made = store.load(key);
        return entry.made;
    }

    template <class Condition>
    void waitUntil(Condition isSo, std::string_view what, const RunContext &context)
    {
        while (!isSo()) {
            context.checkpoint(0.0, what);
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }

    /// Whether another program still works on a key: its signs of life have not stopped.
    class OthersWork
    {
    public:
        OthersWork(const CalibrationStore &store, const std::string &key, std::chrono::milliseconds silence)
            : m_store(store), m_key(key), m_silence(silence)
        {
        }

        bool goesOn()
        {
            const auto sign = m_store.lastSign(m_key);
            if (sign != m_sign) {
                m_sign = sign;
                m_since = Clock::now();
            }
            return Clock::now() - m_since < m_silence;
        }

    private:
        const CalibrationStore &m_store;
        const std::string &m_key;
        std::chrono::milliseconds m_silence;
        std::filesystem::file_time_type m_sign{};
        Clock::time_point m_since = Clock::now();
    };

    /// The same context, whose checkpoints are signs of life.
    RunContext withSigns(const RunContext &context, const std::optional<CalibrationLock> &lock)
    {
        RunContext making = context;
        making.progress = [&lock, outer = context.progress](double fraction, std::string_view what) {
            if (lock)
                lock->giveSign();
            if (outer)
                outer(fraction, what);
        };
        return making;
    }

} // namespace

std::shared_ptr<const Calibration> keptCalibration(const std::string &key,
                                                   const std::function<Made(const RunContext &)> &make,
                                                   const RunContext &context, std::chrono::milliseconds silence)
{
    const CalibrationStore store(CalibrationStore::usualFolder());
    CacheEntry &entry = entryOf(key);
    if (Made made = known(entry, key, store))
        return made;
    std::unique_lock making(entry.making, std::defer_lock);
    waitUntil([&] { return making.try_lock(); }, "waiting for the calibration", context);
    std::optional<CalibrationLock> lock;
    OthersWork others(store, key, silence);
    waitUntil([&] { return store.lock(lock, key) || !others.goesOn(); }, "waiting for another program's calibration",
              context);
    if (Made made = known(entry, key, store))
        return made;
    Made made = make(withSigns(context, lock));
    if (!made)
        return nullptr;
    store.save(key, *made);
    const std::scoped_lock keeping(entry.guard);
    if (!entry.made)
        entry.made = std::move(made);
    return entry.made;
}

std::shared_ptr<const Calibration> cachedCalibration(const std::string &key)
{
    return known(entryOf(key), key, CalibrationStore(CalibrationStore::usualFolder()));
}

void rememberCalibration(const std::string &key, std::shared_ptr<const Calibration> calibration)
{
    CacheEntry &entry = entryOf(key);
    const std::scoped_lock lock(entry.guard);
    entry.made = std::move(calibration);
}

} // namespace faintline

#include "calibrate/CalibrationStore.h"
#include "support/test.h"

#include "base/files/AtomicFile.h"
#include "calibrate/keptCalibration.h"

#include <atomic>
#include <thread>

using namespace faintline;
namespace fs = std::filesystem;

namespace {

Calibration sample()
{
    Calibration c;
    c.lnK = 0.1 + 0.2; // no short decimal form
    c.continuedFraction = 1.0 / 3.0;
    c.anchorNats = 5e-324;
    c.eventRate = 6.02214076e-23;
    c.tailSlope = 0.7;
    c.relativeError = 1e-3 / 7.0;
    c.slopeError = 1e300;
    c.rates = {{1.0, 2.0}, {-1.5, -1.0 / 3.0}, {0.1, 0.2}};
    c.excursions = {{1.0, 3.0}, {-2.5, -1.0 / 7.0}, {0.0, 0.3}};
    c.lowestLevel = -2.0 / 3.0;
    c.levelStep = 0.25;
    c.cells = 3.0;
    c.above = {3.0, 2.0, 1e-17};
    return c;
}

} // namespace

/// Calibrations on disk: what is read back is what was written, and nothing that could be wrong is read back.
class tst_CalibrationStore : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void readsBackEveryBit()
    {
        const CalibrationStore store(folder() / "not" / "yet");
        QVERIFY(!store.load("a"));
        store.save("a", sample());
        const auto read = store.load("a");
        QVERIFY(read && *read == sample());
    }

    void keysDoNotMix()
    {
        const CalibrationStore store(folder());
        Calibration other = sample();
        other.lnK = -1.0;
        store.save("a", sample());
        store.save("b", other);
        QVERIFY(*store.load("a") == sample() && *store.load("b") == other);
        // Another key's file under this key's name, as if their hashes were the same.
        fs::copy_file(store.fileFor("b"), store.fileFor("a"), fs::copy_options::overwrite_existing);
        QVERIFY(!store.load("a"));
    }

    void damagedFilesDoNotCount_data()
    {
        QTest::addColumn<QByteArray>("before");
        QTest::addColumn<QByteArray>("after");
        QTest::newRow("another version") << QByteArray("\"version\":") << QByteArray("\"version\":9");
        QTest::newRow("a member is missing") << QByteArray("\"tailSlope\"") << QByteArray("\"tail\"");
        QTest::newRow("a text for a number") << QByteArray("\"tailSlope\":0.7") << QByteArray("\"tailSlope\":\"0.7\"");
        QTest::newRow("null for a number") << QByteArray("\"tailSlope\":0.7") << QByteArray("\"tailSlope\":null");
        QTest::newRow("a slope that cannot be") << QByteArray("\"tailSlope\":0.7") << QByteArray("\"tailSlope\":-0.7");
        QTest::newRow("another number") << QByteArray("\"tailSlope\":0.7") << QByteArray("\"tailSlope\":0.9");
        QTest::newRow("lengths differ") << QByteArray("\"lnRates\":[-1.5,") << QByteArray("\"lnRates\":[");
        QTest::newRow("levels that cannot be") << QByteArray("\"levelStep\":0.25") << QByteArray("\"levelStep\":-0.25");
        QTest::newRow("no JSON") << QByteArray("{") << QByteArray("");
        QTest::newRow("an array") << QByteArray("{\"version\"") << QByteArray("[{\"version\"");
    }

    void damagedFilesDoNotCount()
    {
        QFETCH(QByteArray, before);
        QFETCH(QByteArray, after);
        const CalibrationStore store(folder());
        store.save("a", sample());
        QFile file(QString::fromStdString(store.fileFor("a").string()));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QByteArray text = file.readAll();
        file.close();
        const auto position = text.indexOf(before);
        QVERIFY(position >= 0);
        text.replace(position, before.size(), after);
        writeTextFile(store.fileFor("a").string(), text.toStdString());
        QVERIFY(!store.load("a"));
        writeTextFile(store.fileFor("a").string(), "");
        QVERIFY(!store.load("a"));
        store.save("a", sample()); // and is replaced by a sound one
        QVERIFY(store.load("a"));
    }

    void foldersThatCannotBe()
    {
        writeTextFile((folder() / "file").string(), "not a folder");
        for (const fs::path &where :
             {fs::path(), folder() / "file", folder() / "file" / "below", fs::path("/dev/null")}) {
            const CalibrationStore store(where);
            store.save("a", sample());
            QVERIFY(!store.load("a"));
        }
    }

    void oldestFilesGo()
    {
        const CalibrationStore store(folder());
        store.save("first", sample());
        const auto longAgo = fs::last_write_time(store.fileFor("first")) - std::chrono::hours(1);
        fs::last_write_time(store.fileFor("first"), longAgo);
        writeTextFile((folder() / "someone else's").string(), "");
        fs::last_write_time(folder() / "someone else's", longAgo);
        for (std::size_t i = 0; i < CalibrationStore::largestFileCount; ++i)
            store.save(std::to_string(i), sample());
        QVERIFY(!store.load("first"));
        QVERIFY(store.load("0") && fs::exists(folder() / "someone else's"));
        QCOMPARE(std::distance(fs::directory_iterator(folder()), fs::directory_iterator()),
                 std::ptrdiff_t(CalibrationStore::largestFileCount + 1));
    }

    void theEnvironmentDecides()
    {
        const auto set = [](const char *name, const char *value) { value ? qputenv(name, value) : qunsetenv(name); };
        const QByteArray before[]{qgetenv("FAINTLINE_CACHE"), qgetenv("XDG_CACHE_HOME"), qgetenv("HOME")};
        set("HOME", "/home/someone");
        set("XDG_CACHE_HOME", nullptr);
        set("FAINTLINE_CACHE", nullptr);
        QCOMPARE(CalibrationStore::usualFolder(), fs::path("/home/someone/.cache/faintline"));
        set("XDG_CACHE_HOME", "relative"); // does not count, by the XDG specification
        QCOMPARE(CalibrationStore::usualFolder(), fs::path("/home/someone/.cache/faintline"));
        set("XDG_CACHE_HOME", "/cache");
        QCOMPARE(CalibrationStore::usualFolder(), fs::path("/cache/faintline"));
        set("FAINTLINE_CACHE", "/elsewhere");
        QCOMPARE(CalibrationStore::usualFolder(), fs::path("/elsewhere"));
        set("FAINTLINE_CACHE", "off");
        QCOMPARE(CalibrationStore::usualFolder(), fs::path());
        set("FAINTLINE_CACHE", nullptr);
        set("XDG_CACHE_HOME", nullptr);
        set("HOME", nullptr);
        QCOMPARE(CalibrationStore::usualFolder(), fs::path());
        const char *names[]{"FAINTLINE_CACHE", "XDG_CACHE_HOME", "HOME"};
        for (std::size_t i = 0; i < 3; ++i)
            set(names[i], before[i].isNull() ? nullptr : before[i].constData());
    }

    void oneHoldsTheLock()
    {
        const CalibrationStore store(folder());
        std::optional<CalibrationLock> first;
        std::optional<CalibrationLock> second;
        QVERIFY(store.lock(first, "a"));
        QVERIFY(!store.lock(second, "a"));
        second.reset(); // takes nothing from who holds it
        QVERIFY(!store.lock(second, "a"));
        std::optional<CalibrationLock> other;
        QVERIFY(store.lock(other, "b"));
        first.reset();
        QVERIFY(store.lock(second, "a"));
        second.reset();
        other.reset();
        QVERIFY(fs::is_empty(folder()));
        QVERIFY(CalibrationStore({}).lock(first, "a")); // without a folder there is nothing to wait for
        QVERIFY(CalibrationStore("/dev/null").lock(first, "a"));
    }

    void oneMakesWhatManyWant_data()
    {
        QTest::addColumn<QByteArray>("cache");
        QTest::newRow("kept") << QByteArray("in a folder");
        QTest::newRow("not kept") << QByteArray("off");
    }

    void oneMakesWhatManyWant()
    {
        QFETCH(QByteArray, cache);
        qputenv("FAINTLINE_CACHE", cache == "off" ? cache : m_folder->path().toUtf8());
        const std::string key = "wanted by many, " + cache.toStdString();
        std::atomic<int> made = 0;
        std::atomic<int> right = 0;
        {
            std::vector<std::jthread> threads;
            for (int i = 0; i < 6; ++i)
                threads.emplace_back([&] {
                    const auto make = [&](const RunContext &) -> std::shared_ptr<const Calibration> {
                        if (++made == 1) {
                            std::this_thread::sleep_for(std::chrono::milliseconds(50));
                            throw Cancelled(); // and so the next one makes it
                        }
                        return std::make_shared<const Calibration>(sample());
                    };
                    try {
                        right += *keptCalibration(key, make, {}) == sample() ? 1 : 0;
                    } catch (const Cancelled &) {
                    }
                });
        }
        QCOMPARE(made.load(), 2);
        QCOMPARE(right.load(), 5);
    }

    void whoWaitsCanBeStopped()
    {
        qputenv("FAINTLINE_CACHE", m_folder->path().toUtf8());
        const CalibrationStore store(folder());
        std::optional<CalibrationLock> another; // program
        QVERIFY(store.lock(another, "stopped"));
        std::stop_source stop;
        RunContext context;
        context.stop = stop.get_token();
        bool isCancelled = false;
        std::jthread waiting([&] {
            try {
                keptCalibration(
                    "stopped", [](const RunContext &) { return std::make_shared<const Calibration>(sample()); },
                    context);
            } catch (const Cancelled &) {
                isCancelled = true;
            }
        });
        std::this_thread::sleep_for(std::chrono::milliseconds(60));
        stop.request_stop();
        waiting.join();
        QVERIFY(isCancelled);
    }

    // Another program, longer at work than a silent one is waited for, but its checkpoints are heard.
    void waitsWhileAnotherWorks()
    {
        constexpr std::chrono::milliseconds silence{300};
        const CalibrationStore store(folder());
        std::optional<CalibrationLock> another;
        QVERIFY(store.lock(another, "at work"));
        std::jthread working([&] {
            for (int i = 0; i < 40; ++i) {
                another->giveSign();
                std::this_thread::sleep_for(silence / 10);
            }
            Calibration others = sample();
            others.lnK = 7.0;
            store.save("at work", others);
            another.reset();
        });
        qputenv("FAINTLINE_CACHE", m_folder->path().toUtf8());
        const auto found = keptCalibration(
            "at work", [](const RunContext &) { return std::make_shared<const Calibration>(sample()); }, {}, silence);
        QCOMPARE(found->lnK, 7.0);
    }

    // One that was suspended holds the lock as well.
    void stopsWaitingForASilentProgram()
    {
        const CalibrationStore store(folder());
        std::optional<CalibrationLock> another;
        QVERIFY(store.lock(another, "silent"));
        qputenv("FAINTLINE_CACHE", m_folder->path().toUtf8());
        const auto found = keptCalibration(
            "silent", [](const RunContext &) { return std::make_shared<const Calibration>(sample()); }, {},
            std::chrono::milliseconds(100));
        QVERIFY(*found == sample());
    }

private:
    fs::path folder() const { return m_folder->path().toStdString(); }

    std::unique_ptr<QTemporaryDir> m_folder;
};

FAINTLINE_TEST(tst_CalibrationStore)
#include "tst_CalibrationStore.moc"

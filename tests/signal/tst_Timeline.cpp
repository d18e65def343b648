#include "signal/Timeline.h"
#include "support/test.h"

#include "base/Error.h"
#include "signal/openRecording.h"
#include "signal/timeInName.h"
#include "support/errors.h"
#include "support/recordings.h"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <thread>

using namespace faintline;
using namespace faintline::test;

namespace {

const double newYear = 1767225600.0; // 2026-01-01

/// A letter a sample, a dot where there is 0.
QByteArray lettersOf(const Recording &recording)
{
    QByteArray heard;
    for (const float value : readAll(recording))
        heard.append(value == 0.0f ? '.' : static_cast<char>(std::lround(value * 128.0f)));
    return heard;
}

/// Files of a recorder that writes `samples` a file at `trueHz`, says `saidHz`, and stamps to `resolution` seconds.
std::vector<TimedFile> filesOf(int count, Index samples, double trueHz, double saidHz, double resolution)
{
    std::vector<TimedFile> files;
    for (int i = 0; i < count; ++i) {
        const double exact = newYear + double(i) * double(samples) / trueHz;
        files.push_back({"file" + std::to_string(i), std::floor(exact / resolution) * resolution, saidHz, samples});
    }
    return files;
}

} // namespace

/// Many files as one recording: times in names, the clock of the stamps, gaps and overlaps.
class tst_Timeline : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void timesInNames_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<double>("expected"); // 0: none
        const double time = 1769212799.0;     // 2026-01-23T23:59:59Z
        QTest::newRow("AudioMoth") << "20260123_235959.WAV" << time;
        QTest::newRow("behind a site") << "/data/19991231_000000/SITE-A_20260123_235959.wav" << time;
        QTest::newRow("ISO") << "2026-01-23T23:59:59Z.flac" << time;
        QTest::newRow("ISO without colons") << "x 2026-01-23 23-59-59.flac" << time;
        QTest::newRow("zone") << "20260124T005959+0100_REC.wav" << time;
        QTest::newRow("milliseconds") << "20260123T235959.250Z.wav" << time + 0.25;
        QTest::newRow("milliseconds behind a line") << "SITE_20260123_235959_250.wav" << time + 0.25;
        QTest::newRow("milliseconds behind a hyphen") << "2026-01-23T23-59-59-250Z_x.wav" << time + 0.25;
        QTest::newRow("a rate behind the second") << "20260123_235959_192kHz.wav" << time;
        QTest::newRow("a zone behind a hyphen") << "20260123T195959-0400.wav" << time;
        QTest::newRow("gqrx") << "gqrx_20260123_235959_137500_48000_fc.raw" << time;
        QTest::newRow("kiwirecorder") << "20260123T235959Z_7050000_iq.wav" << time;
        QTest::newRow("14 digits") << "rec20260123235959.wav" << time;
        QTest::newRow("SoundTrap") << "5678.260123235959.wav" << time;
        QTest::newRow("HARP") << "SOCAL_disk01_260123_235959.x.wav" << time;
        QTest::newRow("unix") << "ch0_1769212799.wav" << time;
        QTest::newRow("unix milliseconds") << "1769212799500.cf32" << time + 0.5;
        QTest::newRow("SDR++") << "baseband_1420405751Hz_23-59-59_23-01-2026.wav" << time;
        QTest::newRow("a frequency") << "line_1420405751Hz.wav" << 0.0;
        QTest::newRow("leap day") << "20240229_000000.wav" << 1709164800.0;
        QTest::newRow("no such day") << "20260230_000000.wav" << 0.0;
        QTest::newRow("no such hour") << "20260123_245959.wav" << 0.0;
        QTest::newRow("a day only") << "20260123.wav" << 0.0;
        QTest::newRow("a number") << "recording 12.wav" << 0.0;
        QTest::newRow("long ago") << "19690101_000000.wav" << 0.0;
        QTest::newRow("many digits") << "202601232359591234567890.wav" << 0.0;
    }

    void timesInNames()
    {
        QFETCH(QString, name);
        QFETCH(double, expected);
        QCOMPARE(timeInName(name.toStdString()).value_or(0.0), expected);
    }

    void receiversNames_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("program"); // empty: none
        QTest::addColumn<double>("centre");
        QTest::addColumn<double>("rate");
        QTest::addColumn<QString>("type");
        const auto row = [](const char *name, const char *program = "", double centre = 0.0, double rate = 0.0,
                            const char *type = "") {
            QTest::newRow(name) << QString(name) << QString(program) << centre << rate << QString(type);
        };
        row("gqrx_20260123_235959_100000000_2000000_fc.raw", "gqrx", 1e8, 2e6, "cf32_le");
        row("/night/gqrx_20260123_235959_1420405751_240000_fc.raw", "gqrx", 1420405751.0, 240000.0, "cf32_le");
        row("SDRSharp_20260123_235959Z_100000000Hz_IQ.wav", "SDRSharp", 1e8);
        row("HDSDR_20260123_235959Z_7100kHz_RF.wav", "HDSDR", 7.1e6);
        row("SDRuno_20260123_235959Z_7100kHz.wav", "SDRuno", 7.1e6);
        row("baseband_433920000Hz_23-59-59_23-01-2026.wav", "SDR++", 433.92e6);
        row("HDSDR_20260123_235959Z_7100kHz_AF.wav");
        row("SDRSharp_20260123_235959Z_100000000Hz_AF.wav");
        row("audio_433920000Hz_23-59-59_23-01-2026.wav");
        row("gqrx_20260123_235959_100000000.wav");
        row("gqrx_20260123_235959_100000000_0_fc.raw");
        row("2026_7100kHz.wav");
    }

    void receiversNames()
    {
        QFETCH(QString, name);
        QFETCH(QString, program);
        const std::optional<ReceiverName> said = receiverName(name.toStdString());
        QCOMPARE(said.has_value(), !program.isEmpty());
        if (!said)
            return;
        QCOMPARE(QString::fromStdString(said->program), program);
        QTEST(said->centreHz, "centre");
        QTEST(said->rateHz, "rate");
        QTEST(QString::fromStdString(said->rawType), "type");
    }

    void weeksOfGps()
    {
        const double gps = 1453248018.0; // 2026-01-24T00:00:00Z: 18 leap seconds
        QCOMPARE(unixFromGps(gps), 1769212800.0);
        for (const double about : {-80000.0, 0.0, 3.0, 250000.0})
            QCOMPARE(unixFromGpsWeekSecond(std::fmod(gps, 604800.0), 1769212800.0 + about), 1769212800.0);
    }

    void filesThatFollowOn()
    {
        std::vector<TimedFile> files = filesOf(10, 48000 * 60, 48000.0, 48000.0, 1e-6);
        std::reverse(files.begin(), files.end());
        const Alignment aligned = alignFiles(files);
        QCOMPARE(aligned.rateHz, 48000.0);
        QCOMPARE(aligned.startUnixSeconds, newYear);
        for (std::size_t i = 0; i < 10; ++i) {
            QCOMPARE(aligned.places[i].file, 9 - i);
            QCOMPARE(aligned.places[i].inTime, Index(i) * 48000 * 60);
            QCOMPARE(aligned.places[i].count, Index(48000 * 60));
        }
        QCOMPARE(aligned.notes.size(), std::size_t(1));
    }

    // A crystal that is 37 ppm fast, hour after hour of a day: the rate of the stamps is the true one.
    void clockThatIsOff()
    {
        const double trueHz = 48000.0 * (1.0 + 37e-6);
        const Alignment aligned = alignFiles(filesOf(24, Index(48000) * 3600, trueHz, 48000.0, 1e-6));
        QVERIFY2(std::abs(aligned.rateHz / trueHz - 1.0) < 1e-9, qPrintable(QString::number(aligned.rateHz, 'g', 12)));
        QCOMPARE(aligned.places.back().inTime, Index(23) * 48000 * 3600);
        QVERIFY(aligned.notes.at(1).find("off by 37 ppm") != std::string::npos);
    }

    // Names tell whole seconds: files still follow on, and over a day the rate is known to a millionth.
    void stampsOfWholeSeconds()
    {
        const double trueHz = 48000.0 * (1.0 - 52e-6);
        const Alignment day = alignFiles(filesOf(1440, Index(48000) * 60, trueHz, 48000.0, 1.0));
        QVERIFY2(std::abs(day.rateHz / trueHz - 1.0) < 1e-6, qPrintable(QString::number(day.rateHz, 'g', 12)));
        QCOMPARE(day.places.back().inTime, Index(1439) * 48000 * 60);
        const Alignment minutes = alignFiles(filesOf(3, Index(48000) * 60, trueHz, 48000.0, 1.0));
        QCOMPARE(minutes.rateHz, 48000.0); // too short to tell
        QCOMPARE(minutes.places.back().inTime, Index(2) * 48000 * 60);
    }

    // Whole seconds that are exact leave a gap of four fifths of a second one.
    void exactStamps()
    {
        for (const bool isExact : {false, true}) {
            const Alignment aligned =
                alignFiles({{"a", newYear, 100.0, 120, isExact}, {"b", newYear + 2.0, 100.0, 120, isExact}});
            QCOMPARE(aligned.startUnixSeconds, isExact ? newYear : newYear + 0.4);
            QCOMPARE(aligned.places[1].inTime, Index(isExact ? 200 : 120));
        }
    }

    void pausesAreNoClockError_data()
    {
        QTest::addColumn<int>("count");
        QTest::addColumn<double>("lasts");    // of a file, s
        QTest::addColumn<double>("interval"); // between the beginnings of files
        QTest::addColumn<double>("resolution");
        QTest::addColumn<double>("delay"); // of stamps, at most
        for (const int count : {2, 3, 6, 200})
            QTest::addRow("a second a minute, %d files", count) << count << 59.0 << 60.0 << 1.0 << 0.0;
        for (const int count : {2, 3, 12, 200})
            QTest::addRow("half a second, %d files", count) << count << 10.0 << 10.5 << 1.0 << 0.0;
        QTest::newRow("a second in five minutes") << 5 << 300.0 << 301.0 << 1.0 << 0.0;
        QTest::newRow("a second an hour, two files") << 2 << 3599.0 << 3600.0 << 1.0 << 0.0;
        QTest::newRow("a second an hour") << 24 << 3599.0 << 3600.0 << 1.0 << 0.0;
        QTest::newRow("two and a half seconds") << 30 << 57.5 << 60.0 << 1.0 << 0.0;
        QTest::newRow("overlaps") << 5 << 60.0 << 59.0 << 1.0 << 0.0;
        QTest::newRow("late whole seconds") << 40 << 59.0 << 60.0 << 1.0 << 0.95;
        QTest::newRow("milliseconds") << 6 << 59.0 << 60.0 << 0.001 << 0.0;
        QTest::newRow("8 ms") << 20 << 1.0 << 1.008 << 0.001 << 0.0;
        QTest::newRow("8 ms, two files") << 2 << 1.0 << 1.008 << 0.001 << 0.0;
        QTest::newRow("late milliseconds") << 40 << 59.0 << 60.0 << 0.001 << 0.02;
    }

    // A recorder that pauses, or begins the next file early: the rate stays, and files lie where they were heard.
    void pausesAreNoClockError()
    {
        QFETCH(int, count);
        QFETCH(double, lasts);
        QFETCH(double, interval);
        QFETCH(double, resolution);
        QFETCH(double, delay);
        constexpr double rate = 200.0;
        std::vector<TimedFile> files;
        for (int i = 0; i < count; ++i) {
            const double begin = newYear + 0.1 + i * interval + delay * std::abs(std::sin(2.4 * i));
            files.push_back(
                {std::to_string(i), std::floor(begin / resolution) * resolution, rate, std::llround(lasts * rate)});
        }
        const Alignment aligned = alignFiles(files);
        QCOMPARE(aligned.rateHz, rate);
        Index heard = 0;
        for (int i = 0; i < count; ++i) {
            const PlacedFile &place = aligned.places.at(std::size_t(i));
            const double wrong = double(place.inTime - place.skipped) / rate - i * interval;
            QVERIFY2(std::abs(wrong) <= std::max(resolution, 0.01) + delay, qPrintable(QString::number(wrong)));
            QVERIFY(place.inTime >= heard);
            heard = place.inTime + place.count;
        }
        const double missing = (count - 1) * (interval - lasts);
        if (resolution == 1.0 && std::abs(missing) >= 1.0)
            QVERIFY(aligned.notes.back().find("uncertain by up to 1 s") != std::string::npos
                    || aligned.notes.at(aligned.notes.size() - 2).find("uncertain by up to 1 s") != std::string::npos);
    }

    /// Half a second between two files is a gap where names tell milliseconds, although these are 0.
    void namedMillisecondsCount()
    {
        for (const char *name : {"20260101_000000.000.wav", "20260101_000100_000.wav"})
            writeAudio(path(name), SF_FORMAT_WAV | SF_FORMAT_PCM_16, 1, 200, someNoise(11900));
        const RecordingInfo info = openTogether({m_folder->path().toStdString()})->info();
        QCOMPARE(info.startUnixSeconds, std::optional(newYear));
        QCOMPARE(info.sampleCount, Index(2 * 12000 - 100));
        QVERIFY(contains(info.notes.at(1), "1 gap(s) between files, 0.5 s altogether"));
    }

    void delaysOfStampsAreNoPauses_data()
    {
        QTest::addColumn<double>("resolution");
        QTest::addColumn<double>("delay");
        QTest::newRow("about whole seconds") << 1.0 << 0.05;
        QTest::newRow("milliseconds") << 0.001 << 0.04;
    }

    // Files without a pause whose stamps are late and early by turns.
    void delaysOfStampsAreNoPauses()
    {
        QFETCH(double, resolution);
        QFETCH(double, delay);
        for (const int count : {4, 60}) {
            std::vector<TimedFile> files;
            for (int i = 0; i < count; ++i)
                files.push_back({std::to_string(i),
                                 std::floor((newYear + 60.0 * i + delay * std::sin(2.4 * i)) / resolution) * resolution,
                                 200.0, 12000});
            const Alignment aligned = alignFiles(files);
            QCOMPARE(aligned.rateHz, 200.0);
            for (int i = 0; i < count; ++i)
                QCOMPARE(aligned.places[std::size_t(i)].inTime, Index(12000) * i);
        }
    }

    void gapsAndOverlaps()
    {
        const Alignment aligned = alignFiles({{"b", newYear + 15.25, 100.0, 1000},
                                              {"a", newYear, 100.0, 1000},
                                              {"c", newYear + 24.75, 100.0, 500},
                                              {"d", newYear + 29.75, 100.0, 500}});
        const std::vector<std::array<Index, 3>> expected{
            {0, 0, 1000}, {1525, 0, 1000}, {2525, 50, 450}, {2975, 0, 500}};
        for (std::size_t i = 0; i < expected.size(); ++i)
            QVERIFY2(
                (expected[i]
                 == std::array<Index, 3>{aligned.places[i].inTime, aligned.places[i].skipped, aligned.places[i].count}),
                qPrintable(QString::number(i)));
        QVERIFY(aligned.notes.at(1).starts_with("1 gap(s) between files, 5.25 s"));
        QVERIFY(aligned.notes.at(2).starts_with("1 file(s) begin before the previous one ends; 0.5 s"));
    }

    void refusals_data()
    {
        QTest::addColumn<TimedFile>("other");
        QTest::addColumn<QString>("words");
        QTest::newRow("rate") << TimedFile{"b", newYear + 10, 101.0, 1000}
                              << "b: has 101 samples per second, but a has 100";
        QTest::newRow("within") << TimedFile{"b", newYear + 2, 100.0, 100} << "b: lies within the time of a";
        QTest::newRow("the same time") << TimedFile{"b", newYear, 100.0, 1000} << "b: lies within the time of a";
        QTest::newRow("a wrong clock") << TimedFile{"b", newYear + 4e8, 100.0, 1000}
                                       << "b: begins 4630 days after a ends";
        QTest::newRow("no rate") << TimedFile{"b", newYear, std::nan(""), 1000} << "b: has nan samples per second";
    }

    void refusals()
    {
        QFETCH(TimedFile, other);
        QFETCH(QString, words);
        const std::string said = errorOf([&] { alignFiles({{"a", newYear, 100.0, 1000}, other}); });
        QVERIFY2(said.starts_with(words.toStdString()), said.c_str());
    }

    // In files, in gaps within them, and between them, in any pieces.
    void samplesInTheirPlaces()
    {
        write("late", 0.20, "nopqrst");
        write("early", 0.0, "abcdefgh");
        write("overlapping", 0.25, "STuvwxyz");
        writeBytes(path("holed.sigmf-data"), "ABCDEF");
        writeBytes(path("holed.sigmf-meta"),
                   R"({"global": {"core:datatype": "ri8", "core:sample_rate": 100}, "captures": [
                       {"core:sample_start": 0, "core:global_index": 0, "core:datetime": "2026-01-01T00:00:00.40Z"},
                       {"core:sample_start": 4, "core:global_index": 7}]})");
        const auto recording = openRecording(m_folder->path().toStdString());
        // Stamps tell where a file begins to 10 ms, which is one sample here: later ones begin a run of their own only
        // where they are farther off.
        const QByteArray expected = "abcdefgh............nopqrstuvwxyz.......ABCD...EF";
        QCOMPARE(lettersOf(*recording), expected);
        QVERIFY(readInPieces(*recording, 3) == readAll(*recording));
        for (Index first = 0; first < expected.size(); ++first)
            for (Index count = 1; first + count <= expected.size(); ++count)
                QCOMPARE(recording->isWhole(first, count), !expected.mid(first, count).contains('.'));
        QCOMPARE(recording->info().startUnixSeconds, std::optional(newYear));
        QCOMPARE(recording->info().container, std::string("SigMF"));
    }

    void listsAndMoreFiles()
    {
        std::filesystem::create_directory(path("days"));
        write("days/one", 0.0, "abc");
        write("days/two", 0.1, "def");
        write("other", 0.2, "ghi");
        writeBytes(path("some.timeline"), "# two of them\r\ndays/two.sigmf-meta\r\n\r\nother.sigmf-data\n");
        QCOMPARE(lettersOf(*openRecording(path("some.timeline"))), QByteArray("def.......ghi"));
        const std::vector<std::string> names{path("other.sigmf-meta"), path("days"), path("days/one.sigmf-meta")};
        QCOMPARE(lettersOf(*openTogether(names)), QByteArray("abc.......def.......ghi"));
        QCOMPARE(filesBehind(names).size(), std::size_t(6));
        const std::string before = recordingHash(path("some.timeline"));
        QVERIFY(before.starts_with("files:"));
        write("other", 0.2, "gHi");
        QVERIFY(recordingHash(path("some.timeline")) != before);
    }

    // More files than are kept open, read from two threads.
    void manyFilesAtOnce()
    {
        for (int i = 0; i < 30; ++i)
            write("f" + std::to_string(i), 0.05 * i, QByteArray(5, static_cast<char>('A' + i)));
        const auto recording = openRecording(m_folder->path().toStdString());
        const std::vector<float> all = readAll(*recording);
        QCOMPARE(std::ssize(all), Index(150));
        std::atomic<int> wrong = 0;
        std::vector<std::jthread> threads;
        for (int t = 0; t < 3; ++t)
            threads.emplace_back([&, t] {
                std::vector<float> some(11);
                for (Index first = t; first + 11 <= 150; first += 7) {
                    recording->read(0, first, 11, some);
                    wrong += std::equal(some.begin(), some.end(), all.begin() + first) ? 0 : 1;
                }
            });
        threads.clear();
        QCOMPARE(wrong.load(), 0);
    }

    // A flat battery leaves an empty file, or half a header.
    void brokenFilesAreGaps()
    {
        write("a", 0.0, "abc");
        write("b", 0.05, "");
        write("c", 0.10, "def");
        write("d", 0.20, "ghi");
        writeBytes(path("d.sigmf-meta"), R"({"global": {)");
        writeBytes(path("e.wav"), QByteArray("RIFF\x24\0\0\0WAVEfmt ", 16));
        write("f", 0.30, "jkl");
        const auto recording = openRecording(m_folder->path().toStdString());
        QCOMPARE(lettersOf(*recording), QByteArray("abc.......def.................jkl"));
        QVERIFY(!recording->isWhole(13, 17));
        QVERIFY(recording->isWhole(30, 3));
        const std::string note = recording->info().notes.back();
        for (const char *name : {"3 file(s)", "b.sigmf-", "d.sigmf-meta", "e.wav"})
            QVERIFY2(contains(note, name), note.c_str());
    }

    void refusedFiles()
    {
        const std::string folder = m_folder->path().toStdString();
        const auto said = [](const std::string &path) { return errorOf([&] { openRecording(path); }); };
        QVERIFY(contains(said(folder), "holds no recordings (files such as .wav, .flac or .sigmf-meta)"));
        writeBytes(path("empty.timeline"), "# nothing\n");
        QVERIFY(contains(said(path("empty.timeline")), "holds no recordings"));
        writeBytes(path("itself.timeline"), "itself.timeline\n");
        QVERIFY(contains(said(path("itself.timeline")), "which is a folder or a list itself"));
        writeBytes(path("binary.timeline"), QByteArray("a\0b\n", 4));
        QVERIFY(contains(said(path("binary.timeline")), "is not a list of at most a million file names"));
        writeBytes(path("lost.timeline"), "nowhere.sigmf-meta\n");
        QVERIFY(contains(said(path("lost.timeline")), "nowhere.sigmf-meta"));
        write("a", 0.0, "abc");
        write("b", 1.0, "abcd", R"(, "core:num_channels": 2)");
        QVERIFY(contains(said(folder), "b.sigmf-meta: has a channel count of 2, but"));
        write("b", 1.0, "abcd");
        writeBytes(path("c.sigmf-data"), "abc");
        writeBytes(path("c.sigmf-meta"), R"({"global": {"core:datatype": "ri8", "core:sample_rate": 100}})");
        QVERIFY(contains(said(folder), "c.sigmf-meta: has no time stamp"));
    }

private:
    std::string path(const std::string &name) const { return m_folder->path().toStdString() + "/" + name; }

    /// Signed bytes at 100 Hz, as a SigMF pair; begins at `seconds` of 2026-01-01.
    void write(const std::string &name, double seconds, const QByteArray &samples, const QByteArray &more = "") const
    {
        writeBytes(path(name + ".sigmf-data"), samples);
        const QByteArray time = QStringLiteral("2026-01-01T00:%1:%2Z")
                                    .arg(int(seconds) / 60, 2, 10, QLatin1Char('0'))
                                    .arg(std::fmod(seconds, 60.0), 9, 'f', 6, QLatin1Char('0'))
                                    .toLatin1();
        writeBytes(path(name + ".sigmf-meta"), R"({"global": {"core:datatype": "ri8", "core:sample_rate": 100)" + more
                                                   + R"(}, "captures": [{"core:sample_start": 0, "core:datetime": ")"
                                                   + time + R"("}]})");
    }

    std::unique_ptr<QTemporaryDir> m_folder;
};

FAINTLINE_TEST(tst_Timeline)
#include "tst_Timeline.moc"

#include "signal/formats/writeRecording.h"
#include "support/test.h"

#include "signal/openRecording.h"
#include "support/recordings.h"

#include <csignal>

#include <sys/resource.h>

using namespace faintline;
using namespace faintline::test;

/// Writing recordings: what is written reads back the same, twice the same bytes, all or nothing.
class tst_writeRecording : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void readsBackTheSame_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<bool>("isComplex");
        QTest::addColumn<bool>("isInteger");
        QTest::addColumn<QString>("sampleType");
        QTest::addColumn<double>("tolerance");
        for (const bool isComplex : {false, true}) {
            const auto row = [&](const char *name, bool isInteger, const char *type, int bits) {
                QTest::addRow("%s %s %s", name, isComplex ? "complex" : "real", isInteger ? "integer" : "float")
                    << name << isComplex << isInteger << type << (bits ? std::ldexp(1.0, 1 - bits) : 0.0);
            };
            for (const char *name : {"a.wav", "a.WAV", "a.rf64", "a.w64", "a.aiff", "a.aif", "a.caf", "a.au"}) {
                row(name, false, "float32", 0);
                row(name, true, "int16", 16);
            }
            row("a.flac", false, "int24", 24);
            row("a.flac", true, "int16", 16);
            row("a.sigmf-meta", false, isComplex ? "cf32_le" : "rf32_le", 0);
            row("a.sigmf-data", true, isComplex ? "ci16_le" : "ri16_le", 16);
        }
    }

    void readsBackTheSame()
    {
        QFETCH(QString, name);
        QFETCH(bool, isComplex);
        QFETCH(bool, isInteger);
        QFETCH(QString, sampleType);
        QFETCH(double, tolerance);
        const MemoryRecording original(someNoise(300001 * (isComplex ? 2 : 1)), 8000.0, isComplex);
        const std::string file = path(qPrintable(name));
        writeRecording(original, file, isInteger ? WrittenType::Int16 : WrittenType::Float32);
        OpenOptions options;
        options.iq = isComplex;
        const RecordingPointer copy = openRecording(file, options);
        QCOMPARE(copy->info().sampleType, sampleType.toStdString());
        QCOMPARE(copy->info().sampleCount, original.info().sampleCount);
        QCOMPARE(copy->info().isComplex, isComplex);
        QCOMPARE(copy->info().sampleRateHz, 8000.0);
        QVERIFY(copy->info().notes.empty());
        QVERIFY(largestDifference(readAll(*copy), readAll(original)) <= tolerance);
        QCOMPARE(files().size(), name.contains("sigmf") ? 2 : 1); // no temporary file is left
    }

    void integersAreExactAndClipped()
    {
        const MemoryRecording original(
            {-1.0f, 1.0f, 2.0f, -1.5f, 0.25f, 100.0f / 32768.0f, 1.4f / 32768.0f, -1.6f / 32768.0f}, 8000.0);
        for (const char *name : {"a.wav", "a.flac", "a.sigmf-meta"}) {
            QCOMPARE(writeRecording(original, path(name), WrittenType::Int16), Index(3)); // +1 is not in the range
            const std::vector<float> expected{-1.0f, 32767.0f / 32768.0f, 32767.0f / 32768.0f, -1.0f,
                                              0.25f, 100.0f / 32768.0f,   1.0f / 32768.0f,     -2.0f / 32768.0f};
            const RecordingPointer copy = openRecording(path(name));
            QVERIFY(readAll(*copy) == expected);
            writeRecording(*copy, path("copy.wav"), WrittenType::Int16);
            QVERIFY(readAll(*openRecording(path("copy.wav"))) == expected);
        }
    }

    void sigmfKeepsEverything()
    {
        MemoryRecording original(someNoise(2000), 1234.5678901, true, -7.5e9);
        original.mutableInfo().startUnixSeconds = 1721952000.125;
        writeRecording(original, path("a.sigmf-meta"));
        const RecordingPointer copy = openRecording(path("a.sigmf-data"));
        QCOMPARE(copy->info().sampleRateHz, 1234.5678901);
        QCOMPARE(copy->info().centreHz, -7.5e9);
        QCOMPARE(copy->info().startUnixSeconds, std::optional(1721952000.125));
        QVERIFY(readAll(*copy) == readAll(original));
    }

    void wavKeepsTheStart()
    {
        for (const char *name : {"a.wav", "a.rf64"}) {
            MemoryRecording original(someNoise(2000), 8000.0);
            original.mutableInfo().startUnixSeconds = 1721952000.0 + 80000.125;
            writeRecording(original, path(name));
            QCOMPARE(openRecording(path(name))->info().startUnixSeconds, original.info().startUnixSeconds);
        }
    }

    void sameBytesTwice()
    {
        const MemoryRecording original(someNoise(2000), 8000.0);
        for (const char *name : {"a.wav", "a.caf", "a.aiff", "a.flac", "a.sigmf-meta"}) {
            writeRecording(original, path(name));
            const QByteArray first = readBytes(path(name));
            QTest::qSleep(name == std::string("a.wav") ? 1100 : 1); // a second later
            writeRecording(original, path(name));
            QVERIFY(!first.isEmpty() && readBytes(path(name)) == first);
        }
    }

    void severalChannels()
    {
        writeAudio(path("three.wav"), SF_FORMAT_WAV | SF_FORMAT_FLOAT, 3, 8000, someNoise(3 * 200003));
        const RecordingPointer original = openRecording(path("three.wav"));
        writeRecording(*original, path("copy.sigmf-meta"));
        writeRecording(*original, path("copy.wav"));
        for (int channel = 0; channel < 3; ++channel) {
            QVERIFY(readAll(*openRecording(path("copy.sigmf-meta")), channel) == readAll(*original, channel));
            QVERIFY(readAll(*openRecording(path("copy.wav")), channel) == readAll(*original, channel));
        }
    }

    void cancelledLeavesNothing()
    {
        const MemoryRecording original(someNoise(1 << 20), 8000.0);
        writeBytes(path("a.wav"), "was here before");
        for (const char *name : {"a.wav", "b.flac", "c.sigmf-meta"}) {
            std::stop_source stop;
            RunContext context;
            context.stop = stop.get_token();
            context.progress = [&](double fraction, std::string_view) {
                if (fraction > 0.4)
                    stop.request_stop();
            };
            QVERIFY_THROWS_EXCEPTION(Cancelled, writeRecording(original, path(name), WrittenType::Float32, context));
        }
        QCOMPARE(files(), QStringList{"a.wav"});
        QCOMPARE(readBytes(path("a.wav")), QByteArray("was here before"));
    }

    void progressGrows()
    {
        const MemoryRecording original(someNoise(1 << 20), 8000.0);
        std::vector<double> fractions;
        RunContext context;
        context.progress = [&](double fraction, std::string_view) { fractions.push_back(fraction); };
        writeRecording(original, path("a.wav"), WrittenType::Float32, context);
        QVERIFY(fractions.size() >= 4 && std::is_sorted(fractions.begin(), fractions.end()) && fractions.back() == 1.0);
    }

    void refusals()
    {
        const auto refusal = [&](const char *name, double rate, int channels) {
            MemoryRecording original(someNoise(100), rate);
            original.mutableInfo().channelCount = channels;
            return errorOf([&] { writeRecording(original, path(name)); });
        };
        QVERIFY(contains(refusal("a.xyz", 8000.0, 1), "a.xyz: has no known extension; expected .wav"));
        QVERIFY(contains(refusal("a", 8000.0, 1), "expected .wav"));
        QVERIFY(contains(refusal("a.wav", 8000.5, 1),
                         "whole-number sample rate up to 2147483647 Hz, not 8000.5 Hz; write a .sigmf-meta pair"));
        QVERIFY(contains(refusal("a.wav", 1e10, 1), "whole-number sample rate"));
        QVERIFY(contains(refusal("a.flac", 8000.0, 9), "does not support 9 channel(s)"));
        QVERIFY(contains(refusal("no/such/folder/a.wav", 8000.0, 1), "cannot be written: No such file or directory"));
        QVERIFY(QDir(m_folder->path()).mkdir("folder.wav"));
        QVERIFY(contains(refusal("folder.wav", 8000.0, 1), "is a folder"));
        QVERIFY(QFile::link("/dev/null", m_folder->filePath("null.wav")));
        QVERIFY(contains(refusal("null.wav", 8000.0, 1), "is not a regular file"));
        QVERIFY(QFileInfo("/dev/null").exists());
    }

    void ontoItself()
    {
        const std::vector<float> samples = someNoise(600000);
        writeAudio(path("a.wav"), SF_FORMAT_WAV | SF_FORMAT_FLOAT, 1, 8000, samples);
        QVERIFY(QFile::link("a.wav", m_folder->filePath("link.wav")));
        const RecordingPointer original = openRecording(path("a.wav"));
        writeRecording(*original, path("link.wav"), WrittenType::Int16);
        QVERIFY(QFileInfo(m_folder->filePath("link.wav")).isSymLink()); // the file it points at was replaced
        QVERIFY(readAll(*original) == samples);
        QCOMPARE(openRecording(path("a.wav"))->info().sampleType, std::string("int16"));
    }

    void fullDisk()
    {
        // A limit on the size of files stands in for a full disk.
        const MemoryRecording original(someNoise(1 << 20), 8000.0);
        struct rlimit before = {};
        QCOMPARE(getrlimit(RLIMIT_FSIZE, &before), 0);
        struct rlimit small = before;
        small.rlim_cur = 100000;
        QVERIFY(std::signal(SIGXFSZ, SIG_IGN) != SIG_ERR);
        QCOMPARE(setrlimit(RLIMIT_FSIZE, &small), 0);
        std::vector<std::string> messages;
        for (const char *name : {"a.wav", "a.flac", "a.sigmf-meta"})
            messages.push_back(errorOf([&] { writeRecording(original, path(name)); }));
        QCOMPARE(setrlimit(RLIMIT_FSIZE, &before), 0);
        for (const std::string &message : messages)
            QVERIFY2(contains(message, "cannot be written"), message.c_str());
        QVERIFY(files().isEmpty());
    }

private:
    std::string path(const char *name) const { return m_folder->filePath(name).toStdString(); }
    QStringList files() const { return QDir(m_folder->path()).entryList(QDir::Files | QDir::Hidden); }

    std::unique_ptr<QTemporaryDir> m_folder;
};

FAINTLINE_TEST(tst_writeRecording)
#include "tst_writeRecording.moc"

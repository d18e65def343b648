#include "signal/openRecording.h"
#include "support/test.h"

#include "signal/formats/Hdf5File.h"
#include "support/recordings.h"

#include <sys/stat.h>
#include <unistd.h>

using namespace faintline;
using namespace faintline::test;

namespace {

void addContainers()
{
    QTest::addColumn<int>("format");
    QTest::newRow("wav") << (SF_FORMAT_WAV | SF_FORMAT_PCM_16);
    QTest::newRow("wav float") << (SF_FORMAT_WAV | SF_FORMAT_FLOAT);
    QTest::newRow("rf64") << (SF_FORMAT_RF64 | SF_FORMAT_PCM_24);
    QTest::newRow("w64") << (SF_FORMAT_W64 | SF_FORMAT_DOUBLE);
    QTest::newRow("aiff") << (SF_FORMAT_AIFF | SF_FORMAT_PCM_16);
    QTest::newRow("caf") << (SF_FORMAT_CAF | SF_FORMAT_ALAC_16);
    QTest::newRow("au") << (SF_FORMAT_AU | SF_FORMAT_ULAW);
    QTest::newRow("flac") << (SF_FORMAT_FLAC | SF_FORMAT_PCM_16);
    QTest::newRow("ogg") << (SF_FORMAT_OGG | SF_FORMAT_VORBIS);
}

/// Opens and reads a little of what may be no recording; tells whether it ended as it should.
bool isHandled(const std::string &path)
{
    try {
        const RecordingPointer recording = openRecording(path);
        const RecordingInfo &info = recording->info();
        if (info.sampleCount < 1 || !(info.sampleRateHz > 0.0) || info.channelCount < 1)
            return false;
        std::vector<float> samples(2000);
        for (const Index first : {Index(0), info.sampleCount / 2, info.sampleCount - 100})
            recording->read(info.channelCount - 1, first, 2000, samples);
        return std::all_of(samples.begin(), samples.end(), [](float x) { return std::isfinite(x); });
    } catch (const Error &error) {
        return !contains(error.what(), "\n");
    }
}

} // namespace

/// What opening says of files that are no recordings, and that no malformed file makes it crash, hang or give NaN.
class tst_openRecording : public QObject
{
    Q_OBJECT

private slots:
    void formatsRecogniseTheirFiles_data()
    {
        QTest::addColumn<QString>("file");
        const QHash<QString, QString> examples{
            {"NumPy frames", "frames.npy"}, {"sigproc filterbank", "float.fil"}, {"HDF5 filterbank", "plain.h5"},
            {"HDF5 pings", "pings.h5"},     {"SigMF", "pair.sigmf-meta"},        {"SigMF archive", "archive.sigmf"},
            {"KiwiSDR WAV", "kiwi.wav"},    {"HDF5 strain", "strain.hdf5"},      {"Digital RF", "rf.h5"},
            {"other HDF5", "damaged.h5"},   {"raw samples", "raw.cf32"},         {"sound", "bext.wav"}};
        for (const FileFormat &format : fileFormats())
            QTest::newRow(format.name) << examples.value(format.name);
    }

    void formatsRecogniseTheirFiles()
    {
        QFETCH(QString, file);
        QVERIFY2(!file.isEmpty(), "name an example of the format");
        const QString stored = QStringLiteral(FAINTLINE_SOURCE_DIR "/tests/fuzz/files/") + file;
        const std::string example = QFile::exists(stored) ? stored.toStdString() : path(file.toLatin1());
        if (!QFile::exists(stored))
            writeBytes(example, "content");
        if (Hdf5File::recognises(example))
            try {
                const Hdf5File open(example);
            } catch (const Error &error) {
                QSKIP(error.what());
            }
        const auto format =
            std::ranges::find_if(fileFormats(), [&](const FileFormat &each) { return each.recognises(example); });
        QCOMPARE(format->name, QTest::currentDataTag());
        QCOMPARE(holdsFrames(example), !format->openSamples);
        for (const std::string &ending : format->endings)
            QVERIFY(isNamedLikeRecording("a." + ending)
                    && isNamedLikeRecording("A." + ending, false) >= (format->openSamples != nullptr));
    }

    void refusals()
    {
        QVERIFY(contains(refusal(path("none.wav")), "no such file"));
        QVERIFY(contains(refusal(path("none.wav") + "/x"), "no such file"));
        QVERIFY(QDir(m_folder.path()).mkdir("empty"));
        QVERIFY(contains(refusal(path("empty")), "holds no recordings"));
        QVERIFY(contains(refusal("/dev/null"), "is a device or a pipe"));
        QCOMPARE(::mkfifo(path("pipe.wav").c_str(), 0600), 0);
        QVERIFY(contains(refusal(path("pipe.wav")), "is a device or a pipe"));
        writeBytes(path("empty.wav"), {});
        QVERIFY(contains(refusal(path("empty.wav")), "is empty; accepted are WAV, RF64"));
        writeBytes(path("text.txt"), "Some text, and a little more of it, so that it is longer than any header.\n");
        QVERIFY(contains(refusal(path("text.txt")), "has an unknown format; accepted are WAV, RF64"));
        writeBytes(path("text.wav"), "Some text");
        QVERIFY(contains(refusal(path("text.wav")), "has an unknown format"));
        writeBytes(path("a.sigmf"), "x");
        QVERIFY(contains(refusal(path("a.sigmf")), "is a SigMF archive; unpack it"));

        writeAudio(path("good.wav"), SF_FORMAT_WAV | SF_FORMAT_PCM_16, 1, 8000, {0.5f});
        QCOMPARE(openRecording(path("good.wav"))->info().sampleCount, Index(1));
        const QByteArray good = readBytes(path("good.wav"));
        const auto patched = [&](qsizetype at, const QByteArray &bytes) {
            writeBytes(path("bad.wav"), QByteArray(good).replace(at, bytes.size(), bytes));
            return refusal(path("bad.wav"));
        };
        QVERIFY(contains(patched(24, QByteArray(4, '\0')), "the sample rate or channel count in its header is 0"));
        QVERIFY(
            contains(patched(22, QByteArray(2, '\0')), "damaged or truncated in its header (Channel count is zero"));
        QVERIFY(contains(patched(22, QByteArray("\x88\x13", 2)), "(Too many channels specified"));
        writeAudio(path("none.wav"), SF_FORMAT_WAV | SF_FORMAT_PCM_16, 1, 8000, {});
        QVERIFY(contains(refusal(path("none.wav")), "is a WAV file without samples"));
    }

    void rawFilesAskForWhatIsMissing()
    {
        writeBytes(path("a.cs16"), QByteArray(400, '\1'));
        writeBytes(path("a.iq"), QByteArray(400, '\1'));
        QVERIFY(contains(refusal(path("a.cs16")),
                         "(ci16_le according to its name); give their rate in Hz (such as --raw-rate 48000)"));
        QVERIFY(contains(refusal(path("a.iq")),
                         "give their type and rate in Hz (such as --raw-type ci16_le --raw-rate 48000)"));
        OpenOptions options;
        options.rawRateHz = 1000.0;
        QCOMPARE(openRecording(path("a.cs16"), options)->info().sampleCount, Index(100));
        QVERIFY(contains(refusal(path("a.iq"), options), "give their type"));
        options.rawType = "cu8";
        QCOMPARE(openRecording(path("a.iq"), options)->info().sampleCount, Index(200));
        QCOMPARE(openRecording(path("a.cs16"), options)->info().sampleType, std::string("cu8"));
        options.rawRateHz = 0.0;
        QVERIFY(contains(refusal(path("a.iq"), options), "have no header; give their rate"));
        options.rawType = "unknown";
        options.rawRateHz = 1.0;
        QVERIFY(contains(refusal(path("a.iq"), options), "unknown is not a sample type; expected one of cf32"));
    }

    void whatIsSaidOfRawSamplesIsNotIgnored()
    {
        writeAudio(path("a.wav"), SF_FORMAT_WAV | SF_FORMAT_PCM_16, 1, 8000, someNoise(100));
        OpenOptions rate, channels, header;
        rate.rawRateHz = 1000.0;
        channels.rawChannels = 2;
        header.rawHeaderBytes = 44;
        for (OpenOptions options : {rate, channels, header}) {
            QVERIFY(contains(refusal(path("a.wav"), options), "a.wav: describes its samples itself; --raw-rate"));
            options.rawType = "ci16_le";
            options.rawRateHz = 1000.0;
            QCOMPARE(openRecording(path("a.wav"), options)->info().container, std::string("raw"));
        }
    }

    // The start of the second is in the name's zone; a centre frequency is known of I and Q alone.
    void namesTellWhatFilesDoNot()
    {
        const std::string raw = path("gqrx_20260123_235959_100000000_2000000_fc.raw");
        writeBytes(raw, QByteArray(800, '\1'));
        const RecordingInfo gqrx = openRecording(raw)->info();
        QCOMPARE(gqrx.sampleType, std::string("cf32_le"));
        QCOMPARE(gqrx.sampleRateHz, 2e6);
        QCOMPARE(gqrx.centreHz, 1e8);
        QCOMPARE(gqrx.startUnixSeconds, std::optional(1769212799.0));
        OpenOptions other;
        other.rawType = "ci16";
        other.rawRateHz = 1e6;
        QCOMPARE(openRecording(raw, other)->info().sampleType, std::string("ci16_le"));
        QCOMPARE(openRecording(raw, other)->info().sampleRateHz, 1e6);

        const std::string wav = path("HDSDR_20260124_005959+0100_7100kHz_RF.wav");
        writeAudio(wav, SF_FORMAT_WAV | SF_FORMAT_PCM_16, 2, 8000, someNoise(20));
        OpenOptions iq;
        iq.iq = true;
        QCOMPARE(openRecording(wav, iq)->info().centreHz, 7.1e6);
        QCOMPARE(openRecording(wav, iq)->info().startUnixSeconds, std::optional(1769212799.0));
        const RecordingInfo real = openRecording(wav)->info();
        QCOMPARE(real.centreHz, 0.0);
        QVERIFY(contains(real.notes.back(), "its two channels may be I and Q"));

        writeAudio(path("plain.wav"), SF_FORMAT_WAV | SF_FORMAT_PCM_16, 2, 8000, someNoise(20));
        QVERIFY(!openRecording(path("plain.wav"), iq)->info().isCentreKnown());
        QVERIFY(!openRecording(path("plain.wav"))->info().startUnixSeconds);
    }

    void firstStampOfAReceiver_data()
    {
        QTest::addColumn<QList<double>>("stamps"); // of blocks of 0.1 s, in seconds of the GPS week
        QTest::addColumn<int>("missing");          // samples
        QTest::addColumn<double>("first");         // time of the first sample, second of the week
        QTest::newRow("regular") << QList<double>{500.0, 500.1, 500.2, 500.3} << 0 << 500.0;
        QTest::newRow("a gap") << QList<double>{500.0, 500.1, 502.2, 502.3} << 2000 << 500.0;
        QTest::newRow("a gap behind the first block") << QList<double>{500.0, 502.1, 502.2, 502.3} << 2000 << 500.0;
        QTest::newRow("a stale first stamp") << QList<double>{200.0, 500.1, 500.2, 500.3} << 0 << 500.0;
        QTest::newRow("a first stamp of later") << QList<double>{900.0, 500.1, 500.2, 500.3} << 0 << 500.0;
        QTest::newRow("a stale first stamp and a gap") << QList<double>{200.0, 500.1, 501.2, 501.3} << 1000 << 500.0;
        QTest::newRow("minutes missing later") << QList<double>{500.0, 500.1, 800.2, 800.3} << 300000 << 500.0;
    }

    // A KiwiSDR that was idle may stamp its first block with the time of an earlier one.
    void firstStampOfAReceiver()
    {
        QFETCH(QList<double>, stamps);
        QFETCH(int, missing);
        QFETCH(double, first);
        const RecordingInfo info = kiwi(stamps);
        QCOMPARE(info.container, std::string("KiwiSDR WAV"));
        QCOMPARE(info.sampleCount, Index(400 + missing));
        QVERIFY(std::abs(std::fmod(*info.startUnixSeconds - 315964800.0 + 18.0, 604800.0) - first) < 1e-6);
    }

    // To a nanosecond, stamps of the week's second 300 000 agree with the header's rate.
    void ratesThatStampsDoNotTellApart()
    {
        for (const double interval : {0.1, 0.1 / 3.0}) {
            QList<double> stamps;
            for (int i = 0; i < 60; ++i)
                stamps.push_back(300000.0 + interval * i);
            const RecordingInfo info = kiwi(stamps, interval == 0.1 ? 1000 : 3000);
            QCOMPARE(info.sampleRateHz, interval == 0.1 ? 1000.0 : 3000.0);
            QCOMPARE(info.notes.size(), std::size_t(1));
            QCOMPARE(info.notes[0], std::string("The first time stamp is second 300000 of the GPS week."));
        }
        QList<double> fast;
        for (int i = 0; i < 60; ++i)
            fast.push_back(300000.0 + 0.09999999 * i);
        QVERIFY(std::abs(kiwi(fast).sampleRateHz - 1000.0001) < 1e-6);
    }

    void contentBeatsExtension()
    {
        for (const char *name : {"wav.raw", "wav.iq", "wav.txt", "wav.flac", "wav"}) {
            writeAudio(path(name), SF_FORMAT_WAV | SF_FORMAT_PCM_16, 1, 8000, someNoise(10));
            QCOMPARE(openRecording(path(name))->info().container, std::string("WAV"));
        }
    }

    /// A chunk's length may lead behind the last byte that could be counted.
    void chunksLongerThanAnyFile()
    {
        writeAudio(path("long.rf64"), SF_FORMAT_RF64 | SF_FORMAT_PCM_16, 1, 1000, someNoise(2000));
        QByteArray bytes = readBytes(path("long.rf64"));
        const qsizetype sizes = bytes.indexOf("ds64") + 8;
        bytes.replace(sizes, 24, QByteArray("\xf8\xff\xff\xff\xff\xff\xff\x7f", 8).repeated(3));
        writeBytes(path("long.rf64"), bytes);
        QCOMPARE(openRecording(path("long.rf64"))->info().sampleCount, Index(2000));
    }

    void notPermitted()
    {
        if (::geteuid() == 0)
            QSKIP("skipped: root may read everything");
        writeAudio(path("locked.wav"), SF_FORMAT_WAV | SF_FORMAT_PCM_16, 1, 8000, someNoise(10));
        QCOMPARE(::chmod(path("locked.wav").c_str(), 0), 0);
        QVERIFY(contains(refusal(path("locked.wav")), "cannot be opened: Permission denied"));
    }

    void truncatedAnywhere_data() { addContainers(); }

    void truncatedAnywhere()
    {
        QFETCH(int, format);
        writeAudio(path("whole"), format, 1, 8000, someNoise(300));
        const QByteArray whole = readBytes(path("whole"));
        for (qsizetype length = 0; length < whole.size(); length += whole.size() < 3000 ? 7 : 61) {
            writeBytes(path("cut.wav"), whole.left(length));
            QVERIFY2(isHandled(path("cut.wav")), qPrintable(QString::number(length)));
        }
    }

    void changedAnywhere_data() { addContainers(); }

    void changedAnywhere()
    {
        QFETCH(int, format);
        writeAudio(path("whole"), format, 2, 8000, someNoise(600));
        const QByteArray whole = readBytes(path("whole"));
        Random random(7, 0);
        for (int trial = 0; trial < 200; ++trial) {
            QByteArray changed = whole;
            for (int i = 0; i < 3; ++i) { // mostly in the header
                const double where = std::pow(random.uniform(), 3.0) * double(std::min<qsizetype>(whole.size(), 400));
                changed[qsizetype(where)] = static_cast<char>(random.bits());
            }
            writeBytes(path("changed.wav"), changed);
            QVERIFY2(isHandled(path("changed.wav")), qPrintable(QString::number(trial)));
        }
    }

    void randomBytes()
    {
        Random random(8, 0);
        for (int trial = 0; trial < 200; ++trial) {
            QByteArray bytes = trial % 2 ? QByteArray("RIFF\xff\xff\xff\xffWAVE") : QByteArray();
            for (int i = 0; i < 500; ++i)
                bytes.append(static_cast<char>(random.bits() & (trial % 3 ? 0xff : 0x0f)));
            writeBytes(path("random"), bytes);
            QVERIFY(isHandled(path("random")));
        }
    }

    void hashes()
    {
        writeBytes(path("abc"), "abc"); // FIPS 180-2, appendix B.1
        QCOMPARE(recordingHash(path("abc")),
                 std::string("ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"));
        writeBytes(path("none"), "");
        QCOMPARE(recordingHash(path("none")),
                 std::string("e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"));
        QVERIFY(contains(errorOf([&] { recordingHash(path("missing")); }), "no such file"));

        // Above 64 MiB: first mebibyte, last mebibyte, length in 8 bytes, lowest first.
        constexpr qint64 mebibyte = 1 << 20;
        QFile file(m_folder.filePath("large"));
        QVERIFY(file.open(QIODevice::ReadWrite) && file.resize(64 * mebibyte));
        QVERIFY(!recordingHash(path("large")).starts_with("part:"));
        QVERIFY(file.resize(64 * mebibyte + 1) && file.seek(64 * mebibyte) && file.write("z") == 1);
        file.close();
        QByteArray expected(2 * mebibyte, '\0');
        expected[2 * mebibyte - 1] = 'z';
        expected += QByteArray("\x01\x00\x00\x04\x00\x00\x00\x00", 8);
        QCOMPARE(QString::fromStdString(recordingHash(path("large"))),
                 "part:" + QString(QCryptographicHash::hash(expected, QCryptographicHash::Sha256).toHex()));
    }

private:
    /// A file of a KiwiSDR with a block of 100 samples at each stamp.
    RecordingInfo kiwi(const QList<double> &stamps, std::uint32_t rate = 1000) const
    {
        QByteArray file = "RIFF" + littleEndian(0, 4) + "WAVEfmt " + littleEndian(16, 4) + littleEndian(1, 2)
                          + littleEndian(1, 2) + littleEndian(rate, 4) + littleEndian(2 * rate, 4) + littleEndian(2, 2)
                          + littleEndian(16, 2);
        for (const double stamp : stamps)
            file += "kiwi" + littleEndian(10, 4) + littleEndian(0, 2) + littleEndian(std::uint32_t(stamp), 4)
                    + littleEndian(std::uint32_t(std::lround(1e9 * (stamp - std::floor(stamp)))), 4) + "data"
                    + littleEndian(200, 4) + QByteArray(200, '\1');
        const std::string name = path("20260101T000820Z_kiwi.wav"); // a Thursday: the week began on Sunday
        writeBytes(name, file);
        return openRecording(name)->info();
    }

    std::string path(const char *name) const { return m_folder.filePath(name).toStdString(); }
    std::string refusal(const std::string &file, const OpenOptions &options = {}) const
    {
        const std::string message = errorOf([&] { openRecording(file, options); });
        if (!message.starts_with(file + ": ") || contains(message, "\n"))
            qWarning("not one line about the file: %s", message.c_str());
        return message;
    }

    QTemporaryDir m_folder;
};

FAINTLINE_TEST(tst_openRecording)
#include "tst_openRecording.moc"

#include "signal/formats/AudioRecording.h"
#include "support/test.h"

#include "support/recordings.h"

#include <thread>

using namespace faintline;
using namespace faintline::test;

namespace {

/// A canonical WAV file: 16-bit, with the length fields as given.
QByteArray wave(int channels, int rate, const std::vector<int> &samples, std::uint32_t dataLength,
                const QByteArray &chunkBeforeData = {})
{
    QByteArray data;
    for (const int sample : samples)
        data += littleEndian(std::uint16_t(sample), 2);
    const QByteArray format = "fmt " + littleEndian(16, 4) + littleEndian(1, 2)
                              + littleEndian(std::uint64_t(channels), 2) + littleEndian(std::uint64_t(rate), 4)
                              + littleEndian(std::uint64_t(rate * channels * 2), 4)
                              + littleEndian(std::uint64_t(channels * 2), 2) + littleEndian(16, 2);
    const QByteArray body = "WAVE" + format + chunkBeforeData + "data" + littleEndian(dataLength, 4) + data;
    return "RIFF" + littleEndian(std::uint64_t(body.size()), 4) + body;
}

const std::vector<int> fiveSamples{-32768, 32767, 16384, 0, -1};

} // namespace

/// Reading through libsndfile: every container, random access, I/Q, start times, and headers that lie.
class tst_AudioRecording : public QObject
{
    Q_OBJECT

private slots:
    void randomAccessEqualsWhole_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<int>("format");
        QTest::addColumn<int>("channels");
        QTest::addColumn<int>("samples");
        QTest::addColumn<QString>("container");
        QTest::addColumn<QString>("sampleType");
        QTest::addColumn<double>("tolerance"); // against decoding from the beginning
        const auto row = [](const char *name, int format, int channels, const char *container, const char *type,
                            double tolerance = 0.0, int samples = 30011) {
            QTest::newRow(name) << QString(name) << format << channels << samples << QString(container) << QString(type)
                                << tolerance;
        };
        row("a.u8.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_U8, 1, "WAV", "uint8");
        row("a.16.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 1, "WAV", "int16");
        row("a.24.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_24, 3, "WAV", "int24");
        row("a.32.wav", SF_FORMAT_WAVEX | SF_FORMAT_PCM_32, 2, "WAV", "int32");
        row("a.f32.wav", SF_FORMAT_WAV | SF_FORMAT_FLOAT, 2, "WAV", "float32");
        row("a.f64.wav", SF_FORMAT_WAV | SF_FORMAT_DOUBLE, 1, "WAV", "float64");
        row("a.ulaw.wav", SF_FORMAT_WAV | SF_FORMAT_ULAW, 1, "WAV", "µ-law");
        row("a.ima.wav", SF_FORMAT_WAV | SF_FORMAT_IMA_ADPCM, 2, "WAV", "IMA ADPCM");
        row("a.gsm.wav", SF_FORMAT_WAV | SF_FORMAT_GSM610, 1, "WAV", "GSM 6.10"); // cannot seek
        row("a.rf64", SF_FORMAT_RF64 | SF_FORMAT_PCM_16, 2, "RF64", "int16");
        row("a.w64", SF_FORMAT_W64 | SF_FORMAT_FLOAT, 1, "W64", "float32");
        row("a.aiff", SF_FORMAT_AIFF | SF_FORMAT_PCM_16, 2, "AIFF", "int16");
        row("a.caf", SF_FORMAT_CAF | SF_FORMAT_FLOAT, 2, "CAF", "float32");
        row("a.alac.caf", SF_FORMAT_CAF | SF_FORMAT_ALAC_16, 1, "CAF", "16 bit ALAC");
        row("a.au", SF_FORMAT_AU | SF_FORMAT_PCM_16, 1, "AU", "int16");
        row("a.flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_24, 2, "FLAC", "int24", 0.0, 400001);
        row("a.ogg", SF_FORMAT_OGG | SF_FORMAT_VORBIS, 1, "OGG", "Vorbis", 1e-6, 800001);
        row("a.mp3", SF_FORMAT_MPEG | SF_FORMAT_MPEG_LAYER_III, 1, "MP3", "MPEG Layer III", 1e-6, 800001);
        row("a.opus", SF_FORMAT_OGG | SF_FORMAT_OPUS, 1, "OGG", "Opus", 1e-4, 800001);
    }

    void randomAccessEqualsWhole()
    {
        QFETCH(QString, name);
        QFETCH(int, format);
        QFETCH(int, channels);
        QFETCH(int, samples);
        QFETCH(QString, container);
        QFETCH(QString, sampleType);
        QFETCH(double, tolerance);
        const std::string file = path(qPrintable(name));
        const SF_INFO wanted = {0, 16000, channels, format, 0, 0};
        if (!sf_format_check(&wanted))
            QSKIP("skipped: this libsndfile does not write it");
        writeAudio(file, format, channels, 16000, someNoise(Index(samples) * channels));
        const std::vector<float> oracle = decodeAudio(file);
        QVERIFY(std::ssize(oracle) >= Index(samples) * channels);

        const AudioRecording recording(file, false);
        QCOMPARE(QString::fromStdString(recording.info().container), container);
        QCOMPARE(QString::fromStdString(recording.info().sampleType), sampleType);
        QCOMPARE(recording.info().sampleRateHz, 16000.0);
        QCOMPARE(recording.info().channelCount, channels);
        QCOMPARE(recording.info().sampleCount, std::ssize(oracle) / channels);
        QVERIFY(!recording.info().isComplex);
        QVERIFY(recording.info().notes.empty());
        for (int channel = 0; channel < channels; ++channel) {
            const std::vector<float> whole = readAll(recording, channel);
            QVERIFY(largestDifference(whole, every(oracle, std::size_t(channels), std::size_t(channel))) <= tolerance);
            const AudioRecording other(file, false);
            QVERIFY(readInPieces(other, samples / 40, channel) == whole); // to the last bit, lossy or not
        }
    }

    void fullScaleIsOne()
    {
        writeBytes(path("scale.wav"), wave(1, 8000, fiveSamples, 10));
        const std::vector<float> expected{-1.0f, 32767.0f / 32768.0f, 0.5f, 0.0f, -1.0f / 32768.0f};
        QVERIFY(readAll(AudioRecording(path("scale.wav"), false)) == expected);
    }

    void twoChannelsAsIq()
    {
        const std::vector<float> samples = someNoise(4 * 1000);
        writeAudio(path("iq.wav"), SF_FORMAT_WAV | SF_FORMAT_FLOAT, 4, 8000, samples);
        const AudioRecording recording(path("iq.wav"), true);
        QVERIFY(recording.info().isComplex);
        QCOMPARE(recording.info().channelCount, 2);
        QCOMPARE(recording.info().sampleCount, Index(1000));
        const std::vector<float> second = readInPieces(recording, 77, 1);
        for (std::size_t i = 0; i < 1000; ++i) {
            QCOMPARE(second[2 * i], samples[4 * i + 2]);
            QCOMPARE(second[2 * i + 1], samples[4 * i + 3]);
        }

        writeAudio(path("three.wav"), SF_FORMAT_WAV | SF_FORMAT_PCM_16, 3, 8000, someNoise(300));
        QVERIFY(contains(errorOf([&] { AudioRecording(path("three.wav"), true); }),
                         "three.wav: has 3 channel(s); I/Q needs"));
    }

    void manyChannels()
    {
        const std::vector<float> samples = someNoise(255 * 400);
        writeAudio(path("many.wav"), SF_FORMAT_WAV | SF_FORMAT_FLOAT, 255, 8000, samples);
        const AudioRecording recording(path("many.wav"), false);
        QCOMPARE(recording.info().channelCount, 255);
        QVERIFY(readInPieces(recording, 90, 200) == every(samples, 255, 200));
    }

    void zerosOutside()
    {
        writeBytes(path("edge.wav"), wave(1, 8000, fiveSamples, 10));
        const AudioRecording recording(path("edge.wav"), false);
        std::vector<float> out(9, 7.0f);
        recording.read(0, -2, 9, out);
        QVERIFY((out == std::vector<float>{0, 0, -1.0f, 32767.0f / 32768.0f, 0.5f, 0, -1.0f / 32768.0f, 0, 0}));
        for (const Index far : {Index(5), Index(1) << 60, std::numeric_limits<Index>::max(), -(Index(1) << 60)}) {
            std::fill(out.begin(), out.end(), 7.0f);
            recording.read(0, far, 9, out);
            QVERIFY(out == std::vector<float>(9, 0.0f));
        }
        recording.read(0, 2, 0, {});
    }

    void notFiniteReadsAsZero()
    {
        writeAudio(path("nan.wav"), SF_FORMAT_WAV | SF_FORMAT_FLOAT, 1, 8000,
                   {1.0f, NAN, INFINITY, -INFINITY, 0.5f, 1e30f});
        const AudioRecording recording(path("nan.wav"), false);
        QCOMPARE(recording.nonFiniteCount(), Index(0));
        QVERIFY((readAll(recording) == std::vector<float>{1.0f, 0, 0, 0, 0.5f, 1e30f}));
        QCOMPARE(recording.nonFiniteCount(), Index(3));

        // Its stretches were not observed, in one channel and not in the other.
        std::vector<float> two(2 * 200000, 0.25f);
        two[2 * 70000] = NAN;
        two[2 * 131071] = -INFINITY;
        writeAudio(path("two.wav"), SF_FORMAT_WAV | SF_FORMAT_FLOAT, 2, 8000, two);
        const AudioRecording other(path("two.wav"), false);
        QVERIFY(other.isObserved(0, 0, 70000) && !other.isObserved(0, 0, 70001) && !other.isObserved(0, 70000, 1));
        QVERIFY(other.isObserved(0, 70001, 61070) && !other.isObserved(0, 70001, 61071));
        QVERIFY(other.isObserved(0, 131072, 100000) && other.isObserved(1, 0, 200000));
        QCOMPARE(other.nonFiniteCountIn(0, 0, 200000), Index(2));
        QCOMPARE(other.nonFiniteCount(), Index(0));
    }

    void sampleCountOfHeadersThatLie_data()
    {
        QTest::addColumn<quint32>("dataLength");
        QTest::addColumn<bool>("noted");
        QTest::newRow("the truth") << 10u << false;
        QTest::newRow("never closed") << 0u << true;
        QTest::newRow("stream") << 0xffffffffu << true;
        QTest::newRow("stream, even") << 0xfffffffeu << true;
        QTest::newRow("stream, signed") << 0x7fffffffu << true;
        QTest::newRow("twice as long") << 20u << true;
    }

    void sampleCountOfHeadersThatLie()
    {
        QFETCH(quint32, dataLength);
        QFETCH(bool, noted);
        writeBytes(path("lie.wav"), wave(1, 8000, fiveSamples, dataLength));
        const AudioRecording recording(path("lie.wav"), false);
        QCOMPARE(recording.info().sampleCount, Index(5));
        QCOMPARE(readAll(recording)[2], 0.5f);
        QCOMPARE(recording.info().notes.size(), std::size_t(noted ? 1 : 0));
    }

    void samplesBehindTheDeclaredLength_data()
    {
        QTest::addColumn<QByteArray>("behind"); // 40 000 bytes of samples with a declared length of 10 000
        QTest::addColumn<int>("count");
        QTest::addColumn<bool>("noted");
        std::vector<float> noise = someNoise(15000);
        QByteArray more;
        for (const float value : noise)
            more += littleEndian(std::uint16_t(std::lround(value * 32767.0f)), 2);
        const auto chunk = [](const char *name, qsizetype length) {
            return name + littleEndian(std::uint64_t(length), 4) + QByteArray(length, 'x');
        };
        QTest::newRow("samples") << more << 20000 << true;
        QTest::newRow("samples, then a chunk") << more + chunk("LIST", 5112) << 20000 << true;
        QTest::newRow("samples, then chunks") << more + chunk("id3 ", 33) + '\0' + chunk("cue ", 4) << 20000 << true;
        QTest::newRow("samples, then a chunk and more samples") << more + chunk("LIST", 5112) + more << 37560 << true;
        QTest::newRow("samples like a chunk, but for its length") << more + chunk("LIST", 5112) + "xx" << 22561 << true;
        QTest::newRow("a chunk within a sample") << more + '\1' + chunk("LIST", 5111) << 22560 << true;
        QTest::newRow("a few samples") << more.first(40) << 5020 << true;
        QTest::newRow("silence that is longer than padding") << QByteArray(100000, '\0') << 55000 << true;
        QTest::newRow("nothing") << QByteArray() << 5000 << false;
        QTest::newRow("less than a chunk") << QByteArray(7, '\1') << 5000 << false;
        QTest::newRow("a chunk") << chunk("LIST", 24) << 5000 << false;
        QTest::newRow("chunks of other names") << chunk("abcd", 24) + chunk("efgh", 2) << 5000 << false;
        QTest::newRow("a truncated chunk") << chunk("iXML", 2000).first(1000) << 5000 << false;
        QTest::newRow("an ID3 tag") << "TAG" + QByteArray(125, 'x') << 5000 << false;
        QTest::newRow("padding") << QByteArray(4096, '\0') << 5000 << true;
    }

    // A length that is stale, or was too large for its 32 bits, is smaller than the samples.
    void samplesBehindTheDeclaredLength()
    {
        QFETCH(QByteArray, behind);
        QFETCH(int, count);
        QFETCH(bool, noted);
        std::vector<int> samples(5000);
        for (int i = 0; i < 5000; ++i)
            samples[std::size_t(i)] = 3 * i - 7000;
        QByteArray bext(602, '\0');
        bext.replace(320, 10, "2024-07-26");
        bext.replace(330, 8, "12-34-56");
        writeBytes(path("longer.wav"), wave(1, 8000, samples, 10000, "bext" + littleEndian(602, 4) + bext) + behind);
        const AudioRecording recording(path("longer.wav"), false);
        QCOMPARE(recording.info().sampleCount, Index(count));
        QCOMPARE(recording.info().container, std::string("WAV"));
        QCOMPARE(recording.info().startUnixSeconds, std::optional(1721997296.0));
        QCOMPARE(recording.info().notes.size(), std::size_t(noted ? 2 : 1)); // the start's, too
        const std::vector<float> read = readInPieces(recording, 777);
        for (std::size_t i = 0; i < read.size(); ++i) {
            const int expected = i < samples.size()
                                     ? samples[i]
                                     : std::int16_t(std::uint8_t(behind[qsizetype(2 * i) - 10000])
                                                    | std::uint8_t(behind[qsizetype(2 * i) - 9999]) << 8);
            QCOMPARE(read[i], float(expected) / 32768.0f);
        }
    }

    // A sparse file; the length is what is left of it in 32 bits. With and without a chunk at its end.
    void lengthsBeyond4GiB()
    {
        constexpr Index samples = (Index(1) << 31) + 160000;
        for (const bool isChunkBehind : {false, true}) {
            const std::string name = path("long.wav");
            const QByteArray header = wave(1, 8000, {}, 320000);
            writeBytes(name, header);
            QFile file(QString::fromStdString(name));
            QVERIFY(file.open(QIODevice::ReadWrite));
            if (!file.resize(header.size() + 2 * samples))
                QSKIP("skipped: no room for a sparse file of 4 GiB");
            file.seek(header.size() + 320000);
            file.write(QByteArray(70000, '\1')); // what follows the declared end is no padding
            file.seek(header.size() + 2 * (samples - 1));
            file.write(littleEndian(0x4000, 2));
            if (isChunkBehind)
                file.write("LIST" + littleEndian(4, 4) + "INFO");
            file.close();
            const AudioRecording recording(name, false);
            QCOMPARE(recording.info().sampleCount, samples);
            QCOMPARE(recording.info().container, std::string("WAV"));
            std::vector<float> last(3);
            recording.read(0, samples - 2, 3, last);
            QVERIFY((last == std::vector<float>{0.0f, 0.5f, 0.0f}));
        }
    }

    void damagedChunksAreIgnored_data()
    {
        QTest::addColumn<QByteArray>("chunk");
        const auto chunk = [](const char *name, const QByteArray &content) {
            return name + littleEndian(std::uint64_t(content.size()), 4) + content;
        };
        QTest::newRow("short peak") << chunk("PEAK", QByteArray(8, '\1'));
        QTest::newRow("long peak") << chunk("PEAK", QByteArray(24, '\0'));
        QTest::newRow("two peaks") << chunk("PEAK", QByteArray(4000, '\0')) + chunk("PEAK", {});
        QTest::newRow("peak that claims more than it holds")
            << dated() + "PEAK" + littleEndian(24, 4) + QByteArray(16, '\1');
        QTest::newRow("cues") << chunk("cue ", QByteArray("\xff\xff\xff\xff", 4));
        QTest::newRow("sampler") << chunk("smpl", QByteArray(36, '\xff'));
        QTest::newRow("instrument") << chunk("inst", QByteArray(2, '\0'));
        QTest::newRow("broadcast") << chunk("bext", QByteArray(20, '\0'));
        QTest::newRow("cart") << chunk("cart", QByteArray(100, '\0'));
        QTest::newRow("fact") << chunk("fact", QByteArray(4, '\xff'));
    }

    void damagedChunksAreIgnored()
    {
        QFETCH(QByteArray, chunk);
        QByteArray floats = wave(1, 8000, {0, 0x3f00, 0, -0x4180}, 8, chunk + dated()); // 0.5 and -0.25 …
        floats.replace(20, 2, littleEndian(3, 2));                                      // … as 32-bit floats
        floats.replace(32, 4, littleEndian(0x200004, 4));
        writeBytes(path("chunk.wav"), floats);
        const AudioRecording recording(path("chunk.wav"), false);
        QVERIFY((readAll(recording) == std::vector<float>{0.5f, -0.25f}));
        QCOMPARE(recording.info().startUnixSeconds, std::optional(1721955723.0));
    }

    void truncatedFilesGiveWhatIsThere_data()
    {
        QTest::addColumn<int>("format");
        QTest::addColumn<double>("tolerance");
        QTest::newRow("wav") << (SF_FORMAT_WAV | SF_FORMAT_PCM_16) << 0.0;
        QTest::newRow("rf64") << (SF_FORMAT_RF64 | SF_FORMAT_FLOAT) << 0.0;
        QTest::newRow("w64") << (SF_FORMAT_W64 | SF_FORMAT_FLOAT) << 0.0;
        QTest::newRow("aiff") << (SF_FORMAT_AIFF | SF_FORMAT_PCM_24) << 0.0;
        QTest::newRow("au") << (SF_FORMAT_AU | SF_FORMAT_PCM_16) << 0.0;
        QTest::newRow("flac") << (SF_FORMAT_FLAC | SF_FORMAT_PCM_16) << 0.0;
        QTest::newRow("ogg") << (SF_FORMAT_OGG | SF_FORMAT_VORBIS) << 1e-6;
    }

    void truncatedFilesGiveWhatIsThere()
    {
        QFETCH(int, format);
        QFETCH(double, tolerance);
        constexpr Index samples = 400001;
        writeAudio(path("whole"), format, 1, 16000, someNoise(samples));
        const std::vector<float> whole = decodeAudio(path("whole"));
        const QByteArray bytes = readBytes(path("whole"));
        writeBytes(path("part"), bytes.left(bytes.size() * 6 / 10 + 1));

        const AudioRecording recording(path("part"), false);
        const Index count = recording.info().sampleCount;
        QVERIFY2(count > samples / 2 && count < samples * 62 / 100, qPrintable(QString::number(count)));
        QCOMPARE(recording.info().notes.size(), std::size_t(1));
        const std::vector<float> part = readAll(recording);
        QVERIFY(largestDifference(part, {whole.begin(), whole.begin() + count}) <= tolerance);
        QVERIFY(readInPieces(AudioRecording(path("part"), false), 50000) == part);
    }

    void aiffRatesThatAreNone_data()
    {
        QTest::addColumn<QByteArray>("rate"); // sign and exponent, significand
        QTest::addColumn<double>("hertz");    // 0: refused
        QTest::newRow("48 kHz") << QByteArray::fromHex("400ebb80000000000000") << 48000.0;
        QTest::newRow("1 Hz") << QByteArray::fromHex("3fff8000000000000000") << 1.0;
        QTest::newRow("NaN") << QByteArray::fromHex("7fffc000000000000000") << 0.0;
        QTest::newRow("infinite") << QByteArray::fromHex("7fff8000000000000000") << 0.0;
        QTest::newRow("negative") << QByteArray::fromHex("c00ebb80000000000000") << 0.0;
        QTest::newRow("huge") << QByteArray::fromHex("43fe8000000000000000") << 0.0;
        QTest::newRow("tiny") << QByteArray::fromHex("3ff08000000000000000") << 0.0;
        QTest::newRow("0") << QByteArray(10, '\0') << 0.0;
    }

    void aiffRatesThatAreNone()
    {
        QFETCH(QByteArray, rate);
        QFETCH(double, hertz);
        const QByteArray common = QByteArray::fromHex("0001000000640010") + rate; // one channel, 100 frames, 16 bits
        const QByteArray chunks = "AIFFCOMM" + QByteArray::fromHex("00000012") + common + "SSND"
                                  + QByteArray::fromHex("000000d0") + QByteArray(208, '\0');
        writeBytes(path("rate.aiff"), "FORM" + QByteArray::fromHex("00000102") + chunks);
        const std::string refusal =
            errorOf([&] { QCOMPARE(AudioRecording(path("rate.aiff"), false).info().sampleRateHz, hertz); });
        QVERIFY2(refusal.empty() == (hertz > 0.0), refusal.c_str());
        QVERIFY(hertz > 0.0 || contains(refusal, "sample rate"));
    }

    void streamOfUnknownLength()
    {
        writeAudio(path("a.flac"), SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 1, 16000, someNoise(300001));
        QByteArray bytes = readBytes(path("a.flac"));
        bytes[21] = static_cast<char>(bytes[21] & 0xf0); // the stream header's sample count, 36 bits
        writeBytes(path("stream.flac"), bytes.replace(22, 4, QByteArray(4, '\0')));
        const AudioRecording recording(path("stream.flac"), false);
        QCOMPARE(recording.info().sampleCount, Index(300001));
        QVERIFY(contains(recording.info().notes.at(0), "gives no length or more than the file holds"));
        QVERIFY(readAll(recording) == readAll(AudioRecording(path("a.flac"), false)));
    }

    void shrinkingWhileOpen()
    {
        writeAudio(path("shrinks.wav"), SF_FORMAT_WAV | SF_FORMAT_PCM_16, 1, 16000, someNoise(100000));
        const AudioRecording recording(path("shrinks.wav"), false);
        QVERIFY(QFile::resize(QString::fromStdString(path("shrinks.wav")), 1000));
        QVERIFY(contains(errorOf([&] { readAll(recording); }), "was truncated while open"));
        std::vector<float> start(100);
        recording.read(0, 0, 100, start); // what is left can still be read
    }

    void startTimeFromBext()
    {
        QByteArray bext(602, '\0');
        bext.replace(320, 10, "2024-07-26");
        bext.replace(330, 8, "12-34-56");
        QByteArray chunk = "bext" + littleEndian(602, 4) + bext;
        writeBytes(path("bext.wav"), wave(1, 8000, fiveSamples, 10, chunk));
        QCOMPARE(AudioRecording(path("bext.wav"), false).info().startUnixSeconds, std::optional(1721997296.0));

        // The time reference, in samples from midnight, is finer than the clock.
        bext.replace(338, 8, littleEndian(8000u * 3600u + 4u, 8));
        chunk = "bext" + littleEndian(602, 4) + bext;
        writeBytes(path("bext.wav"), wave(1, 8000, fiveSamples, 10, chunk));
        QCOMPARE(AudioRecording(path("bext.wav"), false).info().startUnixSeconds, std::optional(1721955600.0005));

        bext.replace(320, 10, "2024-99-26");
        chunk = "bext" + littleEndian(602, 4) + bext;
        writeBytes(path("bext.wav"), wave(1, 8000, fiveSamples, 10, chunk));
        QVERIFY(!AudioRecording(path("bext.wav"), false).info().startUnixSeconds);
    }

    void startTimeFromWhatRecordersWrite_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QByteArray>("field");
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<int>("lasts");       // s
        QTest::addColumn<double>("expected"); // 0: none
        const double time = 1607991775.0;     // 2020-12-15T00:22:55Z
        const auto comment = [](const char *said) {
            return QByteArray("Recorded at ") + said + " by AudioMoth 0000 at medium gain while battery was 4.0V.";
        };
        QTest::newRow("west") << "20201214_192255.WAV" << QByteArray("ICMT") << comment("19:22:55 14/12/2020 (UTC-5)")
                              << 20 << time;
        QTest::newRow("UTC") << "a.wav" << QByteArray("ICMT") << comment("00:22:55 15/12/2020 (UTC)") << 20 << time;
        QTest::newRow("half an hour") << "a.wav" << QByteArray("ICMT") << comment("05:52:55 15/12/2020 (UTC+5:30)")
                                      << 20 << time;
        QTest::newRow("fraction") << "a.wav" << QByteArray("ICMT") << comment("00:22:55.250 15/12/2020 (UTC)") << 20
                                  << time + 0.25;
        QTest::newRow("no such day") << "a.wav" << QByteArray("ICMT") << comment("00:22:55 31/02/2020 (UTC)") << 20
                                     << 0.0;
        QTest::newRow("no zone") << "a.wav" << QByteArray("ICMT") << comment("00:22:55 15/12/2020") << 20 << 0.0;
        QTest::newRow("GUANO") << "a.wav" << QByteArray("guan")
                               << QByteArray("GUANO|Version: 1.0\nTimestamp: 2020-12-14T19:22:55-05:00\nNote: x") << 20
                               << time;
        QTest::newRow("GUANO without a zone")
            << "a.wav" << QByteArray("guan") << QByteArray("Timestamp: 2020-12-14T19:22:55\n") << 20 << 0.0;
        QTest::newRow("date") << "a.wav" << QByteArray("ICRD") << QByteArray("2020-12-15T00:22:55Z") << 20 << time;
        QTest::newRow("date of the end") << "20201215_002255_x.wav" << QByteArray("ICRD")
                                         << QByteArray("2020-12-15T00:23:15Z") << 20 << time;
        QTest::newRow("date of the end of five minutes")
            << "20201215_002255_x.wav" << QByteArray("ICRD") << QByteArray("2020-12-15 00:27:56") << 300 << time;
        QTest::newRow("date of the end, name in another zone")
            << "20201214_192255_x.wav" << QByteArray("ICRD") << QByteArray("2020-12-15T00:23:15Z") << 20 << time;
        QTest::newRow("date of the start, name in another zone")
            << "20201214_192255_x.wav" << QByteArray("ICRD") << QByteArray("2020-12-15T00:22:55Z") << 20 << time;
        QTest::newRow("date of the start")
            << "20201215_002255_x.wav" << QByteArray("ICRD") << QByteArray("2020-12-15T00:22:55Z") << 20 << time;
    }

    void startTimeFromWhatRecordersWrite()
    {
        QFETCH(QString, name);
        QFETCH(QByteArray, field);
        QFETCH(QByteArray, text);
        QFETCH(int, lasts);
        QFETCH(double, expected);
        const auto chunk = [](const QByteArray &id, QByteArray content) {
            content += QByteArray(content.size() % 2, '\0');
            return id + littleEndian(std::uint64_t(content.size()), 4) + content;
        };
        const QByteArray before =
            field == "guan" ? chunk(field, text) : chunk("LIST", "INFO" + chunk(field, text + '\0'));
        const std::vector<int> samples(std::size_t(lasts) * 400, 7);
        writeBytes(path(qPrintable(name)), wave(1, 400, samples, std::uint32_t(2 * samples.size()), before));
        const AudioRecording recording(path(qPrintable(name)), false);
        QCOMPARE(recording.info().startUnixSeconds.value_or(0.0), expected);
        QCOMPARE(recording.info().notes.size(), std::size_t(expected > 0.0 ? 1 : 0));
    }

    /// Lengths with which libsndfile would go round in circles. A sound list beside them is read.
    void listsThatLeadBackwards()
    {
        const auto chunk = [](const char *name, const QByteArray &content) {
            return name + littleEndian(std::uint64_t(content.size()), 4) + content;
        };
        const QByteArray sound = chunk("LIST", "INFO" + chunk("ICRD", "2024-07-26T01:02:03Z"));
        for (const std::uint32_t length : {0xfffffff8u, 0xfffffff0u, 0xffffffe0u, 0xffffff00u})
            for (const char *name : {"LIST", "INFO"})
                for (const char *kind : {"INFO", "adtl", "exif"}) {
                    const QByteArray bad = chunk(name, QByteArray(kind, 4) + chunk("abcd", "efgh") + "ijkl"
                                                           + littleEndian(length, 4) + QByteArray(64, 'x'));
                    writeBytes(path("list.wav"), wave(1, 8000, fiveSamples, 10, bad + sound));
                    const AudioRecording recording(path("list.wav"), false);
                    QCOMPARE(recording.info().sampleCount, Index(5));
                    QCOMPARE(recording.info().startUnixSeconds, std::optional(1721955723.0));
                }
    }

    void startTimeAndCentreFromAuxi()
    {
        QByteArray auxi;
        for (const int word :
             {2024, 7, 5, 26, 12, 34, 56, 250}) // year, month, day of week, day, hour, minute, second, ms
            auxi += littleEndian(std::uint64_t(word), 2);
        auxi += QByteArray(16, '\0') + littleEndian(77500, 4) + QByteArray(32, '\0');
        writeBytes(path("auxi.wav"),
                   wave(2, 8000, {1, 2, 3, 4}, 8, "auxi" + littleEndian(std::uint64_t(auxi.size()), 4) + auxi));
        const AudioRecording iq(path("auxi.wav"), true);
        QCOMPARE(iq.info().startUnixSeconds, std::optional(1721997296.25));
        QCOMPARE(iq.info().centreHz, 77500.0);
        const AudioRecording real(path("auxi.wav"), false);
        QCOMPARE(real.info().centreHz, 0.0);
        QVERIFY(contains(real.info().notes.back(), "may be I and Q"));
    }

    void threadsReadTheSame_data()
    {
        QTest::addColumn<int>("format");
        QTest::newRow("wav") << (SF_FORMAT_WAV | SF_FORMAT_PCM_16);
        QTest::newRow("flac") << (SF_FORMAT_FLAC | SF_FORMAT_PCM_16);
        QTest::newRow("ogg") << (SF_FORMAT_OGG | SF_FORMAT_VORBIS);
    }

    void threadsReadTheSame()
    {
        QFETCH(int, format);
        writeAudio(path("threads"), format, 1, 16000, someNoise(600000));
        const AudioRecording recording(path("threads"), false);
        const std::vector<float> whole = readAll(AudioRecording(path("threads"), false));
        std::vector<std::vector<float>> results(4);
        {
            std::vector<std::jthread> threads;
            for (std::size_t i = 0; i < results.size(); ++i)
                threads.emplace_back([&, i] { results[i] = readInPieces(recording, 70000, 0, i); });
        }
        for (const std::vector<float> &result : results)
            QVERIFY(result == whole);
    }

    void sharedRecordings()
    {
        if (sharedRecording("s6_dcf77_iq.wav").empty())
            QSKIP("skipped: no ../shared");
        const AudioRecording iq(sharedRecording("s6_dcf77_iq.wav"), true);
        QCOMPARE(iq.info().sampleRateHz, 12001.0);
        QVERIFY(std::abs(iq.info().durationSeconds() - 29.7) < 0.1);
        // DCF77's carrier stands at 0.0 Hz: far more there than 3 kHz away.
        const std::vector<float> samples = readAll(iq);
        QVERIFY(std::norm(fourier(samples.data(), 12001, true, 0.0))
                > 1e3 * std::norm(fourier(samples.data(), 12001, true, 0.25)));

        const AudioRecording mains(sharedRecording("s2_mains_interharmonics.wav"), false);
        QCOMPARE(mains.info().sampleRateHz, 400.0);
        QVERIFY(std::abs(mains.info().durationSeconds() - 861.0) < 1.0);
        for (const char *name : {"s1_ft8_band.wav", "s3_ligo_h1_scaled_f32.wav", "s4a_blue_whale_f32.wav",
                                 "s4b_minke_whale.wav", "s4c_dolphin_whistle.wav"}) {
            const AudioRecording recording(sharedRecording(name), false);
            QVERIFY(readInPieces(recording, 9999) == readAll(recording));
            QVERIFY(readAll(recording) == decodeAudio(sharedRecording(name)));
            QCOMPARE(recording.nonFiniteCount(), Index(0));
        }
    }

private:
    static QByteArray dated()
    {
        return "LIST" + littleEndian(32, 4) + "INFOICRD" + littleEndian(20, 4) + "2024-07-26T01:02:03Z";
    }

    std::string path(const char *name) const { return m_folder.filePath(name).toStdString(); }

    QTemporaryDir m_folder;
};

FAINTLINE_TEST(tst_AudioRecording)
#include "tst_AudioRecording.moc"

#include "signal/formats/RawRecording.h"
#include "support/test.h"

#include "signal/openRecording.h"
#include "support/recordings.h"

using namespace faintline;
using namespace faintline::test;

namespace {

/// One number as its bytes, by Qt's own conversions.
template <class T>
QByteArray bytesOf(T value, bool isBigEndian)
{
    QByteArray bytes(sizeof(T), '\0');
    if (isBigEndian)
        qToBigEndian(value, bytes.data());
    else
        qToLittleEndian(value, bytes.data());
    return bytes;
}

QByteArray numberBytes(const SampleType &type, double x)
{
    const double scaled = std::nearbyint(std::ldexp(x, 8 * type.bytes - 1));
    // Of bytes of I and Q, 0 lies between 127 and 128.
    const double shifted = type.isComplex && type.bytes == 1 ? std::nearbyint(128.0 * x + 127.5)
                                                             : scaled + std::ldexp(1.0, 8 * type.bytes - 1);
    const bool isBig = type.isBigEndian;
    switch (type.number) {
    case SampleType::Number::Float:
        return type.bytes == 4 ? bytesOf(float(x), isBig) : bytesOf(x, isBig);
    case SampleType::Number::Signed:
        return type.bytes == 1   ? bytesOf(static_cast<qint8>(scaled), isBig)
               : type.bytes == 2 ? bytesOf(static_cast<qint16>(scaled), isBig)
                                 : bytesOf(static_cast<qint32>(scaled), isBig);
    case SampleType::Number::Unsigned:
        return type.bytes == 1   ? bytesOf(static_cast<quint8>(shifted), isBig)
               : type.bytes == 2 ? bytesOf(quint16(shifted), isBig)
                                 : bytesOf(quint32(shifted), isBig);
    }
    return {};
}

} // namespace

/// Files of bare samples: every type in both byte orders, channels, headers, and files larger than memory.
class tst_RawRecording : public QObject
{
    Q_OBJECT

private slots:
    void typeNames()
    {
        for (const char *kind : {"c", "r"})
            for (const char *number : {"f32", "f64", "i8", "i16", "i32", "u8", "u16", "u32"})
                for (const char *order : {"_le", "_be"}) {
                    const std::string name =
                        std::string(kind) + number + (std::string(number).size() == 2 ? "" : order);
                    QCOMPARE(parseSampleType(name, "here").name(), name);
                }
        QCOMPARE(parseSampleType("ci16", "here").name(), std::string("ci16_le"));
        for (const char *wrong :
             {"", "c", "f32", "cf16", "ci16_", "ci16_xe", "xi16_le", "ci16_le ", "CI16_LE", "cf32_le_le"})
            QVERIFY(contains(errorOf([&] { parseSampleType(wrong, "here"); }), "expected one of cf32, cf64, ci8"));
    }

    void everyType_data()
    {
        QTest::addColumn<QString>("name");
        for (const char *kind : {"c", "r"})
            for (const char *number : {"f32_le", "f32_be", "f64_le", "f64_be", "i8", "i16_le", "i16_be", "i32_le",
                                       "i32_be", "u8", "u16_le", "u16_be", "u32_le", "u32_be"}) {
                const QString name = QString(kind) + number;
                QTest::newRow(qPrintable(name)) << name;
            }
    }

    void everyType()
    {
        QFETCH(QString, name);
        const SampleType type = parseSampleType(name.toStdString(), "here");
        const std::vector<float> values = someNoise(2 * 3001);
        QByteArray bytes;
        for (const float value : values)
            bytes += numberBytes(type, value == 1.0f ? 0.5 : value);
        writeBytes(path("samples"), bytes);

        OpenOptions options;
        options.rawType = name.toStdString();
        options.rawRateHz = 0.25;
        const RecordingPointer recording = openRecording(path("samples"), options);
        QCOMPARE(recording->info().isComplex, type.isComplex);
        QCOMPARE(recording->info().sampleCount, Index(type.isComplex ? 3001 : 6002));
        QCOMPARE(recording->info().sampleType, name.toStdString());
        QCOMPARE(recording->info().sampleRateHz, 0.25);
        const std::vector<float> whole = readAll(*recording);
        const double step = type.number == SampleType::Number::Float ? 0.0 : std::ldexp(0.51, 1 - 8 * type.bytes);
        QVERIFY(largestDifference(whole, values) <= step + 1e-7);
        QVERIFY(readInPieces(*recording, 77) == whole);
    }

    void knownBytes_data()
    {
        QTest::addColumn<QString>("type");
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<double>("value");
        QTest::newRow("ru8 middle") << "ru8" << QByteArray("\x80", 1) << 0.0;
        QTest::newRow("ru8 lowest") << "ru8" << QByteArray("\x00", 1) << -1.0;
        QTest::newRow("ru8 highest") << "ru8" << QByteArray("\xff", 1) << 127.0 / 128.0;
        QTest::newRow("cu8 below the middle") << "cu8" << QByteArray("\x7f\x80", 2) << -0.5 / 128.0;
        QTest::newRow("cu8 above the middle") << "cu8" << QByteArray("\x80\x7f", 2) << 0.5 / 128.0;
        QTest::newRow("ri8") << "ri8" << QByteArray("\xc0", 1) << -0.5;
        QTest::newRow("ri16_le") << "ri16_le" << QByteArray("\x00\x40", 2) << 0.5;
        QTest::newRow("ri16_be") << "ri16_be" << QByteArray("\x40\x00", 2) << 0.5;
        QTest::newRow("ru16_be") << "ru16_be" << QByteArray("\x00\x00", 2) << -1.0;
        QTest::newRow("ri32_le") << "ri32_le" << QByteArray("\x00\x00\x00\x80", 4) << -1.0;
        QTest::newRow("ru32_be") << "ru32_be" << QByteArray("\xc0\x00\x00\x00", 4) << 0.5;
        QTest::newRow("rf32_be") << "rf32_be" << QByteArray("\x3f\x80\x00\x00", 4) << 1.0;
        QTest::newRow("rf64_le") << "rf64_le" << QByteArray("\x00\x00\x00\x00\x00\x00\xe0\xbf", 8) << -0.5;
        QTest::newRow("rf32_le not a number") << "rf32_le" << QByteArray("\x00\x00\xc0\x7f", 4) << 0.0;
        QTest::newRow("rf64_le beyond float") << "rf64_le" << QByteArray("\x00\x00\x00\x00\x00\x00\xe0\x7f", 8) << 0.0;
    }

    void knownBytes()
    {
        QFETCH(QString, type);
        QFETCH(QByteArray, bytes);
        QFETCH(double, value);
        writeBytes(path("bytes"), bytes);
        const RawRecording recording(path("bytes"), {parseSampleType(type.toStdString(), ""), 1.0, 1, 0, 0});
        QCOMPARE(double(readAll(recording).at(0)), value);
    }

    void channelsAndHeader()
    {
        QByteArray bytes(11, 'x');
        for (int i = 0; i < 500; ++i)
            for (int channel = 0; channel < 3; ++channel)
                bytes +=
                    bytesOf(static_cast<qint16>(64 * channel + i), false) + bytesOf(static_cast<qint16>(-i), false);
        bytes += QByteArray(5, 'y');
        writeBytes(path("channels"), bytes);
        const RawRecording recording(path("channels"), {parseSampleType("ci16", ""), 8000.0, 3, 11, 5});
        QCOMPARE(recording.info().sampleCount, Index(500));
        QCOMPARE(recording.info().channelCount, 3);
        QVERIFY(recording.info().notes.empty());
        const std::vector<float> last = readInPieces(recording, 7, 2);
        for (std::size_t i = 0; i < 500; ++i) {
            QCOMPARE(last[2 * i], (128.0f + float(i)) / 32768.0f);
            QCOMPARE(last[2 * i + 1], -float(i) / 32768.0f);
        }
    }

    void twoRealChannelsAsIq()
    {
        writeBytes(path("pairs.s16"), QByteArray("\x00\x40\x00\xc0", 4));
        OpenOptions options;
        options.iq = true;
        options.rawRateHz = 10.0;
        options.rawChannels = 2;
        const RecordingPointer recording = openRecording(path("pairs.s16"), options);
        QVERIFY(recording->info().isComplex);
        QCOMPARE(recording->info().channelCount, 1);
        QVERIFY((readAll(*recording) == std::vector<float>{0.5f, -0.5f}));
        options.rawChannels = 1;
        QVERIFY(contains(errorOf([&] { openRecording(path("pairs.s16"), options); }), "I/Q needs an even number"));
    }

    void cutInTheMiddleOfASample()
    {
        writeBytes(path("cut"), QByteArray(8 * 10 + 3, '\0'));
        const RawRecording recording(path("cut"), {parseSampleType("cf32", ""), 8000.0, 1, 0, 0});
        QCOMPARE(recording.info().sampleCount, Index(10));
        QVERIFY(contains(recording.info().notes.at(0), "last 3 bytes"));
    }

    void largerThanMemory()
    {
        QFile file(QString::fromStdString(path("huge.cs16")));
        constexpr Index bytes = Index(20) << 30;
        if (!file.open(QIODevice::ReadWrite) || !file.resize(bytes))
            QSKIP("skipped: no sparse file of 20 GB here");
        const QByteArray end("\x00\x40\x00\xc0", 4);
        QVERIFY(file.seek(bytes - 4) && file.write(end) == 4);
        file.close();

        QElapsedTimer timer;
        timer.start();
        OpenOptions options;
        options.rawRateHz = 1e6;
        const RecordingPointer recording = openRecording(file.fileName().toStdString(), options);
        QCOMPARE(recording->info().sampleCount, bytes / 4);
        std::vector<float> last(4);
        recording->read(0, bytes / 4 - 2, 2, last);
        QVERIFY((last == std::vector<float>{0, 0, 0.5f, -0.5f}));
        QVERIFY(recordingHash(file.fileName().toStdString()).starts_with("part:"));
        QVERIFY(timer.elapsed() < 2000);
        file.remove();
    }

    void shrinkingWhileOpen()
    {
        writeBytes(path("shrinks"), QByteArray(400000, '\1'));
        const RawRecording recording(path("shrinks"), {parseSampleType("ri16", ""), 8000.0, 1, 0, 0});
        QVERIFY(QFile::resize(QString::fromStdString(path("shrinks")), 1000));
        QVERIFY(contains(errorOf([&] { readAll(recording); }), "was truncated while open"));
    }

    void refusals()
    {
        writeBytes(path("some.cf32"), QByteArray(64, '\0'));
        const auto refusal = [&](const char *type, double rate, int channels, Index header) {
            return errorOf([&] {
                RawRecording(path("some.cf32"), {parseSampleType(type, ""), rate, channels, header, 0});
            });
        };
        QVERIFY(contains(refusal("cf32", 0.0, 1, 0), "its sample rate, 0 Hz, must be above 0"));
        QVERIFY(contains(refusal("cf32", -1.0, 1, 0), "must be above 0"));
        QVERIFY(contains(refusal("cf32", NAN, 1, 0), "must be above 0"));
        QVERIFY(contains(refusal("cf32", 1.0, 0, 0), "its channel count, 0, must lie in 1 … 1024"));
        QVERIFY(contains(refusal("cf32", 1.0, 2000, 0), "must lie in 1 … 1024"));
        QVERIFY(contains(refusal("cf32", 1.0, 9, 0), "contains no complete sample: 64 bytes, but one sample takes 72"));
        QVERIFY(contains(refusal("cf32", 1.0, 1, 64), "after a header of 64"));
        QVERIFY(contains(refusal("cf32", 1.0, 1, std::numeric_limits<Index>::max()), "contains no complete sample"));
        QVERIFY(contains(refusal("cf32", 1.0, 1, -1), "must not be negative"));
    }

private:
    std::string path(const char *name) const { return m_folder.filePath(name).toStdString(); }

    QTemporaryDir m_folder;
};

FAINTLINE_TEST(tst_RawRecording)
#include "tst_RawRecording.moc"

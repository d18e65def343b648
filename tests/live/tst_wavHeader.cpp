#include "live/sources/PipeSource.h"
#include "support/files.h"
#include "support/test.h"

#include "support/errors.h"

#include <cstring>

using namespace faintline;
using namespace faintline::test;

namespace {

QByteArray chunk(const char *name, const QByteArray &content)
{
    QByteArray text = QByteArray(name) + littleEndian(std::uint32_t(content.size()), 4) + content;
    return content.size() % 2 ? text + '\0' : text;
}

QByteArray format(int tag, int channels, int rate, int bits)
{
    const int frame = channels * bits / 8;
    return littleEndian(std::uint32_t(tag), 2) + littleEndian(std::uint32_t(channels), 2)
           + littleEndian(std::uint32_t(rate), 4) + littleEndian(std::uint32_t(rate * frame), 4)
           + littleEndian(std::uint32_t(frame), 2) + littleEndian(std::uint32_t(bits), 2);
}

QByteArray wav(const QByteArray &chunks, const char *kind = "RIFF")
{
    return QByteArray(kind) + littleEndian(0xffffffff, 4) + "WAVE" + chunks + "data"
           + littleEndian(0xffffffff, 4); // of a pipe
}

/// Parses the bytes; `left`: how many follow the header.
WavHeader parse(const QByteArray &bytes, qsizetype *left = nullptr)
{
    qsizetype at = 0;
    const WavHeader header = readWavHeader(
        [&](std::span<std::byte> out) {
            if (at + std::ssize(out) > bytes.size())
                return false;
            std::memcpy(out.data(), bytes.constData() + at, out.size());
            at += std::ssize(out);
            return true;
        },
        "pipe");
    if (left)
        *left = bytes.size() - at;
    return header;
}

} // namespace

/// Headers of piped WAV streams, written here by the format's definition.
class tst_wavHeader : public QObject
{
    Q_OBJECT

private slots:
    void formats_data()
    {
        QTest::addColumn<int>("tag");
        QTest::addColumn<int>("bits");
        QTest::addColumn<QString>("type");
        QTest::newRow("8 bits are unsigned") << 1 << 8 << "ru8";
        QTest::newRow("16 bits") << 1 << 16 << "ri16_le";
        QTest::newRow("24 bits appear as 32") << 1 << 24 << "ri32_le";
        QTest::newRow("32 bits") << 1 << 32 << "ri32_le";
        QTest::newRow("float") << 3 << 32 << "rf32_le";
        QTest::newRow("double") << 3 << 64 << "rf64_le";
    }

    void formats()
    {
        QFETCH(int, tag);
        QFETCH(int, bits);
        QFETCH(QString, type);
        qsizetype left = -1;
        const WavHeader header = parse(wav(chunk("fmt ", format(tag, 2, 44100, bits))) + "samples", &left);
        QCOMPARE(QString::fromStdString(header.format.type.name()), type);
        QCOMPARE(header.format.channelCount, 2);
        QCOMPARE(header.format.sampleRateHz, 44100.0);
        QCOMPARE(header.isPacked24, bits == 24);
        QCOMPARE(left, qsizetype(7)); // the first sample is the next byte
    }

    void theExtensibleFormNamesItsFormatLater()
    {
        const QByteArray guid = littleEndian(3, 2) + QByteArray(14, '\0'); // its first number is the format
        const QByteArray extensible =
            format(0xfffe, 1, 8000, 32) + littleEndian(22, 2) + littleEndian(32, 2) + littleEndian(4, 4) + guid;
        QCOMPARE(parse(wav(chunk("fmt ", extensible), "RF64")).format.type.name(), std::string("rf32_le"));
    }

    void otherChunksAreSkippedWithTheirPadding()
    {
        qsizetype left = -1;
        const QByteArray before = chunk("JUNK", QByteArray(5, 'x')) + chunk("LIST", QByteArray(10001, 'y'));
        const WavHeader header = parse(wav(before + chunk("fmt ", format(1, 1, 22050, 16)) + before) + "ab", &left);
        QCOMPARE(header.format.sampleRateHz, 22050.0);
        QCOMPARE(left, qsizetype(2));
    }

    void refusals_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QByteArray>("why");
        const QByteArray good = chunk("fmt ", format(1, 1, 8000, 16));
        QTest::newRow("another file") << QByteArray("OggS00000000000000000000")
                                      << QByteArray("does not begin as a WAV");
        QTest::newRow("empty") << QByteArray() << QByteArray("ended within its header");
        QTest::newRow("cut") << wav(good).chopped(9) << QByteArray("ended within its header");
        QTest::newRow("no format") << wav({}) << QByteArray("has no format");
        QTest::newRow("short format") << wav(chunk("fmt ", QByteArray(14, '\1'))) << QByteArray("incomplete");
        QTest::newRow("mu-law") << wav(chunk("fmt ", format(7, 1, 8000, 8))) << QByteArray("format 7 with 8 bits");
        QTest::newRow("20 bits") << wav(chunk("fmt ", format(1, 1, 8000, 20))) << QByteArray("with 20 bits");
        QTest::newRow("no channels") << wav(chunk("fmt ", format(1, 0, 8000, 16))) << QByteArray("0 channels");
        QTest::newRow("no rate") << wav(chunk("fmt ", format(1, 1, 0, 16))) << QByteArray("at 0 Hz");
        QByteArray many;
        for (int i = 0; i < 1001; ++i)
            many += chunk("JUNK", {});
        QTest::newRow("chunks without end") << wav(many) << QByteArray("first thousand chunks");
    }

    void refusals()
    {
        QFETCH(QByteArray, bytes);
        QFETCH(QByteArray, why);
        const std::string error = errorOf([&] { parse(bytes); });
        QVERIFY2(contains(error, "pipe: ") && contains(error, why.toStdString()), error.c_str());
    }

    void samplesEndAtTheirLength_data()
    {
        QTest::addColumn<qint64>("declared");
        QTest::addColumn<QByteArray>("behind"); // 1000 bytes of samples
        QTest::addColumn<qsizetype>("kept");
        const QByteArray text = chunk("iXML", QByteArray(20000, 'x'));
        const QByteArray samples(5000, '\xfe');
        QTest::newRow("a chunk") << qint64(1000) << text << qsizetype(1000);
        QTest::newRow("chunks of other names") << qint64(1000) << chunk("abcd", "efg") + text << qsizetype(1000);
        QTest::newRow("nothing") << qint64(1000) << QByteArray() << qsizetype(1000);
        QTest::newRow("padding") << qint64(1000) << QByteArray(512, '\0') << qsizetype(1000);
        QTest::newRow("samples") << qint64(1000) << samples << qsizetype(6000);
        QTest::newRow("silence") << qint64(1000) << QByteArray(70000, '\0') << qsizetype(71000);
        QTest::newRow("an odd length with its padding") << qint64(999) << text << qsizetype(999);
        QTest::newRow("an odd length without") << qint64(1001) << text.left(1) + text << qsizetype(1001);
        QTest::newRow("ended early") << qint64(5000) << QByteArray() << qsizetype(1000);
        for (const qint64 unknown : {0LL, 0x7ffff000LL, 0x7fffffffLL, 0xffffffffLL, 0xffffffdaLL})
            QTest::addRow("unknown, %llx", unknown) << unknown << text << 1000 + text.size();
    }

    // In a stream as in a file, however it is divided.
    void samplesEndAtTheirLength()
    {
        QFETCH(qint64, declared);
        QFETCH(QByteArray, behind);
        QFETCH(qsizetype, kept);
        WavHeader header;
        header.dataBytes = declared;
        const QByteArray stream = QByteArray(1000, '\1') + behind;
        for (const qsizetype piece : {1, 7, 1000, 100000}) {
            WavSamples samples(header);
            qsizetype heard = 0;
            for (qsizetype at = 0; at <= stream.size(); at += piece) {
                const auto bytes =
                    std::as_bytes(std::span(stream.constData() + at, std::size_t(std::min(piece, stream.size() - at))));
                heard += std::ssize(samples.take({bytes.begin(), bytes.end()}, false));
            }
            heard += std::ssize(samples.take({}, true));
            QCOMPARE(heard, kept);
        }
    }

    void integersOf24BitsKeepTheirValue()
    {
        for (const int value : {0, 1, -1, 8388607, -8388608, 123456, -123456}) {
            const QByteArray packed = littleEndian(std::uint32_t(value), 3);
            const auto wide = expand24(std::as_bytes(std::span(packed.constData(), 3)));
            QCOMPARE(wide.size(), std::size_t(4));
            std::int32_t read = 0;
            std::memcpy(&read, wide.data(), 4);
            QCOMPARE(read, value * 256); // the same fraction of full scale
        }
    }
};

FAINTLINE_TEST(tst_wavHeader)
#include "tst_wavHeader.moc"

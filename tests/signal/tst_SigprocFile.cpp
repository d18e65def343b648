#include "signal/formats/SigprocFile.h"
#include "support/test.h"

#include "support/recordings.h"

#include <cstring>

using namespace faintline;
using namespace faintline::test;

namespace {

template <class T>
QByteArray bytesOf(T value)
{
    QByteArray bytes(int(sizeof value), '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}

QByteArray word(const QByteArray &text)
{
    return bytesOf(std::int32_t(text.size())) + text;
}

/// A header put together by hand; of the fields those that are given replace the usual ones.
struct Header {
    std::int32_t nchans = 4;
    std::int32_t nbits = 8;
    std::int32_t nifs = 1;
    double fch1 = 1420.0;
    double foff = -0.5;
    double tsamp = 0.25;
    QByteArray more{};

    QByteArray bytes() const
    {
        return word("HEADER_START") + word("source_name") + word("B0329+54") + word("nchans") + bytesOf(nchans)
               + word("nbits") + bytesOf(nbits) + word("nifs") + bytesOf(nifs) + word("fch1") + bytesOf(fch1)
               + word("foff") + bytesOf(foff) + word("tsamp") + bytesOf(tsamp) + more + word("HEADER_END");
    }
};

/// Three spectra of four channels, the file's first channel first.
QByteArray twelveBytes()
{
    return QByteArray("\x00\x01\x02\x03\x10\x11\x12\x13\xf0\xf1\xf2\xff", 12);
}

std::vector<float> readPart(const SigprocFile &file, const PowerPart &part)
{
    std::vector<float> values(std::size_t(part.frames * part.cells), -1.0f);
    file.read(part, values);
    return values;
}

} // namespace

/// Filterbanks put together byte by byte: every width of a value, both directions of the channels, hostile headers.
class tst_SigprocFile : public QObject
{
    Q_OBJECT

private slots:
    void axesAndTime()
    {
        Header header;
        header.more = word("tstart") + bytesOf(40588.5); // noon of 1970-01-02
        const SigprocFile file(write(header.bytes() + twelveBytes()));
        const PowerInfo &info = file.info();
        QCOMPARE(info.container, std::string("sigproc filterbank"));
        QCOMPARE(info.sampleType, std::string("uint8"));
        QCOMPARE(info.frequency.count, Index(4));
        QCOMPARE(info.frequency.first, 1418.5e6);
        QCOMPARE(info.frequency.step, 0.5e6);
        QCOMPARE(info.time.count, Index(3));
        QCOMPARE(info.time.first, 0.125); // the middle
        QCOMPARE(info.time.step, 0.25);
        QCOMPARE(*info.startUnixSeconds, 1.5 * 86400.0);
        QCOMPARE(info.channelCount, 1);
        QCOMPARE(info.quantum, 0.0);
        QVERIFY(info.notes.empty());
        QVERIFY(!SigprocFile(write(Header().bytes() + twelveBytes())).info().startUnixSeconds);
    }

    void channelsAscendWhicheverWayTheyLie()
    {
        const PowerPart second{0, 1, 1, 0, 4};
        QCOMPARE(readPart(SigprocFile(write(Header().bytes() + twelveBytes())), second),
                 (std::vector<float>{19.0f, 18.0f, 17.0f, 16.0f}));
        Header upward;
        upward.foff = 0.5;
        const SigprocFile file(write(upward.bytes() + twelveBytes()));
        QCOMPARE(readPart(file, second), (std::vector<float>{16.0f, 17.0f, 18.0f, 19.0f}));
        QCOMPARE(file.info().frequency.first, 1420e6);
    }

    void widthsOfValues_data()
    {
        QTest::addColumn<int>("bits");
        QTest::addColumn<QByteArray>("more");
        QTest::addColumn<QByteArray>("data");
        QTest::addColumn<QString>("type");
        QTest::addColumn<std::vector<float>>("values");
        const std::vector<float> ones{1, 0, 1, 1, 0, 0, 1, 0};
        QTest::newRow("1 bit") << 1 << QByteArray() << QByteArray("\x4d", 1) << "uint1" << ones; // 0100 1101
        QTest::newRow("2 bits") << 2 << QByteArray() << QByteArray("\xe4\x1b", 2) << "uint2"
                                << std::vector<float>{0, 1, 2, 3, 3, 2, 1, 0};
        QTest::newRow("4 bits") << 4 << QByteArray() << QByteArray("\x10\x32\x54\xfe", 4) << "uint4"
                                << std::vector<float>{0, 1, 2, 3, 4, 5, 14, 15};
        const QByteArray eight("\x00\x01\x7f\x80\x81\xfe\xff\x40", 8);
        QTest::newRow("8 bits") << 8 << QByteArray() << eight << "uint8"
                                << std::vector<float>{0, 1, 127, 128, 129, 254, 255, 64};
        // A signed byte is lifted by 128: power is not negative.
        QTest::newRow("8 bits, signed") << 8 << word("signed") + QByteArray("\x01", 1) << eight << "int8"
                                        << std::vector<float>{128, 129, 255, 0, 1, 126, 127, 192};
        QByteArray sixteen;
        QByteArray floats;
        const std::vector<float> large{0, 1, 255, 256, 32767, 32768, 65534, 65535};
        for (const float value : large) {
            sixteen += bytesOf(std::uint16_t(value));
            floats += bytesOf(value + 0.25f);
        }
        QTest::newRow("16 bits") << 16 << QByteArray() << sixteen << "uint16" << large;
        std::vector<float> quarters = large;
        for (float &value : quarters)
            value += 0.25f;
        QTest::newRow("32 bits") << 32 << QByteArray() << floats << "float32" << quarters;
    }

    void widthsOfValues()
    {
        QFETCH(int, bits);
        QFETCH(QByteArray, more);
        QFETCH(QByteArray, data);
        QFETCH(QString, type);
        QFETCH(std::vector<float>, values);
        Header header;
        header.nchans = 8;
        header.nbits = bits;
        header.foff = 1.0;
        header.more = more;
        const SigprocFile file(write(header.bytes() + data));
        QCOMPARE(file.info().sampleType, type.toStdString());
        QCOMPARE(file.info().quantum, bits < 8 ? 1.0 : 0.0);
        QCOMPARE(readPart(file, {0, 0, 1, 0, 8}), values);
    }

    void polarisationsLieSpectrumBySpectrum()
    {
        Header header;
        header.nchans = 2;
        header.nifs = 2;
        header.foff = 1.0;
        const SigprocFile file(write(header.bytes() + twelveBytes()));
        QCOMPARE(file.info().channelCount, 2);
        QCOMPARE(readPart(file, {0, 0, 3, 0, 2}), (std::vector<float>{0, 1, 16, 17, 240, 241}));
        QCOMPARE(readPart(file, {1, 0, 3, 0, 2}), (std::vector<float>{2, 3, 18, 19, 242, 255}));
    }

    void anyPartIsThatOfTheWhole_data()
    {
        QTest::addColumn<int>("bits");
        for (const int bits : {1, 2, 4, 8, 16, 32})
            QTest::addRow("%d bits", bits) << bits;
    }

    // Parts that begin and end within a byte, in either direction of the channels.
    void anyPartIsThatOfTheWhole()
    {
        QFETCH(int, bits);
        constexpr Index channels = 24;
        constexpr Index frames = 5;
        QByteArray data;
        Random random(71, std::uint64_t(bits));
        for (Index i = 0; i < frames * channels * bits / 8; ++i)
            data += char(random.bits() & (bits == 32 ? 0x3fu : 0xffu)); // floats that are finite
        for (const double foff : {-1.0, 1.0}) {
            Header header;
            header.nchans = channels;
            header.nbits = bits;
            header.foff = foff;
            const SigprocFile file(write(header.bytes() + data));
            const std::vector<float> whole = readPart(file, {0, 0, frames, 0, channels});
            for (int i = 0; i < 60; ++i) {
                const auto firstFrame = Index(random.uniform() * double(frames));
                const auto firstCell = Index(random.uniform() * double(channels));
                const PowerPart part{0, firstFrame, 1 + Index(random.uniform() * double(frames - firstFrame)),
                                     firstCell, 1 + Index(random.uniform() * double(channels - firstCell))};
                std::vector<float> expected;
                for (Index frame = 0; frame < part.frames; ++frame)
                    for (Index cell = 0; cell < part.cells; ++cell)
                        expected.push_back(whole[std::size_t((firstFrame + frame) * channels + firstCell + cell)]);
                QVERIFY(readPart(file, part) == expected);
            }
        }
    }

    void endsThatAreMissing()
    {
        const SigprocFile cut(write(Header().bytes() + twelveBytes().left(11)));
        QCOMPARE(cut.info().time.count, Index(2));
        QCOMPARE(cut.info().notes, std::vector<std::string>{"The file ends within a spectrum, which is omitted."});
        Header claims;
        claims.more = word("nsamples") + bytesOf(std::int32_t(900));
        QCOMPARE(SigprocFile(write(claims.bytes() + twelveBytes())).info().notes,
                 std::vector<std::string>{"The header claims 900 spectra; the 3 existing ones are read."});
        claims.more = word("nsamples") + bytesOf(std::int32_t(3));
        QVERIFY(SigprocFile(write(claims.bytes() + twelveBytes())).info().notes.empty());
    }

    void recognisedByItsBeginning()
    {
        QVERIFY(SigprocFile::recognises(write(Header().bytes() + twelveBytes())));
        QVERIFY(SigprocFile::recognises(write(word("HEADER_START"))));
        QVERIFY(!SigprocFile::recognises(write(word("HEADER_STARS"))));
        QVERIFY(!SigprocFile::recognises(write(word("HEADER_START").left(15))));
        QVERIFY(!SigprocFile::recognises(write(QByteArray())));
    }

    void refusals_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QString>("words");
        const QByteArray data = twelveBytes();
        const auto with = [&](auto change) {
            Header header;
            change(header);
            return header.bytes() + data;
        };
        QTest::newRow("another file") << word("RIFF") + QByteArray(100, 'x') << "is not a sigproc filterbank";
        QTest::newRow("a keyword without letters")
            << QByteArray(8, '\0') << "its filterbank header has a keyword of 0 characters; the length must be 1 … 255";
        QTest::newRow("a keyword that is not known")
            << with([](Header &h) { h.more = word("nchan") + bytesOf(4); })
            << "its filterbank header has the keyword nchan, which is unknown, as is the length of its value";
        QTest::newRow("a frequency for each channel")
            << with([](Header &h) { h.more = word("FREQUENCY_START"); })
            << "lists a frequency for each channel; only evenly spaced channels (fch1, foff) are supported";
        QTest::newRow("no channels") << with([](Header &h) { h.nchans = 0; }) << "nchans = 0: must lie in 1 … 67108864";
        QTest::newRow("7 bits") << with([](Header &h) { h.nbits = 7; }) << "nbits = 7: must be 1, 2, 4, 8, 16 or 32";
        QTest::newRow("64 bits") << with([](Header &h) { h.nbits = 64; }) << "nbits = 64: must lie in 1 … 32";
        QTest::newRow("no IF") << with([](Header &h) { h.nifs = 0; }) << "nifs = 0: must lie in 1 … 64";
        QTest::newRow("bits that fill no byte")
            << with([](Header &h) { h.nchans = 3, h.nbits = 2; }) << "nchans = 3: of 2 bits do not fill whole bytes";
        QTest::newRow("not one spectrum")
            << with([](Header &h) { h.nchans = 13; }) << "holds no complete spectrum of its 13 channels";
        QTest::newRow("no distance") << with([](Header &h) { h.foff = 0.0; })
                                     << "foff = 0: must be the channel spacing, MHz";
        QTest::newRow("no time") << with([](Header &h) { h.tsamp = 0.0; }) << "tsamp = 0: must lie in";
        QTest::newRow("no number") << with([](Header &h) { h.fch1 = std::nan(""); }) << "fch1 = nan: must lie in";
        QTest::newRow("no frequency") << word("HEADER_START") + word("nchans") + bytesOf(4) + word("nbits") + bytesOf(8)
                                             + word("HEADER_END") + data
                                      << "its filterbank header has no fch1";
    }

    void refusals()
    {
        QFETCH(QByteArray, bytes);
        QFETCH(QString, words);
        const std::string path = write(bytes);
        const std::string refusal = errorOf([&] { SigprocFile file(path); });
        QVERIFY2(refusal.starts_with(path) && contains(refusal, words.toStdString()), refusal.c_str());
    }

    void cutShortAnywhereInTheHeader()
    {
        const QByteArray header = Header().bytes();
        for (int length = 0; length < header.size(); ++length)
            QVERIFY(contains(errorOf([&] { SigprocFile file(write(header.left(length))); }), "truncated or longer"));
        QVERIFY(contains(errorOf([&] { SigprocFile file(write(header)); }), "holds no complete spectrum"));
    }

    void aFileThatShrinks()
    {
        const std::string path = write(Header().bytes() + twelveBytes());
        const SigprocFile file(path);
        QVERIFY(QFile::resize(QString::fromStdString(path), Header().bytes().size() + 10));
        QCOMPARE(readPart(file, {0, 1, 1, 0, 4}).size(), std::size_t(4));
        QCOMPARE(errorOf([&] { readPart(file, {0, 2, 1, 0, 4}); }), path + ": was truncated while open");
    }

private:
    std::string write(const QByteArray &bytes) const
    {
        const std::string path = m_folder.filePath("a.fil").toStdString();
        writeBytes(path, bytes);
        return path;
    }

    QTemporaryDir m_folder;
};

FAINTLINE_TEST(tst_SigprocFile)
#include "tst_SigprocFile.moc"

#include "signal/formats/SigmfRecording.h"
#include "support/test.h"

#include "signal/openRecording.h"
#include "support/recordings.h"

using namespace faintline;
using namespace faintline::test;

/// SigMF pairs: what is taken from the metadata, and what is said of bad ones.
class tst_SigmfRecording : public QObject
{
    Q_OBJECT

private slots:
    void init();
    void everythingThatIsRead();
    void eitherNameOpens();
    void offsetMovesTheStart();
    void captureWithAnotherFrequency();
    void gapsKeepTheirPlaces_data();
    void gapsKeepTheirPlaces();
    void mostTimesCount();
    void datasetOfAnotherName();
    void realPairsAsIq();
    void badMetadata_data();
    void badMetadata();
    void missingFiles();
    void truncatedMetadataIsRefused();
    void deepMetadataIsRefused();
    void sharedRecording();

private:
    std::string path(const char *name) const { return m_folder->filePath(name).toStdString(); }
    std::string write(const QByteArray &meta) const
    {
        writeBytes(path("a.sigmf-meta"), meta);
        return path("a.sigmf-meta");
    }

    std::unique_ptr<QTemporaryDir> m_folder;
};

namespace {

const QByteArray fullMeta = R"({
 "global": {"core:datatype": "ci16_le", "core:sample_rate": 48000.5, "core:version": "1.0.0", "core:num_channels": 2},
 "captures": [{"core:sample_start": 0, "core:frequency": 77500, "core:datetime": "2024-07-26T00:00:00.25Z",
               "core:header_bytes": 4}],
 "annotations": []
})";

} // namespace

void tst_SigmfRecording::init()
{
    m_folder = std::make_unique<QTemporaryDir>();
    writeBytes(path("a.sigmf-data"),
               QByteArray("head\x00\x40\x00\xc0\x00\x20\x00\xe0\x00\x00\x00\x40\x00\x00\x00\x80", 20));
}

void tst_SigmfRecording::everythingThatIsRead()
{
    const SigmfRecording recording(write(fullMeta));
    const RecordingInfo &info = recording.info();
    QCOMPARE(info.container, std::string("SigMF"));
    QCOMPARE(info.sampleType, std::string("ci16_le"));
    QCOMPARE(info.sampleRateHz, 48000.5);
    QCOMPARE(info.channelCount, 2);
    QCOMPARE(info.sampleCount, Index(2));
    QCOMPARE(info.centreHz, 77500.0);
    QCOMPARE(info.startUnixSeconds, std::optional(1721952000.25));
    QVERIFY(info.isComplex);
    QVERIFY(info.notes.empty());
    QVERIFY((readAll(recording, 0) == std::vector<float>{0.5f, -0.5f, 0.0f, 0.5f}));
    QVERIFY((readAll(recording, 1) == std::vector<float>{0.25f, -0.25f, 0.0f, -1.0f}));
}

void tst_SigmfRecording::eitherNameOpens()
{
    write(fullMeta);
    QCOMPARE(openRecording(path("a.sigmf-data"))->info().centreHz, 77500.0);
    QCOMPARE(openRecording(path("a.sigmf-meta"))->info().centreHz, 77500.0);
    QCOMPARE(recordingHash(path("a.sigmf-meta")), recordingHash(path("a.sigmf-data")));
}

void tst_SigmfRecording::offsetMovesTheStart()
{
    QByteArray meta = fullMeta;
    meta.replace("\"core:num_channels\": 2", "\"core:offset\": 1000");
    meta.replace("\"core:sample_start\": 0", "\"core:sample_start\": 97001");
    const SigmfRecording recording(write(meta));
    QCOMPARE(recording.info().startUnixSeconds, std::optional(1721952000.25 - 96001.0 / 48000.5));
    QCOMPARE(recording.info().firstNumber, Index(1000));
}

void tst_SigmfRecording::captureWithAnotherFrequency()
{
    QByteArray meta = fullMeta;
    meta.replace("}],", "}, {\"core:sample_start\": 1, \"core:frequency\": 99}],");
    const SigmfRecording recording(write(meta));
    QCOMPARE(recording.info().centreHz, 77500.0);
    QVERIFY(contains(recording.info().notes.at(0), "From sample 1 on, another capture has the centre frequency 99 Hz"));
}

// Bytes 0 … 19 as samples, 0 where nothing was heard. What makes no sense is told and left out.
void tst_SigmfRecording::gapsKeepTheirPlaces_data()
{
    QTest::addColumn<QByteArray>("captures");
    QTest::addColumn<QByteArray>("expected"); // a letter a sample, a dot for a gap
    QTest::addColumn<int>("notes");
    const auto capture = [](const char *start, const char *global) {
        return QByteArray(R"({"core:sample_start": )") + start + R"(, "core:global_index": )" + global + "}";
    };
    QTest::newRow("no index") << QByteArray(R"({"core:sample_start": 0}, {"core:sample_start": 5})")
                              << QByteArray("abcdefghijklmnopqrst") << 0;
    QTest::newRow("no gap") << capture("0", "1000") + "," + capture("7", "1007") << QByteArray("abcdefghijklmnopqrst")
                            << 0;
    QTest::newRow("two gaps") << capture("0", "1000") + "," + capture("3", "1005") + "," + capture("10", "1013")
                              << QByteArray("abc..defghij.klmnopqrst") << 1;
    QTest::newRow("one after the other") << capture("0", "0") + "," + capture("3", "4") + "," + capture("3", "6")
                                         << QByteArray("abc...defghijklmnopqrst") << 1;
    QTest::newRow("from the second capture on")
        << QByteArray(R"({"core:sample_start": 0},)") + capture("2", "9") + "," + capture("4", "13")
        << QByteArray("abcd..efghijklmnopqrst") << 1;
    QTest::newRow("behind the end of the file")
        << capture("0", "0") + "," + capture("20", "25") << QByteArray("abcdefghijklmnopqrst") << 0;
    QTest::newRow("backward") << capture("0", "50") + "," + capture("7", "40") << QByteArray("abcdefghijklmnopqrst")
                              << 1;
    QTest::newRow("in a thousand years") << capture("0", "0") + "," + capture("7", "9000000000000000")
                                         << QByteArray("abcdefghijklmnopqrst") << 1;
    const auto dated = [](const char *start, const char *time, const char *more = "") {
        return QByteArray(R"({"core:sample_start": )") + start + R"(, "core:datetime": "2026-03-01T)" + time + "\""
               + more + "}";
    };
    QTest::newRow("by their times") << dated("0", "12:00:00.00Z") + "," + dated("5", "12:00:00.13Z")
                                    << "abcde" + QByteArray(8, '.') + "fghijklmnopqrst" << 2;
    QTest::newRow("two by their times") << dated("2", "12:00:00.02Z") + "," + dated("5", "12:00:00.13Z") + ","
                                               + dated("7", "12:00:00.20Z")
                                        << "abcde" + QByteArray(8, '.') + "fg.....hijklmnopqrst" << 3;
    QTest::newRow("times within their resolution")
        << dated("0", "12:00:00.000Z") + "," + dated("5", "12:00:00.055Z") << QByteArray("abcdefghijklmnopqrst") << 0;
    QTest::newRow("within whole seconds")
        << dated("0", "12:00:00Z") + "," + dated("5", "12:00:01Z") << QByteArray("abcdefghijklmnopqrst") << 0;
    QTest::newRow("by whole seconds") << dated("0", "12:00:00Z") + "," + dated("5", "12:00:03Z")
                                      << "abcde" + QByteArray(295, '.') + "fghijklmnopqrst" << 2;
    QTest::newRow("earlier") << dated("0", "12:00:10Z") + "," + dated("5", "12:00:00Z")
                             << QByteArray("abcdefghijklmnopqrst") << 1;
    QTest::newRow("later than the index") << dated("0", "12:00:00Z", ", \"core:global_index\": 0") + ","
                                                 + dated("5", "12:01:00Z", ", \"core:global_index\": 7")
                                          << QByteArray("abcde..fghijklmnopqrst") << 2;
    QTest::newRow("frequency of the first only")
        << QByteArray(R"({"core:sample_start": 0, "core:frequency": 1e8}, {"core:sample_start": 5})")
        << QByteArray("abcdefghijklmnopqrst") << 0;
    QTest::newRow("no number") << capture("0", "\"zero\"") + "," + capture("7", "-5")
                               << QByteArray("abcdefghijklmnopqrst") << 0;
}

void tst_SigmfRecording::gapsKeepTheirPlaces()
{
    QFETCH(QByteArray, captures);
    QFETCH(QByteArray, expected);
    QFETCH(int, notes);
    writeBytes(path("a.sigmf-data"), "abcdefghijklmnopqrst");
    const SigmfRecording recording(
        write(R"({"global": {"core:datatype": "ri8", "core:sample_rate": 100}, "captures": [)" + captures + "]}"));
    QCOMPARE(int(recording.info().notes.size()), notes);
    QCOMPARE(recording.info().sampleCount, Index(expected.size()));
    QByteArray heard;
    for (const float value : readAll(recording))
        heard.append(value == 0.0f ? '.' : static_cast<char>(std::lround(value * 128.0f)));
    QCOMPARE(heard, expected);
    QVERIFY(readInPieces(recording, 4) == readAll(recording));
    for (Index first = 0; first < expected.size(); ++first)
        for (Index count = 1; first + count <= expected.size(); ++count)
            QCOMPARE(recording.isWhole(first, count), !expected.mid(first, count).contains('.'));
    std::vector<float> beyond(8, 1.0f);
    recording.read(0, recording.info().sampleCount - 2, 8, beyond);
    QCOMPARE(std::count(beyond.begin(), beyond.end(), 0.0f), 6);
}

/// Of captures whose places are known by an index, a stale time does not move the others, whichever it is.
void tst_SigmfRecording::mostTimesCount()
{
    for (const int stale : {0, 2, 4}) {
        QByteArray captures;
        for (int i = 0; i < 5; ++i)
            captures += (i > 0 ? "," : "") + QByteArray(R"({"core:sample_start": )") + QByteArray::number(10 * i)
                        + R"(, "core:global_index": )" + QByteArray::number(1000 + 10 * i)
                        + R"(, "core:datetime": "2026-03-01T)" + (i == stale ? "11:50" : "12:00") + ":00."
                        + QByteArray::number(25 + i) + "Z\"}";
        writeBytes(path("a.sigmf-data"), QByteArray(50, 'a'));
        const SigmfRecording recording(write(R"({"global": {"core:datatype": "ri8", "core:sample_rate": 1000},
            "captures": [)" + captures + "]}"));
        QCOMPARE(*recording.info().startUnixSeconds, 1772366400.25);
        QCOMPARE(recording.info().sampleCount, Index(50));
        QCOMPARE(recording.info().notes.size(), std::size_t(1));
        QVERIFY2(recording.info().notes[0].starts_with("The core:datetime of the capture at sample "
                                                       + std::to_string(10 * stale) + " is 600 s earlier than "),
                 recording.info().notes[0].c_str());
    }
}

void tst_SigmfRecording::datasetOfAnotherName()
{
    QByteArray meta = fullMeta;
    meta.replace("\"core:num_channels\": 2", "\"core:dataset\": \"b.bin\"");
    writeBytes(path("b.bin"), QByteArray(4 + 4 * 7, '\0'));
    QCOMPARE(openRecording(write(meta))->info().sampleCount, Index(7));
    for (const char *name : {"../b.bin", "b.bin\\u0000.txt"}) {
        QByteArray other = meta;
        QVERIFY(contains(errorOf([&] { openRecording(write(other.replace("b.bin", name))); }),
                         "must be the name of a file in the same folder"));
    }
}

void tst_SigmfRecording::realPairsAsIq()
{
    QByteArray meta = fullMeta;
    meta.replace("ci16_le", "ri16_le");
    OpenOptions options;
    options.iq = true;
    const RecordingPointer recording = openRecording(write(meta), options);
    QVERIFY(recording->info().isComplex);
    QCOMPARE(recording->info().channelCount, 1);
    QCOMPARE(recording->info().sampleCount, Index(4));
}

void tst_SigmfRecording::badMetadata_data()
{
    QTest::addColumn<QByteArray>("meta");
    QTest::addColumn<QString>("message");
    const auto changed = [](const char *before, const char *after) {
        QByteArray meta = fullMeta;
        return meta.replace(before, after);
    };
    QTest::newRow("empty") << QByteArray() << "a.sigmf-meta: is not valid JSON at line 1, column 1";
    QTest::newRow("no JSON") << QByteArray("hello\nworld") << "is not valid JSON at line 1";
    QTest::newRow("a list") << QByteArray("[1, 2]") << "must be an object with a key \"global\"";
    QTest::newRow("global a list") << QByteArray("{\"global\": []}") << "a.sigmf-meta: global: must be an object";
    QTest::newRow("no type") << changed("core:datatype", "core:data")
                             << "global.core:datatype: is missing; expected one of cf32";
    QTest::newRow("unknown type") << changed("ci16_le", "ci12_le")
                                  << "global.core:datatype: ci12_le is not a sample type; expected one of cf32";
    QTest::newRow("type a number") << changed("\"ci16_le\"", "16") << "global.core:datatype: must be a string";
    QTest::newRow("no rate") << changed("core:sample_rate", "rate")
                             << "core:sample_rate: is missing; frequencies require it";
    QTest::newRow("rate 0") << changed("48000.5", "0") << "core:sample_rate: must be a number in 1e-09 … 1e+15";
    QTest::newRow("rate a text") << changed("48000.5", "\"x\"") << "core:sample_rate: must be a number";
    QTest::newRow("rate too large") << changed("48000.5", "1e999")
                                    << "not valid JSON: it contains a number that is too large";
    QTest::newRow("no channel") << changed("channels\": 2", "channels\": 0")
                                << "num_channels: must be a number in 1 … 1024";
    QTest::newRow("half a channel") << changed("channels\": 2", "channels\": 1.5")
                                    << "num_channels: must be a whole number";
    QTest::newRow("captures no list") << changed("\"captures\": [", "\"captures\": 3, \"x\": [")
                                      << "captures: must be a list";
    QTest::newRow("capture a number") << changed("\"captures\": [", "\"captures\": [7, ")
                                      << "captures[0]: must be an object";
    QTest::newRow("header negative") << changed("_bytes\": 4", "_bytes\": -4")
                                     << "captures[0].core:header_bytes: must be a number in 0";
    QTest::newRow("header beyond the file")
        << changed("_bytes\": 4", "_bytes\": 4000") << "contains no complete sample: 20 bytes";
    QTest::newRow("a second header")
        << changed("}],", "}, {\"core:sample_start\": 1, \"core:header_bytes\": 9}],")
        << "captures[1].core:header_bytes: bytes can be skipped before the first capture only";
}

void tst_SigmfRecording::badMetadata()
{
    QFETCH(QByteArray, meta);
    QFETCH(QString, message);
    const std::string error = errorOf([&] { openRecording(write(meta)); });
    QVERIFY2(contains(error, message.toStdString()), error.c_str());
    QVERIFY2(!contains(error, "\n"), error.c_str());
}

void tst_SigmfRecording::missingFiles()
{
    QVERIFY(contains(errorOf([&] { openRecording(path("b.sigmf-meta")); }), "b.sigmf-meta: no such file"));
    QVERIFY(contains(errorOf([&] { openRecording(path("a.sigmf-data")); }), "a.sigmf-meta, is missing; without it"));
    write(fullMeta);
    QFile::remove(QString::fromStdString(path("a.sigmf-data")));
    QVERIFY(contains(errorOf([&] { openRecording(path("a.sigmf-meta")); }),
                     "its samples, " + path("a.sigmf-data") + ", are missing"));

    // Without metadata the samples can still be opened as raw ones.
    writeBytes(path("c.sigmf-data"), QByteArray(40, '\0'));
    OpenOptions options;
    options.rawType = "ci16_le";
    options.rawRateHz = 10.0;
    QCOMPARE(openRecording(path("c.sigmf-data"), options)->info().sampleCount, Index(10));
    QCOMPARE(recordingHash(path("c.sigmf-data")).size(), std::size_t(64));
}

void tst_SigmfRecording::truncatedMetadataIsRefused()
{
    for (qsizetype length = 0; length < fullMeta.size() - 1; length += 7)
        QVERIFY(contains(errorOf([&] { openRecording(write(fullMeta.left(length))); }), "is not valid JSON at line"));
    // A bit turned over anywhere: refused in one line, or opened and readable.
    for (qsizetype i = 0; i < fullMeta.size(); i += 3) {
        QByteArray meta = fullMeta;
        meta[i] = static_cast<char>(meta[i] ^ (1 << (i % 8)));
        RecordingPointer recording;
        const std::string error = errorOf([&] { recording = openRecording(write(meta)); });
        QVERIFY(recording ? !readAll(*recording).empty() : !error.empty() && !contains(error, "\n"));
    }
}

void tst_SigmfRecording::deepMetadataIsRefused()
{
    const QByteArray deep = QByteArray(200000, '[') + QByteArray(200000, ']');
    QVERIFY(contains(errorOf([&] { openRecording(write("{\"global\": {\"core:datatype\": " + deep + "}}")); }),
                     "is nested more than 100 levels deep"));
    QVERIFY(contains(errorOf([&] { openRecording(write(QByteArray(1000000, '{'))); }), "is not valid JSON"));
}

void tst_SigmfRecording::sharedRecording()
{
    const std::string file = test::sharedRecording("s5_wwv_iq_24h.sigmf-meta");
    if (file.empty())
        QSKIP("skipped: no ../shared");
    const RecordingPointer recording = openRecording(file);
    const RecordingInfo &info = recording->info();
    QCOMPARE(info.sampleRateHz, 10.0);
    QCOMPARE(info.durationSeconds(), 86400.0);
    QCOMPARE(info.centreHz, 2.5e6);
    QCOMPARE(info.startUnixSeconds, std::optional(1721952000.0));
    // 15 h into the day: the carrier at 0.00 Hz is strong and steady.
    std::vector<float> minute(2 * 600);
    recording->read(0, Index(15) * 36000, 600, minute);
    QVERIFY(std::norm(fourier(minute.data(), 600, true, 0.0))
            > 100.0 * std::norm(fourier(minute.data(), 600, true, 0.17)));
    QVERIFY(readInPieces(*recording, 99999) == readAll(*recording));
}

FAINTLINE_TEST(tst_SigmfRecording)
#include "tst_SigmfRecording.moc"

#include "exchange/annotateRecording.h"
#include "exchange/annotationText.h"
#include "exchange/readAnnotations.h"
#include "exchange/writeEvents.h"
#include "exchange/writeReviewed.h"
#include "scene/SimulatedRecording.h"
#include "signal/formats/writeRecording.h"
#include "support/recordings.h"
#include "support/test.h"
using namespace faintline;
using namespace faintline::test;

namespace {

class Nothing : public Recording
{
public:
    explicit Nothing(const RecordingInfo &info) { m_info = info; }
    void read(int, Index, Index, std::span<float>) const override {}
};

Analysis threeTracks(const RecordingInfo &info)
{
    Analysis analysis;
    const Grid grid{{{"frequency", "Hz", -50.0, 2.5, 40, false}}};
    analysis.frames =
        std::make_shared<FrameArray>(Axis{"time", "s", 0.25, 0.5, 20, false}, grid, std::vector<float>(800, 1.0f));
    analysis.recording = std::make_shared<Nothing>(info);
    analysis.calibration = std::make_shared<Calibration>();
    for (int id = 1; id <= 3; ++id) {
        Track track{id, 2, 3, 12, 14.75 + id, true, false, {}};
        for (Index frame = 2; frame <= 12; ++frame)
            track.points.push_back({frame, 10 * id + (frame > 8 ? 1 : 0), 0, 1.0});
        analysis.tracks.push_back(track);
    }
    return analysis;
}

Annotations said(const Analysis &analysis)
{
    const std::vector<Event> all = events(analysis);
    Annotations annotations;
    annotations.reviews = withVerdict({}, analysis, all, {1}, Verdict::Accepted);
    annotations.reviews = withVerdict(annotations.reviews, analysis, all, {2}, Verdict::Rejected);
    annotations.reviews = withNote(annotations.reviews, analysis, all, 2, "mains, \"hum\" of 50 Hz; ½");
    annotations.reviews = withNote(annotations.reviews, analysis, all, 3, "look again");
    annotations.boxes = {{1.0, 2.5, -12.5, 30.0, "hand-made, box", "by me", Verdict::None},
                         {3.0, 4.0, {}, {}, "", "", Verdict::None}};
    return annotations;
}

const QByteArray sequence =
    "Selection\tBegin Time (s)\tEnd Time (s)\tLow Freq (kHz)\tHigh Freq (kHz)\tBegin File\tFile "
    "Offset (s)\tAnnotation\n"
    "1\t3\t9\t0.06\t0.08\tother.wav\t3\tother\n"
    "2\t80\t110.5\t0.06\t0.08\tCall.WAV\t20\tcall\n";

} // namespace

/// Annotations out and in again: every kind of file, tables as other programs write them, and what is no table at all.
class tst_annotations : public QObject
{
    Q_OBJECT

private slots:
    void comeBack_data()
    {
        QTest::addColumn<QString>("name");
        for (const char *name : {"a.csv", "a.json", "a.selections.txt", "a.txt", "a.sigmf-meta"})
            QTest::newRow(name) << QString::fromLatin1(name);
    }

    void comeBack()
    {
        QFETCH(QString, name);
        const Analysis analysis = threeTracks(m_info);
        const std::string file = m_folder.filePath(name).toStdString();
        writeReviewed(analysis, events(analysis), said(analysis), file);
        std::vector<Annotation> back = readAnnotations(file, m_info);
        std::vector<Annotation> expected{
            {1.25, 6.25, -25.0, -22.5, "event 1", "", Verdict::Accepted},
            {1.25, 6.25, 0.0, 2.5, "event 2", "mains, \"hum\" of 50 Hz; ½", Verdict::Rejected},
            {1.25, 6.25, 25.0, 27.5, "event 3", "look again", Verdict::None},
            {1.0, 2.5, -12.5, 30.0, "hand-made, box", "by me", Verdict::None},
            {3.0, 4.0, {}, {}, "", "", Verdict::None}};
        if (name.endsWith("sigmf-meta"))
            std::rotate(expected.begin(), expected.begin() + 3, expected.begin() + 4); // in order of time
        QCOMPARE(back.size(), expected.size());
        for (std::size_t i = 0; i < back.size(); ++i) {
            QCOMPARE(back[i].label, expected[i].label);
            QCOMPARE(back[i].note, expected[i].note);
            QVERIFY(back[i] == expected[i]);
        }
        // The same bytes once more, as boxes.
        Annotations boxes;
        boxes.boxes = back;
        writeReviewed(analysis, {}, boxes, file);
        QVERIFY(readAnnotations(file, m_info) == back);
    }

    void eventsOfTheCommandLine()
    {
        const Analysis analysis = threeTracks(m_info);
        for (const char *name : {"e.csv", "e.json", "e.txt", "e.sigmf-meta"}) {
            writeEvents(analysis, path(name));
            const std::vector<Annotation> back = readAnnotations(path(name), m_info);
            QCOMPARE(back.size(), std::size_t(3));
            QCOMPARE(back[1].startSeconds, 1.25);
            QCOMPARE(back[1].endSeconds, 6.25);
            QVERIFY(!back[1].label.empty());
        }
    }

    void severalAxes()
    {
        Analysis analysis;
        const Grid grid{{{"range", "m", 0.0, 10.0, 5, false}, {"bearing", "deg", 0.0, 90.0, 4, true}}};
        analysis.frames =
            std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 2.0, 3, false}, grid, std::vector<float>(60, 1.0f));
        analysis.tracks = {{1, 0, 1, 2, 9.0, true, false, {{0, 5, 0, 1.0}, {1, 5, 0, 2.0}, {2, 5, 0, 3.0}}}};
        Annotations annotations;
        annotations.reviews = withVerdict({}, analysis, events(analysis), {1}, Verdict::Accepted);
        writeReviewed(analysis, events(analysis), annotations, path("p.csv"));
        QVERIFY(
            readBytes(path("p.csv"))
                .startsWith("event,t_onset,t_detect,t_end,range,bearing,drift_hz_per_s,statistic,confirmed,open,range_"
                            "per_s,bearing_per_s,review,"
                            "signal,label,note\n"
                            "1,0,2,4,10,90,"));
        QVERIFY(readBytes(path("p.csv")).contains(",accepted,1,\"event 1\",\"\"\n"));
    }

    void raven()
    {
        // As Raven Pro 1.6 writes it, with two views of one selection, columns in another order, and Windows' line ends.
        const auto boxes = read(
            "r.txt",
            "Selection\tView\tChannel\tBegin Time (s)\tEnd Time (s)\tHigh Freq (Hz)\tLow Freq (Hz)\tSpecies\r\n"
            "1\tWaveform 1\t1\t0.5\t1.25\t800.0\t200.0\tEPFU\r\n1\tSpectrogram 1\t1\t0.5\t1.25\t800.0\t200.0\tEPFU\r\n"
            "2\tSpectrogram 1\t1\t3\t4\t900\t100\t\r\n");
        QCOMPARE(boxes.size(), std::size_t(2));
        QVERIFY((boxes[0] == Annotation{0.5, 1.25, 200.0, 800.0, "EPFU", "", Verdict::None}));
        QVERIFY((boxes[1] == Annotation{3.0, 4.0, 100.0, 900.0, "", "", Verdict::None}));
    }

    void severalFiles_data()
    {
        QTest::addColumn<QByteArray>("table");
        QTest::addColumn<QList<double>>("begins");
        QTest::addColumn<QByteArray>("note");
        QTest::newRow("two files") << sequence << QList<double>{20.0}
                                   << QByteArray("1 row(s) belong to other files (other.wav)");
        QByteArray paths = sequence;
        paths.replace("Begin File", "Begin Path").replace("Call.WAV", "D:\\site\\call.flac");
        QTest::newRow("paths") << paths << QList<double>{20.0}
                               << QByteArray("1 row(s) belong to other files (other.wav)");
        QByteArray none = sequence;
        QTest::newRow("none of them") << none.replace("Call.WAV", "third.wav") << QList<double>{}
                                      << QByteArray("2 row(s) belong to other files (other.wav …)");
        QTest::newRow("one file of another name")
            << sequence.left(sequence.indexOf("2\t80")) << QList<double>{3.0} << QByteArray("names the file other.wav");
        QByteArray own = sequence;
        QTest::newRow("this one only") << own.replace("other.wav", "call.wav") << QList<double>{3.0, 20.0}
                                       << QByteArray();
    }

    void severalFiles()
    {
        QFETCH(QByteArray, table);
        QFETCH(QList<double>, begins);
        QFETCH(QByteArray, note);
        RecordingInfo call = m_info;
        call.path = "/recordings/call.wav";
        writeBytes(path("sequence.txt"), table);
        std::vector<std::string> notes;
        const std::vector<Annotation> boxes = readAnnotations(path("sequence.txt"), call, &notes);
        QCOMPARE(std::ssize(boxes), begins.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            QCOMPARE(boxes[i].startSeconds, begins[qsizetype(i)]);
            QCOMPARE(boxes[i].endSeconds - boxes[i].startSeconds, boxes[i].label == "call" ? 30.5 : 6.0);
            QVERIFY(boxes[i].lowHz == 60.0 && boxes[i].highHz == 80.0);
        }
        QCOMPARE(notes.empty(), note.isEmpty());
        if (!note.isEmpty())
            QVERIFY2(QByteArray::fromStdString(notes.front()).contains(note), notes.front().c_str());
    }

    /// Rows are placed by their file's time stamp: the pause between two files is none of a table's seconds.
    void placesInAFolderOfFiles()
    {
        QVERIFY(QDir(m_folder.path()).mkpath("night"));
        LineScene scene{.sampleRateHz = 100.0, .durationSeconds = 30.0};
        for (const char *name : {"night/20260301_000000.wav", "night/20260301_000100.wav"})
            writeRecording(SimulatedRecording(scene), path(name));
        RecordingInfo night = m_info;
        night.path = path("night");
        night.startUnixSeconds = 1772323200.0; // 2026-03-01T00:00:00Z
        QByteArray table = sequence;
        table.replace("other.wav", "20260301_000000.wav").replace("Call.WAV", "20260301_000100.wav");
        writeBytes(path("night.txt"), table);
        const std::vector<Annotation> boxes = readAnnotations(path("night.txt"), night);
        QCOMPARE(boxes.size(), std::size_t(2));
        QCOMPARE(boxes[0].startSeconds, 3.0);
        QCOMPARE(boxes[1].startSeconds, 80.0);
    }

    void asOtherProgramsWriteNumbers_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::newRow("decimal commas") << QByteArray("20,5\t49,5\tcall [accepted]\n\\\t60,25\t80\n");
        QTest::newRow("old line ends") << QByteArray("20,5\t49,5\tcall [accepted]\r\\\t60,25\t80\r");
        const QByteArray rows = "event,t_onset,t_end,f_low,f_high,review,label\n1,20.5,49.5,60.25,80,accepted,call\n";
        QTest::newRow("commas") << rows;
        QByteArray semicolons = rows;
        QTest::newRow("semicolons") << semicolons.replace(',', ';').replace('.', ',');
        QTest::newRow("semicolons, points") << QByteArray(rows).replace(',', ';');
        QTest::newRow("separator named") << "sep=;\r\n" + semicolons;
        QTest::newRow("tabs") << QByteArray(semicolons).replace(';', '\t');
        QByteArray quoted = rows;
        QTest::newRow("quoted") << "\"" + quoted.trimmed().replace(",", "\",\"").replace("\n", "\"\n\"") + "\"\n";
        QTest::newRow("quoted names") << QByteArray(
            "\"event\",\"t_onset\",\"t_end\",\"f_low\",\"f_high\",\"review\",\"label\"\n"
            "1,20.5,49.5,60.25,80,accepted,\"call\"\n");
        QTest::newRow("quoted decimal commas")
            << QByteArray("t_onset,t_end,f_low,f_high,review,label\n\"20,5\",\"49,5\",\"60,25\",80,"
                          "accepted,call\n");
        QTest::newRow("index without a name")
            << QByteArray(",t_onset,t_end,f_low,f_high,review,label\n0,20.5,49.5,60.25,80,"
                          "accepted,call\n");
        QTest::newRow("cell of two lines") << QByteArray(
            "t_onset,t_end,note,f_low,f_high,review,label\n20.5,49.5,\"a\nb \"\"c\"\"\",60.25,80,accepted,call\n");
        QTest::newRow("kilohertz") << QByteArray("t_onset;t_end;f_low (kHz);f_high (kHz);review;label\n"
                                                 "20,5;49,5;0,06025;0,08;accepted;call\n");
        QByteArray little("\xff\xfe"), big;
        for (const char c : rows) {
            little.append(c).append('\0');
            big.append('\0').append(c);
        }
        QTest::newRow("UTF-16") << little;
        QTest::newRow("UTF-16 without a mark") << little.mid(2);
        QTest::newRow("UTF-16, big-endian") << "\xfe\xff" + big;
    }

    void asOtherProgramsWriteNumbers()
    {
        QFETCH(QByteArray, text);
        const auto boxes = read("numbers", text);
        QCOMPARE(boxes.size(), std::size_t(1));
        QCOMPARE(boxes[0].startSeconds, 20.5);
        QCOMPARE(boxes[0].endSeconds, 49.5);
        QVERIFY(std::abs(*boxes[0].lowHz - 60.25) < 1e-12 && boxes[0].highHz == 80.0);
        QCOMPARE(boxes[0].label, std::string("call"));
        QCOMPARE(boxes[0].verdict, Verdict::Accepted);
    }

    void openEdges_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QList<double>>("edges"); // of real samples at 1000 Hz; none: all frequencies
        QTest::newRow("upper") << QByteArray("1\t2\tx\n\\\t60.5\t-1.0000000\n") << QList<double>{60.5, 500.0};
        QTest::newRow("lower") << QByteArray("1\t2\tx\n\\\t-1\t80\n") << QList<double>{0.0, 80.0};
        QTest::newRow("both") << QByteArray("1\t2\tx\n\\\t-1\t-1,0\n") << QList<double>{};
        QTest::newRow("upper in a table")
            << QByteArray("t_onset;t_end;f_low;f_high\n1;2;60,5;-1\n") << QList<double>{60.5, 500.0};
        QTest::newRow("upper in kHz") << QByteArray(
            "Begin Time (s)\tEnd Time (s)\tLow Freq (kHz)\tHigh Freq (kHz)\n1\t2\t0.0605\t-1\n")
                                      << QList<double>{60.5, 500.0};
    }

    void openEdges()
    {
        QFETCH(QByteArray, text);
        QFETCH(QList<double>, edges);
        RecordingInfo real = m_info;
        real.isComplex = false;
        writeBytes(path("edges"), text);
        const std::vector<Annotation> boxes = readAnnotations(path("edges"), real);
        QCOMPARE(boxes.size(), std::size_t(1));
        QCOMPARE(boxes[0].lowHz.has_value(), !edges.isEmpty());
        if (!edges.isEmpty())
            QVERIFY(std::abs(*boxes[0].lowHz - edges[0]) < 1e-12 && boxes[0].highHz == edges[1]);
    }

    void audacity()
    {
        const auto boxes = read("l.txt", "1.000000\t2.500000\tfirst label\n\\\t100.5\t200\n3.0\t3.0\tpoint\n4\t5\n");
        QCOMPARE(boxes.size(), std::size_t(3));
        QVERIFY((boxes[0] == Annotation{1.0, 2.5, 100.5, 200.0, "first label", "", Verdict::None}));
        QVERIFY((boxes[1] == Annotation{3.0, 3.0, {}, {}, "point", "", Verdict::None}));
    }

    void sigmf()
    {
        // Its own sample rate counts, and the centre comes off.
        const auto boxes =
            read("s.sigmf-meta", R"({"global": {"core:sample_rate": 2000}, "captures": [], "annotations": [
            {"core:sample_start": 1000, "core:sample_count": 500, "core:freq_lower_edge": 4990,
             "core:freq_upper_edge": 5020, "core:label": "x"},
            {"core:sample_start": 3000}]})");
        QVERIFY((boxes[0] == Annotation{0.5, 0.75, -10.0, 20.0, "x", "", Verdict::None}));
        QVERIFY((boxes[1] == Annotation{1.5, 1.5, {}, {}, "", "", Verdict::None}));
    }

    // The file's samples have numbers from 2 000 000 on; 20 s are missing behind its first 2000.
    void sigmfCountsSamplesOfTheFile()
    {
        RecordingInfo info = m_info;
        info.sampleRateHz = 400.0;
        info.sampleCount = 24000;
        info.firstNumber = 2000000;
        info.places.add(0, 0, 2000);
        info.places.add(10000, 2000, 14000);
        info.sigmf = R"({"global": {"core:datatype": "ci8", "core:sample_rate": 400, "core:offset": 2000000},
                         "captures": [{"core:sample_start": 2000000, "core:global_index": 7},
                                      {"core:sample_start": 2002000, "core:global_index": 10007}]})";
        const QByteArray head = QByteArray::fromStdString(info.sigmf).chopped(1);
        writeBytes(path("o.sigmf-meta"), head + R"(, "annotations": [
            {"core:sample_start": 2001000}, {"core:sample_start": 2001000, "core:sample_count": 2000},
            {"core:sample_start": 2004000, "core:sample_count": 8000}, {"core:sample_start": 2010000}]})");
        const auto boxes = readAnnotations(path("o.sigmf-meta"), info);
        const std::vector<std::pair<double, double>> expected{{2.5, 5.0}, {2.5, 27.5}, {30.0, 50.0}, {45.0, 60.0}};
        for (std::size_t i = 0; i < expected.size(); ++i)
            QVERIFY(std::pair(boxes[i].startSeconds, boxes[i].endSeconds) == expected[i]);

        Annotations written;
        written.boxes = boxes;
        writeReviewed(threeTracks(info), {}, written, path("back.sigmf-meta"));
        QVERIFY(readAnnotations(path("back.sigmf-meta"), info) == boxes);
        const Json json = parseJson(readBytes(path("back.sigmf-meta")).toStdString(), "");
        QCOMPARE(json["global"]["core:offset"].get<int>(), 2000000);
        QCOMPARE(json["global"]["core:datatype"].get<std::string>(), std::string("ci8"));
        QVERIFY(json["captures"] == parseJson(info.sigmf, "")["captures"]);
        QCOMPARE(json["annotations"][2]["core:sample_start"].get<int>(), 2004000);
        QCOMPARE(json["annotations"][2]["core:sample_count"].get<int>(), 8000);
    }

    void ownMetadataKeepAllElse()
    {
        const std::string own = path("own.sigmf-meta");
        writeBytes(own, R"({"global": {"core:datatype": "ci16_le", "core:sample_rate": 1000.0, "antenna:gain": 3,
            "core:extensions": [{"name": "antenna", "version": "1.0.0", "optional": true}]},
            "captures": [{"core:sample_start": 0, "core:frequency": 5000.0, "core:datetime": "2026-03-01T00:00:00Z"}],
            "annotations": [{"core:sample_start": 7000, "core:sample_count": 9, "core:label": "by hand", "user:mood": []}],
            "collection": {"x": 18446744073709551615}})");
        Json expected = parseJson(readBytes(own).toStdString(), own);
        const Json handMade = expected["annotations"][0];
        QVERIFY(isMetadataOf(own, path("own.sigmf-data"))
                && isMetadataOf(m_folder.path().toStdString() + "/./own.sigmf-meta", own));
        QVERIFY(!isMetadataOf(path("other.sigmf-meta"), own) && !isMetadataOf(own, path("own.wav")));

        Analysis analysis = threeTracks(m_info);
        QCOMPARE(annotateRecording(path("own.sigmf-data"), eventsSigmf(analysis)), 3);
        const Json once = parseJson(readBytes(own).toStdString(), own);
        QCOMPARE(once["annotations"].size(), std::size_t(4));
        QVERIFY(once["annotations"][3] == handMade); // it begins last
        QVERIFY(once["annotations"][0]["core:sample_start"] == 1250
                && once["annotations"][0]["core:generator"] == "Faintline");
        expected["annotations"] = once["annotations"];
        QVERIFY(once == expected); // all else, in its order
        // Once more: nothing is doubled. With reviews, their name space is declared beside the others.
        QCOMPARE(annotateRecording(own, eventsSigmf(analysis)), 0);
        QVERIFY(parseJson(readBytes(own).toStdString(), own) == once);
        Annotations nothing;
        QCOMPARE(annotateRecording(own, reviewedSigmf(analysis, events(analysis), nothing)), 0);
        nothing.reviews = withVerdict({}, analysis, events(analysis), {1}, Verdict::Rejected);
        QCOMPARE(annotateRecording(own, reviewedSigmf(analysis, events(analysis), nothing)), 0);
        const Json reviewed = parseJson(readBytes(own).toStdString(), own);
        QCOMPARE(reviewed["annotations"].size(), std::size_t(4));
        QCOMPARE(reviewed["global"]["core:extensions"].size(), std::size_t(2));
        QCOMPARE(std::ranges::count_if(reviewed["annotations"],
                                       [](const Json &one) { return one.value("faintline:review", "") == "rejected"; }),
                 std::ptrdiff_t(1));
        QVERIFY(errorOf([&] { annotateRecording(path("own.wav"), eventsSigmf(analysis)); }).find("is not a SigMF")
                != std::string::npos);
        writeBytes(own, R"({"global": 3, "annotations": [{"core:sample_start": "now"}]})");
        QVERIFY(errorOf([&] { annotateRecording(own, eventsSigmf(analysis)); }).starts_with(own));
        QCOMPARE(readBytes(own), QByteArray(R"({"global": 3, "annotations": [{"core:sample_start": "now"}]})"));
    }

    /// An event has one annotation by Faintline, whether it is written with its review or without, and what was annotated by
    /// others is not written again after an import.
    void annotationsAreNotDoubled()
    {
        const std::string own = path("twice.sigmf-meta");
        const Analysis analysis = threeTracks(m_info);
        const Json once = parseJson(eventsSigmf(analysis), "events")["annotations"];
        Json meta = parseJson(R"({"global": {"core:datatype": "cf32_le", "core:sample_rate": 1000.0},
            "captures": [{"core:sample_start": 0, "core:frequency": 5000.0}],
            "annotations": [{"core:sample_start": 1250, "user:mood": "good"}]})",
                              "metadata"); // without count, edges, label
        for (int copy = 0; copy < 2; ++copy)
            for (Json one : once) {
                one["core:generator"] = "Faintline";
                one["core:comment"] = "statistic " + std::to_string(copy) + " nat"; // of other settings
                meta["annotations"].push_back(one);
            }
        Json foreign = once[1]; // shorter, and by another program
        foreign["core:generator"] = "other";
        foreign["core:sample_count"] = 77;
        meta["annotations"].push_back(foreign);
        writeBytes(own, QByteArray::fromStdString(meta.dump()));

        Annotations imported;
        imported.boxes = {{1.25, 15.0, {}, {}, "", "", Verdict::None}}; // as the first reads back
        QCOMPARE(annotateRecording(own, reviewedSigmf(analysis, events(analysis), imported)), 0);
        const Json after = parseJson(readBytes(own).toStdString(), own)["annotations"];
        QCOMPARE(after.size(), std::size_t(5));
        QVERIFY(after[0] == meta["annotations"][0]);
        QVERIFY(after[1] == foreign);
        for (std::size_t i = 1; i < 4; ++i) {
            QVERIFY(after[i + 1]["core:label"] == "event " + std::to_string(i));
            QVERIFY(after[i + 1]["core:comment"] == "" && after[i + 1].contains("faintline:statistic")); // the newest
        }

        // One without edges is another box than one with them.
        imported.boxes = {{3.0, 4.0, {}, {}, "x", "", Verdict::None}, {3.0, 4.0, 10.0, 20.0, "x", "", Verdict::None}};
        QCOMPARE(annotateRecording(own, reviewedSigmf(analysis, {}, imported)), 2);
        QCOMPARE(annotateRecording(own, reviewedSigmf(analysis, {}, imported)), 0);
    }

    /// What a run says in a comment is no note of a person.
    void ownCommentsAreNoNotes()
    {
        Analysis analysis = threeTracks(m_info);
        analysis.settings.detector = PofNSettings();
        writeEvents(analysis, path("plain.sigmf-meta"));
        const auto plain = readAnnotations(path("plain.sigmf-meta"), m_info);
        QCOMPARE(plain.size(), std::size_t(3));
        QVERIFY(std::ranges::all_of(plain, [](const Annotation &box) { return box.note.empty(); }));
        QVERIFY(isEventComment("statistic 1.25e+03 nat, SNR -0.3 dB in one window"));
        QVERIFY(isEventComment("not a line: level raised by at least 6 dB"));
        for (const char *words : {"", "statistic 12 nat, looks real", "statistic is weak", "my note"})
            QVERIFY2(!isEventComment(words), words);
        QVERIFY(isEventLabel("event 12 (of 3)") && isEventLabel("area") && !isEventLabel("event horizon"));
    }

    /// Annotations of a run with other settings are replaced, except those of which a person has said something.
    void otherSettingsReplaceWhatNobodyReviewed()
    {
        const std::string own = path("again.sigmf-meta");
        writeBytes(own, R"({"global": {"core:datatype": "cf32_le", "core:sample_rate": 1000.0}, "captures": []})");
        const Analysis one = threeTracks(m_info);
        Analysis other = one; // tracks at other places, with other statistics
        for (Track &track : other.tracks) {
            track.points.pop_back();
            --track.endFrame;
            track.peakStatistic += 100.0;
        }
        const auto file = [&] { return parseJson(readBytes(own).toStdString(), own)["annotations"]; };
        QCOMPARE(annotateRecording(own, eventsSigmf(one)), 3);
        Json meta = parseJson(readBytes(own).toStdString(), own);
        Json &beacon = meta["annotations"][0];
        beacon.update(
            {{"faintline:review", "accepted"}, {"core:comment", "mine"}, {"core:label", "Beacon"}, {"my:x", 1}});
        meta["annotations"][1]["faintline:review"] = "rejected"; // by the words of the run
        meta["annotations"][2]["core:label"] = "Third";
        const Json reviewed = meta["annotations"];
        writeBytes(own, QByteArray::fromStdString(meta.dump()));

        QCOMPARE(annotateRecording(own, eventsSigmf(other)), 3);
        QCOMPARE(file().size(), std::size_t(6));
        QCOMPARE(annotateRecording(own, eventsSigmf(one)), 0);
        QVERIFY(file() == reviewed);
        // Reviews that were read from the file come back to their events, with the statistic of this run.
        Annotations said;
        said.reviews = withVerdict({}, one, events(one), {1}, Verdict::Accepted);
        said.reviews = withNote(said.reviews, one, events(one), 1, "mine");
        QCOMPARE(annotateRecording(own, reviewedSigmf(one, events(one), said)), 0);
        Json expected = reviewed[0];
        expected["faintline:statistic"] = events(one)[0].statistic;
        QVERIFY(file()[0] == expected);
        QCOMPARE(file()[1]["faintline:review"].get<std::string>(), std::string("rejected"));
        QCOMPARE(file()[2]["core:label"].get<std::string>(), std::string("Third"));
        QCOMPARE(file().size(), std::size_t(3));
    }

    void textsAreTakenApart()
    {
        for (const auto &[label, verdict, note] : {std::tuple{"a", Verdict::None, ""},
                                                   {"a", Verdict::None, "n"},
                                                   {"", Verdict::Rejected, "n [x]"},
                                                   {"a b", Verdict::Accepted, ""}}) {
            Annotation box;
            takeApart(annotationText(label, verdict, note), box);
            QCOMPARE(box.label, std::string(label));
            QCOMPARE(box.note, std::string(note));
            QCOMPARE(box.verdict, verdict);
        }
    }

    /// Samples of SigMF are counted, as far as one can count.
    void farAway()
    {
        Annotations boxes;
        boxes.boxes = {{-1e300, 1e300, {}, {}, "", "", Verdict::None}, {5.0, 1e300, {}, {}, "", "", Verdict::None}};
        writeReviewed(threeTracks(m_info), {}, boxes, path("far.sigmf-meta"));
        for (const Annotation &box : readAnnotations(path("far.sigmf-meta"), m_info))
            QVERIFY(box.startSeconds <= 5.0 && box.endSeconds > 1e12);
    }

    void hostile_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::newRow("json cut off") << QByteArray("{\"annotations\": [");
        QTest::newRow("json of something else") << QByteArray("{\"global\": {}}");
        QTest::newRow("json list") << QByteArray("[1, 2]");
        QTest::newRow("annotation that is a number") << QByteArray("{\"annotations\": [3]}");
        QTest::newRow("annotations that are text") << QByteArray("{\"annotations\": \"none\"}");
        QTest::newRow("start that is text") << QByteArray("{\"annotations\": [{\"core:sample_start\": \"now\"}]}");
        QTest::newRow("negative count") << QByteArray(
            "{\"annotations\": [{\"core:sample_start\": 9, \"core:sample_count\": -4}]}");
        QTest::newRow("huge") << QByteArray("{\"annotations\": [{\"core:sample_start\": 1e308, \"core:sample_count\": "
                                            "1e308}], \"global\": {\"core:sample_rate\": 1e-300}}");
        QTest::newRow("rate of nothing") << QByteArray("{\"annotations\": [], \"global\": {\"core:sample_rate\": 0}}");
        QTest::newRow("one edge") << QByteArray(
            "{\"annotations\": [{\"core:sample_start\": 1, \"core:freq_lower_edge\": 1}]}");
        QTest::newRow("no label") << QByteArray("just some text\n");
        QTest::newRow("not a number") << QByteArray("nan\t1\tx\n");
        QTest::newRow("infinite") << QByteArray("0\tinf\tx\n");
        QTest::newRow("commas and points") << QByteArray("0,5\t1.5\tx\n");
        QTest::newRow("two commas") << QByteArray("0,5,1\t2\tx\n");
        QTest::newRow("thousands") << QByteArray("0\t1,234.5\tx\n");
        QTest::newRow("quote without an end") << QByteArray("\"event\",\"t_onset\",\"t_end\"\n1,2,\"3\n4,5,6\n");
        QTest::newRow("half a UTF-16 character") << QByteArray("\xff\xfe"
                                                               "1\0\t\0x",
                                                               7);
        QTest::newRow("ends before it begins") << QByteArray("2\t1\tx\n");
        QTest::newRow("frequencies of nothing") << QByteArray("\\\t1\t2\n");
        QTest::newRow("binary") << QByteArray("RIFF\x01\0\0\0WAVE\0\0\n\0", 14);
        QTest::newRow("Raven without ends") << QByteArray("Selection\tBegin Time (s)\n1\t2\n");
        QTest::newRow("Raven with a cell too many") << QByteArray("Begin Time (s)\tEnd Time (s)\n1\t2\t3\n");
        QTest::newRow("Raven with one edge") << QByteArray("Begin Time (s)\tEnd Time (s)\tLow Freq (Hz)\n1\t2\t3\n");
        QTest::newRow("events without ends") << QByteArray("event,t_onset\n1,2\n");
        QTest::newRow("deep") << QByteArray(100000, '[');
    }

    void hostile()
    {
        QFETCH(QByteArray, text);
        const std::string why = errorOf([&] { read("h", text); });
        QVERIFY(why.starts_with(path("h")));
        QVERIFY2(why.find('\n') == std::string::npos, why.c_str());
        QVERIFY(why.size() < 400);
        QVERIFY(why.find("exception") == std::string::npos);
        QVERIFY(!errorOf([&] { readAnnotations(path("nowhere"), m_info); }).empty());
        QVERIFY(errorOf([&] {
                    readAnnotations(path("."), m_info);
                }).ends_with("is a folder; expected a table of text"));
        QVERIFY(read("empty", "").empty());
    }

private:
    std::string path(const char *name) const { return m_folder.filePath(QLatin1String(name)).toStdString(); }
    std::vector<Annotation> read(const char *name, const QByteArray &text) const
    {
        writeBytes(path(name), text);
        return readAnnotations(path(name), m_info);
    }

    QTemporaryDir m_folder;
    RecordingInfo m_info{"", "", "", 1000.0, 0, 1, true, 5000.0, {}, {}};
};

FAINTLINE_TEST(tst_annotations)

#include "tst_annotations.moc"

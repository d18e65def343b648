#include "exchange/reviewedText.h"
#include "support/test.h"

#include "base/json.h"
#include "support/recordings.h"

using namespace faintline;

namespace {

ReviewedRow row(double from, double to, const std::string &label)
{
    ReviewedRow made;
    made.box.startSeconds = from;
    made.box.endSeconds = to;
    made.box.label = label;
    return made;
}

ReviewedRow whale()
{
    ReviewedRow made = row(1.5, 2.25, "whale");
    made.box.lowHz = 100.0;
    made.box.highHz = 250.5;
    made.box.verdict = Verdict::Rejected;
    made.box.note = "a ship";
    return made;
}

RecordingInfo infoOf(double rate, double centre)
{
    RecordingInfo info;
    info.sampleRateHz = rate;
    info.centreHz = centre;
    info.isComplex = centre != 0.0;
    info.channelCount = 1;
    info.sampleType = "int16";
    info.sampleCount = 480000;
    return info;
}

} // namespace

/// Lists of reviewed events for other programs, written out here by hand.
class tst_reviewedText : public QObject
{
    Q_OBJECT

private slots:
    void numbersAreShortestOrEmpty()
    {
        QCOMPARE(numberOrEmpty({}), std::string());
        QCOMPARE(numberOrEmpty(0.0), std::string("0"));
        QCOMPARE(numberOrEmpty(0.1), std::string("0.1"));
    }

    void ravenHasARowForEach()
    {
        const QStringList lines = QString::fromStdString(ravenText({whale(), row(3.0, 4.0, "")})).split('\n');
        QCOMPARE(lines.size(), 4); // heading, two rows, end of the last line
        QCOMPARE(lines[0].split('\t').size(), 10);
        QCOMPARE(lines[1], QString("1\tSpectrogram 1\t1\t1.5\t2.25\t100\t250.5\twhale\trejected\ta ship"));
        QCOMPARE(lines[2], QString("2\tSpectrogram 1\t1\t3\t4\t\t\t\t\t"));
        QCOMPARE(lines[3], QString());
    }

    void audacityPutsFrequenciesOnASecondLine()
    {
        QCOMPARE(audacityText({row(3.0, 4.0, "hum")}), std::string("3\t4\thum\n"));
        QCOMPARE(audacityText({whale()}), std::string("1.5\t2.25\twhale [rejected] a ship\n\\\t100\t250.5\n"));
    }

    void sigmfCountsSamples()
    {
        Event event;
        event.statistic = 17.5;
        ReviewedRow detected = whale();
        detected.event = &event;
        const Json json = Json::parse(sigmfText({detected, row(3.0, 3.0, "click")}, infoOf(48000.0, 1e8)));
        QCOMPARE(json["global"]["core:sample_rate"].get<double>(), 48000.0);
        QCOMPARE(json["global"]["core:datatype"].get<std::string>(), std::string("ci16_le"));
        QCOMPARE(json["captures"].size(), std::size_t(1));
        QCOMPARE(json["captures"][0]["core:frequency"].get<double>(), 1e8);
        const Json &first = json["annotations"][0];
        QCOMPARE(first["core:sample_start"].get<long long>(), 72000LL); // 1.5 s
        QCOMPARE(first["core:sample_count"].get<long long>(), 36000LL); // 0.75 s
        QCOMPARE(first["core:freq_lower_edge"].get<double>(), 1e8 + 100.0);
        QCOMPARE(first["core:freq_upper_edge"].get<double>(), 1e8 + 250.5);
        QCOMPARE(first["faintline:review"].get<std::string>(), std::string("rejected"));
        QCOMPARE(first["faintline:statistic"].get<double>(), 17.5);
        const Json &second = json["annotations"][1];
        QCOMPARE(second["core:sample_count"].get<long long>(), 1LL); // not empty
        QVERIFY(!second.contains("core:freq_lower_edge") && !second.contains("faintline:statistic"));
    }

    // A reader of the metadata finds the samples of a WAV file behind its header of 44 bytes.
    void sigmfDescribesTheFile()
    {
        const QTemporaryDir folder;
        RecordingInfo info = infoOf(8000.0, 0.0);
        info.path = folder.filePath("a.wav").toStdString();
        info.container = "WAV";
        const auto chunk = [](const char *name, const QByteArray &content) {
            return name + QByteArray(1, static_cast<char>(content.size())) + QByteArray(3, '\0') + content;
        };
        test::writeBytes(info.path, "RIFF" + QByteArray(4, '\0') + "WAVE" + chunk("fmt ", QByteArray(16, '\1'))
                                        + chunk("data", QByteArray(20, '\2')) + chunk("LIST", "INFO"));
        const Json json = sigmfMetadata(info, "");
        QCOMPARE(json["global"]["core:dataset"].get<std::string>(), std::string("a.wav"));
        QCOMPARE(json["global"]["core:datatype"].get<std::string>(), std::string("ri16_le"));
        QCOMPARE(json["captures"][0]["core:header_bytes"].get<int>(), 44);
        QCOMPARE(json["global"]["core:trailing_bytes"].get<int>(), 12);
    }

    void sigmfIsInOrderOfTime()
    {
        const Json json =
            Json::parse(sigmfText({row(5, 6, "c"), row(1, 9, "a"), row(5, 7, "d"), row(2, 3, "b")}, infoOf(10.0, 0.0)));
        std::string labels;
        for (const Json &one : json["annotations"])
            labels += one["core:label"].get<std::string>();
        QCOMPARE(labels, std::string("abcd")); // equal times keep their order
    }

    void farTimesStayExact()
    {
        const Json json = Json::parse(sigmfText({row(1e300, 1e301, "")}, infoOf(1e6, 0.0)));
        const Json &one = json["annotations"][0];
        QCOMPARE(one["core:sample_start"].get<long long>(), 9007199254740992LL); // 2^53
        QCOMPARE(one["core:sample_count"].get<long long>(), 1LL);
    }
};

FAINTLINE_TEST(tst_reviewedText)
#include "tst_reviewedText.moc"

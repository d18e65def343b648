#include "app/cli/CommandLineTest.h"
#include "base/json.h"
#include "plan/AnalysisSettings.h"
#include "support/test.h"

using namespace faintline;
using namespace faintline::test;

/// What the program tells of itself, of settings and of recordings, and what it simulates.
class tst_cliTold : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase() { simulateLine(); }

    void helpAndVersion()
    {
        for (const QStringList &arguments : {QStringList{"--help"}, {"detect", "--help"}, {"--version"}}) {
            const Outcome told = run(arguments);
            QCOMPARE(told.code, 0);
            QVERIFY(told.out.contains(arguments.last() == "--version" ? "faintline-cli " : "--threads")
                    || told.out.contains("--events"));
            QCOMPARE(told.err, QByteArray());
        }
        const QByteArray all = run({"--help"}).out;
        for (const char *command : {"info", "describe", "detect", "statistic", "explain", "simulate"})
            QVERIFY2(all.contains(command), command);
    }

    void infoAsText()
    {
        const Outcome told = run({"info", "line.wav"});
        QCOMPARE(told.code, 0);
        QCOMPARE(told.err, QByteArray());
        QVERIFY(told.out.contains("WAV, float32"));
        QVERIFY(told.out.contains("1000 Hz"));
        QVERIFY(told.out.contains("30000 samples, 30 s"));
    }

    void infoAsJson()
    {
        writeBytes(pathOf("iq.sigmf-data"), QByteArray(400, '\0'));
        writeBytes(pathOf("iq.sigmf-meta"),
                   R"({"global": {"core:datatype": "ci16_le", "core:sample_rate": 50, "core:version": "1.0.0"},
        "captures": [{"core:sample_start": 0, "core:frequency": 7e6, "core:datetime": "2024-07-26T00:00:00Z"}],
        "annotations": []})");
        const Outcome told = run({"info", "iq.sigmf-meta", "--json"});
        QCOMPARE(told.code, 0);
        const Json json = parseJson(told.out.toStdString(), "info");
        QCOMPARE(json["container"].get<std::string>(), std::string("SigMF"));
        QCOMPARE(json["sampleType"].get<std::string>(), std::string("ci16_le"));
        QCOMPARE(json["sampleRateHz"].get<double>(), 50.0);
        QCOMPARE(json["channels"].get<int>(), 1);
        QCOMPARE(json["samples"].get<int>(), 100);
        QCOMPARE(json["durationSeconds"].get<double>(), 2.0);
        QCOMPARE(json["complex"].get<bool>(), true);
        QCOMPARE(json["centreHz"].get<double>(), 7e6);
        QCOMPARE(json["startUnixSeconds"].get<double>(), 1721952000.0);
    }

    /// With the digits that their channels need: the step is added to 6667.1 MHz 49 999 times.
    void infoOfFrequencies()
    {
        const auto word = [](const QByteArray &text) { return littleEndian(std::uint64_t(text.size()), 4) + text; };
        const auto real = [](double value) { return QByteArray(reinterpret_cast<const char *>(&value), sizeof value); };
        const QByteArray header = word("HEADER_START") + word("nchans") + littleEndian(50000, 4) + word("nbits")
                                  + littleEndian(8, 4) + word("nifs") + littleEndian(1, 4) + word("fch1") + real(6667.1)
                                  + word("foff") + real(-2e-6) + word("tsamp") + real(18.0) + word("HEADER_END");
        writeBytes(pathOf("d.fil"), header + QByteArray(100000, '\1'));
        const Outcome told = run({"info", "d.fil"});
        QVERIFY2(told.out.contains("50000 channels of 2 Hz, 6667000002 … 6667100000 Hz\n"),
                 (told.out + told.err).constData());
    }

    void describesEverySetting()
    {
        const QByteArray all = run({"describe"}).out;
        for (const auto &field : AnalysisSettings::fields()) {
            QVERIFY2(all.contains(field.name.c_str()), field.name.c_str());
            QVERIFY2(all.contains(field.sentence.c_str()), field.name.c_str());
            QVERIFY2(all.contains(field.advice.c_str()), field.name.c_str());
        }
        for (const SettingRule &rule : settingRules())
            QVERIFY2(all.contains(rule.sentence.c_str()), rule.field.c_str());
        for (const Preset &known : presets())
            QVERIFY2(all.contains(known.sentence.c_str()), known.name.c_str());
        QCOMPARE(
            run({"describe", "decide.falseAlarmsPerHour"}).out,
            QByteArray("decide.falseAlarmsPerHour, 1/h\n    1e-09 … 1e+09; default 1\n"
                       "    False alarms per hour of recording that the threshold permits on noise.\n"
                       "    Raise it to find weaker signals among more false ones. It applies to the whole band, so a "
                       "wide band needs a higher threshold than a narrow one. Source: Billon 2005, section 3.\n"));
        QVERIFY(run({"describe", "spectrogram.windowSeconds"}).out.contains("| automatic; default automatic\n"));
    }

    void simulatesTheSameAgain()
    {
        QCOMPARE(run({"simulate", "scene.json", "--out", "again.wav", "--threads", "2"}).code, 0);
        QVERIFY(content("again.wav") == content("line.wav"));
        QCOMPARE(run({"simulate", "scene.json", "--out", "other.wav", "--seed", "4"}).code, 0);
        QVERIFY(content("other.wav") != content("line.wav"));
        QCOMPARE(content("other.wav").size(), content("line.wav").size());
        QCOMPARE(run({"simulate", "scene.json", "--out", "short.wav", "--type", "int16"}).code, 0);
        const Json info = parseJson(run({"info", "short.wav", "--json"}).out.toStdString(), "info");
        QCOMPARE(info["sampleType"].get<std::string>(), std::string("int16"));
        const Json truth = readJsonFile(pathOf("truth.json"));
        QCOMPARE(truth["lines"].size(), std::size_t(1));
        QCOMPARE(truth["lines"][0]["snrDb"].get<double>(), 9.0);
        QCOMPARE(truth["lines"][0]["startSeconds"].get<double>(), 8.0);
    }
};

FAINTLINE_TEST(tst_cliTold)
#include "tst_cliTold.moc"

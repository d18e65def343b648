#include "scene/LineScene.h"
#include "support/test.h"

#include "scene/Truth.h"
#include "support/errors.h"

using namespace faintline;
using namespace faintline::test;

namespace {

const char *const example = R"({
    "kind": "lines", "sampleRateHz": 8000, "durationSeconds": 60, "complex": false, "centreHz": 0, "seed": 5,
    "noise": {"deviation": 0.2, "slopeDbPerOctave": -3, "levelDriftDb": 1, "levelDriftSeconds": 20},
    "lines": [{"snrDb": 3.5, "referenceSeconds": 0.5, "startSeconds": 10, "durationSeconds": 40,
               "frequencyHz": 1200, "driftHzPerSecond": -2, "wanderHz": 12, "wanderSeconds": 7.5,
               "fading": "rayleigh", "fadingSeconds": 6}, {}, {"fluctuation": "swerling3"}]})";

std::string refusal(const std::string &text)
{
    return errorOf([&] { lineSceneFromJson(parseJson(text, "scene")); });
}

} // namespace

/// Scenes and truths as JSON: what is written reads back the same, and what is wrong is named.
class tst_LineScene : public QObject
{
    Q_OBJECT

private slots:
    void readsTheDocumentedExample()
    {
        const LineScene scene = lineSceneFromJson(parseJson(example, "scene"));
        QCOMPARE(scene.sampleRateHz, 8000.0);
        QCOMPARE(scene.durationSeconds, 60.0);
        QCOMPARE(scene.seed, 5);
        QVERIFY((scene.noise == NoiseSettings{0.2, -3.0, 1.0, 20.0}));
        QVERIFY(
            (scene.lines.at(0) == LineSettings{3.5, 0.5, 10.0, 40.0, 1200.0, -2.0, 12.0, 7.5, Fading::Rayleigh, 6.0}));
        QVERIFY(scene.lines.at(1) == LineSettings{});
        QVERIFY(scene.lines.at(2) == LineSettings{.fluctuation = Fluctuation::Swerling3});
    }

    void defaults()
    {
        const LineScene scene = lineSceneFromJson(parseJson(R"({"sampleRateHz": 100, "durationSeconds": 1})", "scene"));
        LineScene expected{.sampleRateHz = 100.0, .durationSeconds = 1.0};
        QVERIFY(scene == expected);
    }

    void writtenReadsBackTheSame()
    {
        LineScene scene = lineSceneFromJson(parseJson(example, "scene"));
        scene.isComplex = true;
        scene.centreHz = 0.1;
        scene.lines[0].frequencyHz = -1234.5678901234567;
        const std::string text = toJson(scene).dump();
        QVERIFY(text.starts_with(R"({"kind":"lines","sampleRateHz":8000.0,)"));
        QVERIFY(lineSceneFromJson(parseJson(text, "scene")) == scene);
    }

    void refusals_data()
    {
        QTest::addColumn<QString>("scene");
        QTest::addColumn<QString>("message");
        const auto row = [](const char *name, const char *scene, const char *message) {
            QTest::newRow(name) << QString(scene) << QString::fromUtf8(message);
        };
        row("no rate", R"({"durationSeconds": 1})", "sampleRateHz: is missing; every other key has a default");
        row("no duration", R"({"sampleRateHz": 1})", "durationSeconds: is missing");
        row("other kind", R"({"kind": "pings", "sampleRateHz": 1, "durationSeconds": 1})", "kind: must be \"lines\"");
        row("unknown key", R"({"sampleRate": 1})",
            "sampleRate: unknown; expected one of kind, noise, lines, sampleRateHz, durationSeconds, complex");
        row("unknown key in a line", R"({"sampleRateHz": 1, "durationSeconds": 1, "lines": [{}, {"snr": 1}]})",
            "lines[1].snr: unknown; expected one of snrDb");
        row("unknown key in the noise", R"({"sampleRateHz": 1, "durationSeconds": 1, "noise": {"x": 1}})",
            "noise.x: unknown; expected one of deviation");
        row("rate 0", R"({"sampleRateHz": 0, "durationSeconds": 1})", "sampleRateHz = 0: must lie in 1e-06 … 1e+12 Hz");
        row("a text", R"({"sampleRateHz": "fast", "durationSeconds": 1})", "sampleRateHz = fast: must lie in");
        row("a list", R"({"sampleRateHz": [1], "durationSeconds": 1})", "sampleRateHz = […]: must lie in");
        row("half a seed", R"({"sampleRateHz": 1, "durationSeconds": 1, "seed": 1.5})",
            "seed = 1.5: must lie in 0 … 2147483647, a whole number");
        row("no sample", R"({"sampleRateHz": 1, "durationSeconds": 0.5})", "durationSeconds = 0.5: gives 0 samples");
        row("no list", R"({"sampleRateHz": 1, "durationSeconds": 1, "lines": {}})", "lines: must be a list");
        row("no object", "[]", "JSON: must be an object");
        row("SNR", R"({"sampleRateHz": 8000, "durationSeconds": 1, "lines": [{"snrDb": 200}]})",
            "lines[0].snrDb = 200: must lie in -60 … 120 dB");
        row("fading", R"({"sampleRateHz": 8000, "durationSeconds": 1, "lines": [{"fading": "x"}]})",
            "lines[0].fading = x: must be one of none, rayleigh");
        row("fluctuation", R"({"sampleRateHz": 8000, "durationSeconds": 1, "lines": [{"fluctuation": "swerling5"}]})",
            "lines[0].fluctuation = swerling5: must be one of none, swerling1, swerling2, swerling3, swerling4");
        row("fades and fluctuates",
            R"({"sampleRateHz": 8000, "durationSeconds": 1,
                "lines": [{"fading": "rayleigh", "fluctuation": "swerling2"}]})",
            "lines[0].fluctuation = swerling2: is not possible with fading; use one of the two");
        row("fluctuates too fast",
            R"({"sampleRateHz": 8000, "durationSeconds": 1e6,
                "lines": [{"fluctuation": "swerling2", "referenceSeconds": 1e-2}]})",
            "lines[0].referenceSeconds = 0.01: is too short for a fluctuating line of 1e+06 s");
        row("above the band", R"({"sampleRateHz": 8000, "durationSeconds": 1, "lines": [{"frequencyHz": 4001}]})",
            "lines[0].frequencyHz = 4001: the line must stay within 0 … 4000 Hz");
        row("drifts out", R"({"sampleRateHz": 8000, "durationSeconds": 9, "lines": [{"driftHzPerSecond": 500}]})",
            "within 0 … 4000 Hz, but drifts to 5500 Hz");
        row("below 0", R"({"sampleRateHz": 8000, "durationSeconds": 1, "lines": [{"frequencyHz": -1}]})",
            "must stay within 0 … 4000 Hz");
        row("complex band",
            R"({"sampleRateHz": 8000, "durationSeconds": 1, "complex": true, "centreHz": 1e6, "lines": [{}]})",
            "must stay within 996000 … 1004000 Hz");
        row("starts too late", R"({"sampleRateHz": 8000, "durationSeconds": 1, "lines": [{"startSeconds": 1}]})",
            "lines[0].startSeconds = 1: must lie before the end of the recording, 1 s");
        row("ends too late", R"({"sampleRateHz": 8000, "durationSeconds": 1, "lines": [{"durationSeconds": 2}]})",
            "extends the line beyond the end of the recording");
        row("wanders too fast",
            R"({"sampleRateHz": 8000, "durationSeconds": 1e6, "lines": [{"wanderHz": 1, "wanderSeconds": 1e-3}]})",
            "wanderSeconds = 0.001: is too short for a line of 1e+06 s");
        row("too steep", R"({"sampleRateHz": 8000, "durationSeconds": 1, "noise": {"slopeDbPerOctave": 7}})",
            "noise.slopeDbPerOctave = 7: must lie in -6 … 6 dB");
    }

    void refusals()
    {
        QFETCH(QString, scene);
        QFETCH(QString, message);
        const std::string said = refusal(scene.toStdString());
        QVERIFY2(said.starts_with(message.toStdString()) || contains(said, message.toStdString()), said.c_str());
    }

    void truthReadsBackTheSame()
    {
        const Truth truth{
            {{1.5, 2.5, -3.0, 0.25, 0.1234567890123, 0.5, {100.0, 101.1, 99.9}}, {0, 1, 2, 3, 4, 1, {5, 5}}}};
        QVERIFY(truthFromJson(parseJson(toJson(truth).dump(), "truth")) == truth);
        QVERIFY(truthFromJson(parseJson(R"({"lines": []})", "truth")) == Truth{});
    }

    void truthBetweenItsNodes()
    {
        const TruthLine line{1.0, 2.0, 0.0, 0.25, 1.0, 0.5, {100.0, 110.0, 90.0}};
        QCOMPARE(line.frequencyAt(0.0), 100.0);
        QCOMPARE(line.frequencyAt(1.0), 100.0);
        QCOMPARE(line.frequencyAt(1.25), 105.0);
        QCOMPARE(line.frequencyAt(1.75), 100.0);
        QCOMPARE(line.frequencyAt(2.0), 90.0);
        QCOMPARE(line.frequencyAt(9.0), 90.0);
    }

    void truthRefusals()
    {
        const auto said = [](const char *text) { return errorOf([&] { truthFromJson(parseJson(text, "truth")); }); };
        QVERIFY(contains(said("{}"), "truth.lines: must be a list"));
        QVERIFY(contains(said(R"({"lines": [{}]})"), "lines[0].frequencyHz: must hold at least one value"));
        QVERIFY(contains(said(R"({"lines": [{"frequencyHz": ["a"]}]})"),
                         "lines[0].frequencyHz = […]: must be a list of numbers"));
        QVERIFY(contains(said(R"({"lines": [{"f": 1}]})"), "lines[0].f: unknown"));
    }
};

FAINTLINE_TEST(tst_LineScene)
#include "tst_LineScene.moc"

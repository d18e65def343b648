#include "app/cli/CommandLineTest.h"
#include "base/json.h"
#include "support/test.h"

using namespace faintline;
using namespace faintline::test;

/// sequential: tests that look until they are sure, on frames and on a recording.
class tst_cliSequential : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase() { simulateLine(); }

    void sequentialByEye()
    {
        // λ = y, two cells, a target that stays: Λ = ½ (e^Σy₀ + e^Σy₁), ln 99 = 4.595 is passed at the third stage by
        // cell 1.
        writeArray(pathOf("eye3.npy"), {4, 2}, {0.5f, 2.0f, 1.0f, 2.0f, 0.0f, 2.0f, 7.0f, 7.0f});
        writeBytes(pathOf("eye3.json"), R"({"axes": [{"cells": 2}], "likelihood": {"kind": "linear"}})");
        QCOMPARE(run({"sequential", "--frames", "eye3.npy", "--model", "eye3.json", "--alpha", "0.01", "--beta", "0.01",
                      "--out", "eye3.out"})
                     .code,
                 0);
        const Json json = readJsonFile(pathOf("eye3.out"));
        QCOMPARE(json["decision"].get<std::string>(), std::string("H1"));
        QCOMPARE(json["stop"].get<int>(), 3);
        QCOMPARE(json["map"].dump(), std::string("[[1],[1],[1]]"));
        QVERIFY(std::abs(json["lnMapScore"].get<double>() - (6.0 - std::log(2.0))) < 1e-12);
        QCOMPARE(json["lnLambda"].size(), std::size_t(3));
        QVERIFY(std::abs(json["lnLambda"][2].get<double>() - std::log(0.5 * (std::exp(1.5) + std::exp(6.0)))) < 1e-12);

        QCOMPARE(run({"sequential", "--frames", "eye3.npy", "--model", "eye3.json", "--alpha", "1e-30", "--beta",
                      "1e-30", "--out", "eye3.out"})
                     .code,
                 0);
        const Json open = readJsonFile(pathOf("eye3.out"));
        QCOMPARE(open["decision"].get<std::string>(), std::string("undecided"));
        QCOMPARE(open["stop"].get<int>(), 4);
        QVERIFY(open["map"].empty() && open["lnMapScore"].is_null());
    }

    void sequentialInRadarScans()
    {
        writeBytes(pathOf("scans.json"),
                   R"({"kind": "scans", "azimuthCells": 2, "elevationCells": 2, "rangeCells": 20, "dopplerCells": 4,
           "snrDb": 20})");
        writeBytes(pathOf("scans.model"),
                   R"({"axes": [{"cells": 2, "step": "uniform-admissible"}, {"cells": 2, "step": "uniform-admissible"},
        {"cells": 20, "step": "uniform-admissible"}, {"cells": 4, "integrate": true}],
        "likelihood": {"kind": "exponential", "snr": 100}})");
        int found = 0;
        for (const char *seed : {"1", "2", "3", "4", "5"}) {
            QCOMPARE(
                run({"simulate", "scans.json", "--seed", seed, "--out", "scans.npy", "--truth", "scans.truth"}).code,
                0);
            QCOMPARE(run({"sequential", "--frames", "scans.npy", "--model", "scans.model", "--cutoff", "20", "--out",
                          "scans.out"})
                         .code,
                     0);
            const Json result = readJsonFile(pathOf("scans.out"));
            const Json truth = readJsonFile(pathOf("scans.truth"));
            const auto last = result["stop"].get<std::size_t>() - 1;
            found += result["decision"] == "H1" && result["map"][last] == truth["cells"][last] ? 1 : 0;
        }
        QVERIFY(found >= 4);
        const Outcome samples = run({"simulate", "scans.json", "--out", "scans.wav"});
        QCOMPARE(samples.code, 2);
        QVERIFY(samples.err.contains("must end in .npy"));
    }

    void sequentialInUnknownNoise()
    {
        // A target that stays in cell 3 of 9, then all of it 1000 times louder: to the average it is the same, to known
        // noise it is not.
        std::vector<float> y(3 * 9, 1.0f);
        for (const std::size_t stage : {0, 1, 2})
            y[stage * 9 + 3] = 12.0f;
        writeArray(pathOf("quiet.npy"), {3, 9}, y);
        for (float &value : y)
            value *= 1024.0f;
        writeArray(pathOf("loud.npy"), {3, 9}, y);
        writeBytes(pathOf("nine.json"),
                   R"({"axes": [{"cells": 9}], "likelihood": {"kind": "exponential", "snr": 10}})");
        const auto lnLambda = [this](const char *frames, const char *cells) {
            const QStringList options{"--model", "nine.json", "--alpha", "1e-9", "--beta", "1e-9", "--out", "nine.out"};
            const Outcome outcome = run(QStringList{"sequential", "--frames", frames, "--average", cells} + options);
            return outcome.code == 0 ? readJsonFile(pathOf("nine.out"))["lnLambda"].dump()
                                     : std::string(outcome.err.constData());
        };
        QCOMPARE(lnLambda("loud.npy", "4"), lnLambda("quiet.npy", "4"));
        QVERIFY(lnLambda("loud.npy", "0") != lnLambda("quiet.npy", "0"));
        // One stage by hand: the target's cell has t = 12, its neighbours 1/(1 + 11/4) or 1.
        const auto ratio = [](double t) { return std::pow((1.0 + t / 4.0) / (1.0 + t / 44.0), 5.0) / 11.0; };
        const double near = ratio(1.0 / (1.0 + 11.0 / 4.0));
        // Rows end: the four nearest of cells 0 and 1 are those within 0 … 4, which has the target.
        const double first = std::log((ratio(12.0) + 5.0 * near + 3.0 * ratio(1.0)) / 9.0);
        const Json quiet = parseJson(lnLambda("quiet.npy", "4"), "quiet");
        QVERIFY2(std::abs(quiet[0].get<double>() - first) < 1e-4,
                 qPrintable(QString::number(quiet[0].get<double>() - first)));
    }

    void sequentialInARecording()
    {
        // The line of the scene stands from 8 s to 23 s at 210 Hz: noise before it, a signal from it on. Designed for 3
        // dB: in the sixteen windows of noise that share no sample a line of -3 dB, the default, is not yet out of the
        // question.
        const QStringList part{"sequential", "line.wav",    "--set", "spectrogram.windowSeconds=0.5",
                               "--set",      "model.snr=2", "--low", "195",
                               "--high",     "225",         "--out", "part.out"};
        QCOMPARE(run(part + QStringList{"--from", "0", "--to", "8"}).code, 0);
        QCOMPARE(readJsonFile(pathOf("part.out"))["decision"].get<std::string>(), std::string("H0"));
        QCOMPARE(run(part + QStringList{"--from", "10", "--to", "20"}).code, 0);
        QCOMPARE(readJsonFile(pathOf("part.out"))["decision"].get<std::string>(), std::string("H1"));
    }

    void everyStageHoldsWithoutEvidence()
    {
        // y = 2 ln 2 is λ = 0 at ρ = 1: five slopes stay undecided for as long as the frames last.
        writeArray(pathOf("zero.npy"), {300, 41}, std::vector<float>(300 * 41, float(2.0 * std::log(2.0))));
        const double lambda = double(float(2.0 * std::log(2.0))) / 2.0 - std::log(2.0); // a float's rounding
        for (const char *cyclic : {"false", "true"}) {
            writeBytes(pathOf("five.json"), QByteArray(R"({"axes": [{"cells": 41, "rates": [-2, -1, 0, 1, 2],
            "rateChange": [0.3333333333333333, 0.3333333333333333], "cyclic": )")
                                                + cyclic + R"(}], "likelihood": {"kind": "exponential", "snr": 1}})");
            QCOMPARE(run({"sequential", "--frames", "zero.npy", "--model", "five.json", "--out", "zero.out"}).code, 0);
            const Json json = readJsonFile(pathOf("zero.out"));
            QCOMPARE(json["decision"].get<std::string>(), std::string("undecided"));
            QCOMPARE(json["stop"].get<int>(), 300);
            QCOMPARE(json["observedEvery"].get<int>(), 1);
            for (std::size_t stage = 0; stage < 300; ++stage)
                QVERIFY(std::abs(json["lnLambda"][stage].get<double>() - lambda * double(stage + 1)) < 1e-12);
        }
    }

    void overlappingFramesCountOnce()
    {
        const QStringList part{"sequential", "line.wav", "--low",   "195",
                               "--high",     "225",      "--from",  "10",
                               "--to",       "20",       "--alpha", "1e-200",
                               "--beta",     "1e-200",   "--set",   "spectrogram.windowSeconds=0.5"};
        const auto test = [&](const QStringList &more) {
            const Outcome outcome = run(part + more + QStringList{"--out", "part.out"});
            return outcome.code == 0 ? readJsonFile(pathOf("part.out")) : Json();
        };
        const auto changes = [](const Json &json) { // stages at which ln Λ moved
            std::vector<std::size_t> at;
            for (std::size_t stage = 1; stage < json["lnLambda"].size(); ++stage)
                if (std::abs(json["lnLambda"][stage].get<double>() - json["lnLambda"][stage - 1].get<double>()) > 1e-9)
                    at.push_back(stage);
            return at;
        };
        for (const int steps : {1, 2, 4}) {
            const Json json = test({"--set", "spectrogram.stepsPerWindow=" + QString::number(steps)});
            QCOMPARE(json["observedEvery"].get<int>(), steps);
            const std::vector<std::size_t> moved = changes(json);
            QVERIFY(moved.size() > 5);
            for (const std::size_t stage : moved)
                QCOMPARE(stage % std::size_t(steps), std::size_t(0));
        }
        QCOMPARE(test({"--every", "3"})["observedEvery"].get<int>(), 3);
    }

    void sequentialMistakes_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QString>("message");
        const QStringList frames{"--frames", "eye3.npy"};
        const QStringList model{"--model", "eye3.json"};
        writeBytes(pathOf("likely.json"), R"({"axes": [{"cells": 31}], "likelihood": {"kind": "linear"}})");
        QTest::newRow("nothing to look at") << model << "accepts either a recording or --frames";
        QTest::newRow("no model") << frames << "needs --model";
        QTest::newRow("α of 0") << frames + model + QStringList{"--alpha", "0"}
                                << "sequential.falseAlarm = 0: must lie in";
        QTest::newRow("a coin") << frames + model + QStringList{"--alpha", "0.5", "--beta", "0.5"} << "must be below 1";
        QTest::newRow("negative cut-off")
            << frames + model + QStringList{"--cutoff", "-1"} << "sequential.cutOffStage = -1";
        QTest::newRow("nothing to average")
            << frames + model + QStringList{"--average", "1"} << "--average: requires an exponential likelihood";
        QTest::newRow("every frame less than once")
            << frames + model + QStringList{"--every", "-1"} << "--every -1: must be at least 1";
        QTest::newRow("no ratio") << QStringList{"line.wav", "--set", "model.likelihood=linear"}
                                  << "model.likelihood: linear is not a likelihood ratio";
        QTest::newRow("no ratio in a file")
            << QStringList{"line.wav", "--model", "likely.json", "--set", "spectrogram.windowSeconds=0.5",
                           "--low",    "195",     "--high",      "225"}
            << "likely.json: likelihood.kind: linear is not a likelihood ratio";
        QTest::newRow("other cells") << frames + QStringList{"--model", "scans.model"}
                                     << "has 2 × 2 × 20 × 4 cells, but the frames of eye3.npy have 2";
    }

    void sequentialMistakes()
    {
        QFETCH(QStringList, arguments);
        QFETCH(QString, message);
        const Outcome outcome = run(QStringList{"sequential", "--out", "never.json"} + arguments);
        QCOMPARE(outcome.code, 2);
        QVERIFY2(QString::fromUtf8(outcome.err).contains(message), outcome.err.constData());
        QCOMPARE(outcome.err.count('\n'), 1);
        QVERIFY(!QFile::exists(path("never.json")));
    }
};

FAINTLINE_TEST(tst_cliSequential)
#include "tst_cliSequential.moc"

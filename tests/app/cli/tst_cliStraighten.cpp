#include "app/cli/CommandLineTest.h"
#include "support/test.h"

#include "base/Random.h"
#include "signal/ArrayRecording.h"
#include "signal/formats/writeRecording.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

using namespace faintline;
using namespace faintline::test;

/// straighten: a line that moves, kept at one frequency.
class tst_cliStraighten : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase() { simulateLine(); }

    void keepsADriftingLineAtOneFrequency()
    {
        const Outcome made =
            run(QStringList{"straighten", "line.wav", "--out", "straight.wav", "--curve", "curve.csv"} + lineSettings);
        QCOMPARE(made.err, QByteArray());
        QCOMPARE(made.code, 0);
        QVERIFY2(made.out.startsWith("event 1 of 1, "), made.out.data());
        // 210 Hz at 8 s and 0.2 Hz/s from there.
        for (const QByteArray &line : content("curve.csv").split('\n').mid(1)) {
            const QList<QByteArray> values = line.split(',');
            if (const double t = values[0].toDouble(); values.size() == 2 && t > 9.0 && t < 22.0)
                QVERIFY2(std::abs(values[1].toDouble() - (210.0 + 0.2 * (t - 8.0))) < 0.3, line.data());
        }
        QVERIFY(QFile::exists(path("straight.wav.provenance.json")));
        const Outcome found = run(QStringList{"detect", "straight.wav", "--events", "events.csv"} + lineSettings);
        QCOMPARE(found.code, 0);
        const QList<QByteArray> rows = content("events.csv").trimmed().split('\n');
        QCOMPARE(rows.size(), 2);
        const QList<QByteArray> names = rows[0].split(',');
        const QList<QByteArray> values = rows[1].split(',');
        QVERIFY(std::abs(values[names.indexOf("f")].toDouble() - 211.5) < 1.5);
        QVERIFY(std::abs(values[names.indexOf("drift_hz_per_s")].toDouble()) < 0.1);
    }

    /// Three multiples of a fundamental that drifts: all of them stay, of a shift only the fundamental does.
    void resamplesAFamily()
    {
        writeBytes(pathOf("family.json"),
                   R"({"kind": "lines", "sampleRateHz": 500, "durationSeconds": 60, "seed": 3, "lines": [
        {"frequencyHz": 50, "driftHzPerSecond": 0.1, "snrDb": 10},
        {"frequencyHz": 100, "driftHzPerSecond": 0.2, "snrDb": 10},
        {"frequencyHz": 150, "driftHzPerSecond": 0.3, "snrDb": 10}]})");
        QCOMPARE(run({"simulate", "family.json", "--out", "family.wav"}).code, 0);
        const QStringList window{"--set", "spectrogram.windowSeconds=1"};
        const QStringList straighten =
            QStringList{"straighten", "family.wav",          "--set", "family.relation=harmonics",
                        "--set",      "family.members=1,2,3"}
            + window;
        const auto drifts = [&](const QString &name) {
            const Outcome found = run(QStringList{"detect", name, "--events", "events.csv"} + window);
            const QList<QByteArray> rows = content("events.csv").trimmed().split('\n');
            const QList<QByteArray> names = rows[0].split(',');
            std::map<int, double> drift;
            for (const QByteArray &row : rows.mid(1)) {
                const QList<QByteArray> values = row.split(',');
                if (values[names.indexOf("t_end")].toDouble() - values[names.indexOf("t_onset")].toDouble() > 40.0)
                    drift[qRound(values[names.indexOf("f")].toDouble())] =
                        values[names.indexOf("drift_hz_per_s")].toDouble();
            }
            return drift;
        };
        const Outcome resampled = run(straighten + QStringList{"--target", "52", "--out", "resampled.wav"});
        QCOMPARE(resampled.err, QByteArray());
        QVERIFY2(resampled.out.contains("resampled, now at 52 Hz"), resampled.out.data());
        const std::map<int, double> still = drifts("resampled.wav");
        for (const int hz : {52, 104, 156})
            QVERIFY2(still.contains(hz) && std::abs(still.at(hz)) < 0.005, qPrintable(QString::number(hz)));
        QCOMPARE(run(straighten + QStringList{"--target", "52", "--method", "shift", "--out", "shifted.wav"}).code, 0);
        const std::map<int, double> moving = drifts("shifted.wav");
        QVERIFY(moving.contains(52) && std::abs(moving.at(52)) < 0.005);
        QVERIFY(std::none_of(moving.begin(), moving.end(),
                             [](const auto &line) { return line.first > 60 && std::abs(line.second) < 0.05; }));
        const Outcome low = run(straighten + QStringList{"--target", "2", "--out", "none.wav"});
        QVERIFY2(low.err.contains("by a factor of 8 at most"), low.err.data());
    }

    void leavesTheRest()
    {
        const Outcome made =
            run(QStringList{"straighten", "line.wav", "--out", "straight.wav", "--rest", "rest.wav"} + lineSettings);
        QCOMPARE(made.err, QByteArray());
        QCOMPARE(made.code, 0);
        QVERIFY(QFile::exists(path("rest.wav.provenance.json")));
        QVERIFY(run(QStringList{"detect", "line.wav"} + lineSettings).out.contains("\n1 event(s)\n"));
        QVERIFY(run(QStringList{"detect", "rest.wav"} + lineSettings).out.contains("\n0 event(s)\n"));
    }

    void saysWhatCannotBeStraightened()
    {
        const auto refused = [this](const QStringList &arguments, const char *why) {
            const Outcome outcome = run(arguments + lineSettings);
            QCOMPARE(outcome.code, 2);
            QVERIFY2(outcome.err.contains(why), outcome.err.data());
            QCOMPARE(outcome.err.count('\n'), 1);
            QVERIFY(!QFile::exists(path("none.wav")));
        };
        refused({"straighten", "line.wav", "--event", "7", "--out", "none.wav"}, "there is no such event");
        refused({"straighten", "line.wav", "--from", "24", "--out", "none.wav"}, "a lower threshold finds more");
        refused({"straighten", "line.wav", "--target", "900", "--out", "none.wav"}, "must lie in the recording's band");
        refused({"straighten", "line.wav", "--smooth", "0.1", "--out", "none.wav"}, "must last 2 to 4096 frames");
        refused({"straighten", "line.wav", "--smooth", "1e6", "--out", "none.wav"}, "must last 2 to 4096 frames");
        refused({"straighten", "line.wav", "--set", "family.relation=offsets", "--out", "none.wav"},
                "at least one member");
    }

    /// Modulator and decoder are those of wsjtx; tests/wspr.py takes hundreds of such messages.
    void decodesADriftingMessage()
    {
        const QString simulator = QStandardPaths::findExecutable("wsprsim");
        const QString decoder = QStandardPaths::findExecutable("wsprd");
        if (simulator.isEmpty() || decoder.isEmpty())
            QSKIP("wsprsim and wsprd of wsjtx are not installed");
        const auto output = [this](const QString &command, const QStringList &arguments) {
            QProcess process;
            process.setWorkingDirectory(folder());
            process.start(command, arguments);
            return process.waitForFinished(patience) ? process.readAllStandardOutput() : QByteArray();
        };
        const QByteArray message = "K1ABC FN42 33";
        std::vector<int> tones;
        const QByteArray told = output(simulator, {"-c", message});
        for (const QByteArray &word : told.mid(told.indexOf("symbols:") + 8).simplified().split(' '))
            tones.push_back(word.toInt());
        QCOMPARE(tones.size(), std::size_t(162));
        writeMessage(tones, 20.0, -23.0);
        QVERIFY(!output(decoder, {"200101_0000.wav"}).contains(message));
        const Outcome made = run({"straighten", "200101_0000.wav", "--low", "1390", "--high", "1610", "--set",
                                  "spectrogram.windowSeconds=0.683", "--set", "family.relation=offsets", "--set",
                                  "family.members=0,1.4648,2.9297,4.3945", "--set", "family.present=inTurn", "--type",
                                  "int16", "--out", "200101_0002.wav"});
        QCOMPARE(made.err, QByteArray());
        QCOMPARE(made.code, 0);
        QVERIFY(output(decoder, {"200101_0002.wav"}).contains(message));
    }

private:
    /// Four tones, 1.4648 Hz apart, one at a time, in noise: 120 s at 12 kHz, SNR in 2500 Hz.
    void writeMessage(const std::vector<int> &tones, double driftHz, double snrDb) const
    {
        constexpr double rate = 12000.0;
        constexpr Index symbol = 8192;
        const auto samples = std::make_shared<std::vector<float>>(std::size_t(120.0 * rate));
        Random random(17, 0);
        random.normals(*samples, 0.05f);
        const double amplitude = 0.05 * std::sqrt(2.0 * std::pow(10.0, 0.1 * snrDb) * 2500.0 / (0.5 * rate));
        const Index length = std::ssize(tones) * symbol;
        double cycles = 0.0;
        for (Index n = 0; n < length; ++n) {
            const double tone = tones[std::size_t(n / symbol)];
            const double part = double(n) / double(length);
            cycles += (1470.0 + tone * rate / symbol + driftHz * (part - 0.5)) / rate;
            (*samples)[std::size_t(n) + 12000] += float(amplitude * std::sin(2.0 * std::numbers::pi * cycles));
        }
        const ArrayRecording recording("message", std::shared_ptr<const float>(samples, samples->data()),
                                       ArrayLayout{rate, std::ssize(*samples), 1, false, 0.0});
        writeRecording(recording, pathOf("200101_0000.wav"), WrittenType::Int16);
    }
};

FAINTLINE_TEST(tst_cliStraighten)
#include "tst_cliStraighten.moc"

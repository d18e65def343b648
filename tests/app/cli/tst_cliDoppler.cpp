#include "app/cli/CommandLineTest.h"
#include "base/Random.h"
#include "base/json.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace faintline;
using namespace faintline::test;

/// doppler: a simulated pass from its samples to its intervals, and what is refused.
class tst_cliDoppler : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        writePass("slow.wav", slow, false);
        writePass("fast.wav", fast, false);
        writePass("iq.wav", high, true);
        writePass("whistle.wav", slow, false, 30.0);
        writePass("steady.wav", slow, false, 0.1, 60.0);
        writePass("hum.wav", {330.0, 0.0, 10.0, 0.0}, false);
    }

    void intervalsHoldTheTruth()
    {
        const Outcome told = run(QStringList{"doppler", "slow.wav"} + settings);
        QCOMPARE(told.code, 0);
        QCOMPARE(told.err, QByteArray());
        QVERIFY2(told.out.startsWith("event 1, the strongest of "), told.out.constData());
        for (const char *word : {"rest frequency", "speed", "closest range", "closest approach", "heard at",
                                 "90 % interval", "residuals: rms", "note: One sensor cannot tell on which side"})
            QVERIFY2(told.out.contains(word), word);

        const Json fit = fitOf({"slow.wav"});
        QVERIFY(holds(fit["rest_frequency"], slow.restHz));
        QVERIFY(holds(fit["speed"], slow.metresPerSecond));
        QVERIFY(holds(fit["closest_range"], slow.rangeMetres));
        QVERIFY(holds(fit["closest_approach"], slow.closestSeconds));
        QVERIFY(fit["speed"]["high"].get<double>() - fit["speed"]["low"].get<double>() < 1.0);
        QVERIFY(fit["closest_range"]["high"].get<double>() - fit["closest_range"]["low"].get<double>() < 20.0);
        QVERIFY(std::abs(fit["heard_s"].get<double>() - 58.0 - 200.0 / speedOfSound) < 0.3);
        QCOMPARE(fit["propagation_m_per_s"].get<double>(), 343.0);
        const Outcome again = run({"replay", "fit.json"});
        QVERIFY2(again.code == 0, again.err.constData());
    }

    void pointsAndChart()
    {
        const QStringList arguments =
            QStringList{"doppler", "slow.wav", "--out", "fit.csv", "--chart", "fit.svg"} + settings;
        const Outcome told = run(arguments);
        QCOMPARE(told.code, 0);
        QVERIFY(content("fit.csv").startsWith("t,f,deviation,fitted,residual,left_out\n"));
        const auto rows = numbersOf(content("fit.csv"));
        QVERIFY(rows.size() > 300);
        for (const std::vector<double> &row : rows)
            QVERIFY(std::abs(row[1] - row[3] - row[4]) < 1e-9);
        const QByteArray chart = content("fit.svg");
        QVERIFY(chart.startsWith("<svg"));
        for (const char *word : {"Doppler fit, event 1", "Frequency (Hz)", "Residual (Hz)", "Time (s)"})
            QVERIFY2(chart.contains(word), word);
        QCOMPARE(run(arguments + QStringList{"--threads", "1"}).code, 0);
        QVERIFY(content("fit.svg") == chart);
    }

    /// Too steep for the path around the closest approach, so each half says little, and both together say all.
    void piecesOfAFastPass()
    {
        QCOMPARE(run(QStringList{"detect", "fast.wav", "--events", "events.json"} + settings).code, 0);
        const Json events = parseJson(content("events.json").toStdString(), "events.json")["events"];
        QStringList numbers;
        for (const Json &event : events)
            if (event["t_end"].get<double>() - event["t_onset"].get<double>() > 20.0)
                numbers << "--event" << QString::number(event["event"].get<int>());
        QCOMPARE(numbers.size(), qsizetype(4));
        const Json half = fitOf(QStringList{"fast.wav"} + numbers.mid(0, 2));
        const Json both = fitOf(QStringList{"fast.wav"} + numbers);
        for (const Json *fit : {&half, &both}) {
            QVERIFY(holds((*fit)["rest_frequency"], fast.restHz));
            QVERIFY(holds((*fit)["speed"], fast.metresPerSecond));
            QVERIFY(holds((*fit)["closest_range"], fast.rangeMetres));
            QVERIFY(holds((*fit)["closest_approach"], fast.closestSeconds));
        }
        QVERIFY(half["notes"].dump().find("closest approach may lie outside the track") != std::string::npos);
        QVERIFY(half["notes"].dump().find("as steep as the model allows") != std::string::npos);
        QVERIFY(std::abs(both["speed"]["estimate"].get<double>() - fast.metresPerSecond) < 1.0);
        QCOMPARE(both["events"].size(), std::size_t(2));
    }

    void mediumScalesSpeedAndRange()
    {
        const Json air = fitOf({"slow.wav"});
        const Json water = fitOf({"slow.wav", "--medium", "water"});
        const Json own = fitOf({"slow.wav", "--speed-of-sound", "1500"});
        const auto estimate = [](const Json &fit, const char *name) { return fit[name]["estimate"].get<double>(); };
        for (const char *name : {"speed", "closest_range"})
            QVERIFY(std::abs(estimate(water, name) / estimate(air, name) - 1500.0 / 343.0) < 1e-4);
        QVERIFY(std::abs(estimate(water, "rest_frequency") - estimate(air, "rest_frequency")) < 1e-4);
        QCOMPARE(own.dump(), water.dump());
    }

    /// The frequency of a recording in quadrature is an offset; a wrong centre would scale the speed.
    void quadratureNeedsItsCentre()
    {
        const QStringList arguments = QStringList{"doppler", "iq.wav", "--iq"} + settings;
        const Outcome told = run(arguments);
        QCOMPARE(told.code, 2);
        QVERIFY2(told.err.contains("give --centre HZ"), told.err.constData());
        QCOMPARE(told.err.count('\n'), 1);
        const Json fit = fitOf({"iq.wav", "--iq", "--centre", "1000"});
        QVERIFY(holds(fit["rest_frequency"], high.restHz));
        QVERIFY(holds(fit["speed"], high.metresPerSecond));
        QVERIFY(std::abs(fit["speed"]["estimate"].get<double>() - 8.0) < 0.1);
        QCOMPARE(fit["centre_hz"].get<double>(), 1000.0);
    }

    /// The strongest event is too short for a fit: the pass is taken, or named.
    void aWhistleIsPassedOver()
    {
        int whistle = 0, pass = 0;
        passIsTakenBesideAStronger("whistle", whistle, pass);
        const Outcome asked =
            run(QStringList{"doppler", "whistle.wav", "--event", QString::number(whistle)} + settings);
        QCOMPARE(asked.code, 2);
        QVERIFY2(asked.err.contains("needs at least") && asked.err.contains(" " + QByteArray::number(pass))
                     && asked.err.trimmed().endsWith(" can be fitted"),
                 asked.err.constData());
    }

    /// Its fit has no errors, but says nothing: no speed explains a constant frequency better than none.
    void aSteadyToneIsPassedOver()
    {
        int tone = 0, pass = 0;
        passIsTakenBesideAStronger("steady", tone, pass);
        const Outcome asked = run(QStringList{"doppler", "steady.wav", "--event", QString::number(tone)} + settings);
        QVERIFY2(asked.code == 0, asked.err.constData()); // what was asked for, with its note
        QVERIFY2(asked.out.contains("No Doppler shift"), asked.out.constData());
    }

    void aLoneSteadyToneIsNotAPass()
    {
        const Outcome told = run(QStringList{"doppler", "hum.wav", "--out", "hum.json"} + settings);
        QCOMPARE(told.code, 2);
        QVERIFY2(told.err.startsWith("error: hum.wav: none of ") && told.err.contains("can be fitted; event ")
                     && told.err.contains("intervals of the fit are open"),
                 told.err.constData());
        QCOMPARE(told.err.count('\n'), 1);
        QVERIFY(!QFile::exists(path("hum.json")));
    }

    void refusals_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QByteArray>("part");
        QTest::newRow("no such event") << QStringList{"slow.wav", "--event", "99"}
                                       << QByteArray("there is no such event");
        QTest::newRow("a name of another kind")
            << QStringList{"slow.wav", "--out", "fit.txt"} << QByteArray(".json or .csv");
        QTest::newRow("a chart of another kind")
            << QStringList{"slow.wav", "--chart", "fit.png"} << QByteArray("end in .svg");
        QTest::newRow("an event twice") << QStringList{"slow.wav", "--event", "1", "--event", "1"}
                                        << QByteArray("same time");
        QTest::newRow("too short") << QStringList{"slow.wav", "--to", "2"} << QByteArray("");
        QTest::newRow("both media") << QStringList{"slow.wav", "--medium", "air", "--speed-of-sound", "340"}
                                    << QByteArray("excludes");
        QTest::newRow("no speed") << QStringList{"slow.wav", "--speed-of-sound", "0"} << QByteArray("--speed-of-sound");
    }

    void refusals()
    {
        QFETCH(QStringList, arguments);
        QFETCH(QByteArray, part);
        const Outcome told = run(QStringList{"doppler"} + arguments + settings);
        QCOMPARE(told.code, 2);
        QVERIFY2(told.err.startsWith("error: ") && told.err.count('\n') == 1, told.err.constData());
        QVERIFY2(told.err.contains(part), told.err.constData());
        QVERIFY(!QFile::exists(path("fit.txt")));
    }

private:
    /// The pass at 210 Hz of a recording is fitted, although the event at 330 Hz is stronger; their numbers.
    void passIsTakenBesideAStronger(const QString &name, int &stronger, int &pass)
    {
        const QString recording = name + ".wav";
        QCOMPARE(run(QStringList{"detect", recording, "--events", name + ".csv"} + settings).code, 0);
        const auto rows = numbersOf(content(name + ".csv"));
        stronger = numberNear(rows, 330.0);
        pass = numberNear(rows, 210.0);
        QVERIFY(stronger > 0 && pass > 0);
        QVERIFY(rows[std::size_t(stronger - 1)][6] > rows[std::size_t(pass - 1)][6]);

        const Outcome told = run(QStringList{"doppler", recording} + settings);
        QVERIFY2(told.code == 0, told.err.constData());
        QVERIFY2(told.out.startsWith("event " + QByteArray::number(pass) + ", the strongest of ")
                     && told.out.contains(" that can be fitted: "),
                 told.out.constData());
    }

    static constexpr double speedOfSound = 343.0;
    static constexpr int rate = 1000;
    static constexpr double length = 120.0; ///< s

    struct Pass {
        double restHz, metresPerSecond, rangeMetres, closestSeconds;
    };

    /// The phase of a source that passes, in turns: f0 times the time of emission, which is found by bisection.
    static double turns(const Pass &pass, double t)
    {
        double low = t - 100.0;
        double high = t;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            const double range = std::hypot(pass.rangeMetres, pass.metresPerSecond * (middle - pass.closestSeconds));
            (middle + range / speedOfSound < t ? low : high) = middle;
        }
        return pass.restHz * 0.5 * (low + high);
    }

    /// Tone and noise of variance 0.01; the amplitude is that of 12 dB over the noise in one second. In quadrature
    /// 1000 Hz are taken off.
    /// `whistleAmplitude`: of `whistleSeconds` at 330 Hz from 20 s on.
    void writePass(const char *name, const Pass &pass, bool isComplex, double whistleAmplitude = 0.0,
                   double whistleSeconds = 1.0) const
    {
        const auto count = std::size_t(length * rate);
        std::vector<float> noise(2 * count);
        Random(12, 0).normals(noise, 0.1f);
        const double amplitude = 0.1 * std::pow(10.0, 12.0 / 20.0) * 2.0 / std::sqrt(rate);
        std::vector<float> samples;
        for (std::size_t i = 0; i < count; ++i) {
            const double t = double(i) / rate;
            const double angle = 2.0 * std::numbers::pi * (turns(pass, t) - (isComplex ? 1000.0 * t : 0.0));
            samples.push_back(noise[2 * i] + float(amplitude * std::cos(angle)));
            if (t >= 20.0 && t < 20.0 + whistleSeconds)
                samples.back() += float(whistleAmplitude * std::cos(2.0 * std::numbers::pi * 330.0 * t));
            if (isComplex)
                samples.push_back(noise[2 * i + 1] + float(amplitude * std::sin(angle)));
        }
        writeAudio(pathOf(name), SF_FORMAT_WAV | SF_FORMAT_FLOAT, isComplex ? 2 : 1, rate, samples);
    }

    static bool holds(const Json &parameter, double truth)
    {
        return (parameter["low"].is_null() || parameter["low"].get<double>() <= truth)
               && (parameter["high"].is_null() || truth <= parameter["high"].get<double>());
    }

    /// Of the first event at a frequency, as `detect` lists it; or 0.
    static int numberNear(const std::vector<std::vector<double>> &rows, double hz)
    {
        const auto found = std::ranges::find_if(rows, [&](const auto &row) { return std::abs(row[4] - hz) < 25.0; });
        return found == rows.end() ? 0 : int(found->front());
    }

    Json fitOf(const QStringList &arguments) const
    {
        const Outcome told = run(QStringList{"doppler"} + arguments + settings + QStringList{"--out", "fit.json"});
        if (told.code != 0)
            qWarning("%s", told.err.constData());
        return told.code == 0 ? parseJson(content("fit.json").toStdString(), "fit.json") : Json();
    }

    inline static const QStringList settings{"--set", "spectrogram.windowSeconds=0.5"};
    const Pass slow{210.0, 30.0, 200.0, 58.0};
    const Pass high{1210.0, 8.0, 60.0, 58.0};
    const Pass fast{230.0, 48.0, 130.0, 63.0};
};

FAINTLINE_TEST(tst_cliDoppler)
#include "tst_cliDoppler.moc"

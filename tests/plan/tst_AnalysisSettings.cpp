#include "support/test.h"

#include "base/Random.h"
#include "plan/firstSettings.h"
#include "support/errors.h"

using namespace faintline;
using namespace faintline::test;

/// The one settings value: its table, its text form, its checks.
class tst_AnalysisSettings : public QObject
{
    Q_OBJECT

private slots:
    void everyFieldHasNameSentenceAndDefault()
    {
        QStringList names, labels;
        for (const auto &field : AnalysisSettings::fields()) {
            names << QString::fromStdString(field.name);
            QVERIFY(field.name.find('.') != std::string::npos);
            QVERIFY2(field.sentence.ends_with('.'), field.name.c_str());
            QVERIFY2(field.advice.ends_with('.') && field.advice != field.sentence, field.name.c_str());
            checkFieldValue(field, defaultValue(field));
            const std::string stage = field.name.substr(0, field.name.find('.'));
            labels << QString::fromStdString(stage + "." + labelOf(field));
        }
        QCOMPARE(labels.removeDuplicates(), 0); // rows of one section can be told apart
        QCOMPARE(names.removeDuplicates(), 0);
        QVERIFY(names.contains("spectrogram.windowSeconds")); // relied on from outside
        QVERIFY(names.contains("decide.falseAlarmsPerHour"));
    }

    void roundTripOfRandomSettings()
    {
        Random random(9, 1);
        for (int trial = 0; trial < 200; ++trial) {
            AnalysisSettings settings;
            for (const auto &field : AnalysisSettings::fields()) {
                if (random.uniform() < 0.5 || field.name == "model.slopeChange" || field.name == "model.lowestSlope"
                    || field.name == "model.highestSlope" || field.name == "conventional.hits"
                    || field.name == "model.rangeRateChange" || field.name == "model.bearingRateChange"
                    || field.name == "family.relation" || field.name == "subtract.lines") // held by others
                    continue;
                switch (field.kind) {
                case FieldKind::Flag:
                    field.set(settings, random.uniform() < 0.5);
                    break;
                case FieldKind::Integer:
                    field.set(settings, int(std::max(3.0, field.minimum) + std::floor(random.uniform() * 10.0)));
                    break;
                case FieldKind::Number:
                    field.set(settings,
                              field.minimum + random.uniform() * (std::min(field.maximum, 1e6) - field.minimum));
                    break;
                case FieldKind::Choice:
                    field.set(settings, field.choices[std::size_t(random.uniform() * double(field.choices.size()))]);
                    break;
                case FieldKind::Numbers:
                    field.set(settings, std::vector<double>{1.0, 2.5});
                    break;
                }
            }
            if (!settings.family.members.empty()) {
                settings.family.relation = FamilySettings::Relation::Harmonics;
                settings.noise.causal = false; // which a family refuses
            }
            if (!settings.selection.channels.empty()) // whole numbers, the first of them the channel
                settings.selection.channels = {double(settings.selection.channel),
                                               double(settings.selection.channel + 1)};
            settings.subtract.lines = !settings.noise.causal && settings.track.bothWays && settings.family.isNone()
                                      && settings.selection.channels.empty()
                                      && std::holds_alternative<SmdSettings>(settings.detector)
                                      && settings.model.likelihood != LikelihoodKind::Linear; // others refuse it
            const double slope = 1.0 / settings.model.slopesPerBin;
            settings.model.lowestSlope = -slope * std::floor(random.uniform() * 20.0);
            settings.model.highestSlope = slope * std::floor(random.uniform() * 20.0);
            QVERIFY(settingsFromJson(settingsToJson(settings), "test") == settings);
            QVERIFY(settingsFromJson(settingsToJson(settings, false), "test") == settings);
        }
    }

    void settingAThresholdChoosesIt()
    {
        AnalysisSettings settings;
        setSetting(settings, "decide.thresholdNats", "12.5");
        QVERIFY(settings.decide.by == DecideSettings::By::Nats);
        setSetting(settings, "decide.falseAlarmsPerHour", "3");
        QVERIFY(settings.decide.by == DecideSettings::By::FalseAlarmsPerHour);
    }

    void jsonKeepsTheChoice()
    {
        AnalysisSettings settings;
        setSetting(settings, "decide.thresholdNats", "12.5");
        setSetting(settings, "decide.pfaPerCell", "1e-5");
        setSetting(settings, "decide.by", "falseAlarmsPerHour");
        QVERIFY(settingsFromJson(settingsToJson(settings), "test") == settings);
    }

    void eachEdgeOfTheBandCanBeGivenAlone()
    {
        using Words = std::pair<std::string, std::string>;
        const auto words = [](const AnalysisSettings &settings) {
            const auto word = [&](const auto &field) { return formatFieldValue(field, *field.get(settings)); };
            return Words(word(settingField("selection.lowHz")), word(settingField("selection.highHz")));
        };
        const auto again = [](const AnalysisSettings &settings) {
            return settingsFromJson(settingsToJson(settings), "test") == settings
                   && settingsFromJson(settingsToJson(settings, false), "test") == settings;
        };
        AnalysisSettings settings;
        QVERIFY(words(settings) == Words("lowest", "highest") && isWholeBand(settings.selection));
        setSetting(settings, "selection.lowHz", "100");
        QVERIFY(words(settings) == Words("100", "highest") && !isWholeBand(settings.selection) && again(settings));
        setSetting(settings, "selection.lowHz", "lowest");
        QVERIFY(settings == AnalysisSettings());
        setSetting(settings, "selection.highHz", "80");
        QVERIFY(words(settings) == Words("lowest", "80") && !isWholeBand(settings.selection) && again(settings));
        setSetting(settings, "selection.lowHz", "0");
        QVERIFY(words(settings) == Words("0", "80") && again(settings));
        setSetting(settings, "selection.highHz", "0");
        QVERIFY(isWholeBand(settings.selection)); // as in earlier files
        const char *earlier = R"({"selection.lowHz": 0, "selection.highHz": 0})";
        QVERIFY(settingsFromJson(earlier, "test") == AnalysisSettings());
    }

    void wordsOfNumbersAreRead()
    {
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = 0.5;
        settings.selection.toSeconds = 20.0;
        setSetting(settings, "spectrogram.windowSeconds", "automatic");
        setSetting(settings, "selection.toSeconds", "end");
        QVERIFY(settings == AnalysisSettings());
        setSetting(settings, "detector.kind", "pOfN");
        setSetting(settings, "pOfN.r2", "none");
        QCOMPARE(std::get<PofNSettings>(settings.detector).r2, 0.0);
        QVERIFY(contains(errorOf([&] { setSetting(settings, "selection.toSeconds", "ende"); }), "or \"end\""));
    }

    void refusals()
    {
        AnalysisSettings settings;
        QVERIFY(contains(errorOf([&] { setSetting(settings, "spectrogram.windowSecond", "1"); }),
                         "did you mean spectrogram.windowSeconds"));
        QVERIFY(contains(errorOf([&] { setSetting(settings, "spectrogram.windowSeconds", "-1"); }),
                         "must lie in 0 … 1e+06 s"));
        QVERIFY(contains(errorOf([&] { setSetting(settings, "spectrogram.window", "round"); }),
                         "must be one of rectangular, hann"));
        QVERIFY(contains(errorOf([&] { settingsFromJson("{\"a\": 1}", "x.json"); }), "unknown setting"));
        QVERIFY(contains(errorOf([&] { settingsFromJson("{", "x.json"); }), "x.json"));
        setSetting(settings, "model.slopeChange", "0.5, 0.1");
        QVERIFY(contains(errorOf([&] { checkSettings(settings); }), "it must be 1"));
        settings = {};
        settings.model.lowestSlope = 3;
        QVERIFY(contains(errorOf([&] { checkSettings(settings); }), "must not exceed model.highestSlope"));
        settings = {};
        settings.model.highestSlope = 0.9;
        QVERIFY(contains(errorOf([&] { checkSettings(settings); }),
                         "model.highestSlope = 0.9: must be a multiple of 1/8 bin/frame (model.slopesPerBin)"));
        settings.model.slopesPerBin = 10;
        checkSettings(settings);
        settings.model.lowestSlope = -100.0;
        QVERIFY(contains(errorOf([&] { checkSettings(settings); }), "gives 1010 slopes; at most 1001 are possible"));
    }

    void everyRuleRefusesItsSetting_data()
    {
        QTest::addColumn<std::size_t>("rule");
        QTest::addColumn<QStringList>("settings");
        const std::vector<QStringList> refused{
            {"selection.channels=0, 0.5"},
            {"family.relation=harmonics", "family.members=1, 1"},
            {"family.relation=harmonics", "family.members=1, 2", "noise.causal=true"},
            {"subtract.lines=true", "track.bothWays=false"},
            {"model.lowestSlope=2", "model.highestSlope=1"},
            {"model.lowestSlope=-0.3"},
            {"model.highestSlope=101"},
            {"model.slopesPerBin=64", "model.lowestSlope=-8", "model.highestSlope=8"},
            {"conventional.hits=9", "conventional.window=8"},
            {"model.slopeChange=0.5, 0.1"},
            {"model.rangeRateChange=0.5, 0.1"},
            {"model.bearingRateChange=0.5, 0.1"}};
        QCOMPARE(refused.size(), settingRules().size());
        for (std::size_t rule = 0; rule < refused.size(); ++rule)
            QTest::addRow("%s %zu", settingRules()[rule].field.c_str(), rule) << rule << refused[rule];
    }

    void everyRuleRefusesItsSetting()
    {
        QFETCH(std::size_t, rule);
        QFETCH(QStringList, settings);
        AnalysisSettings refused;
        settingRules()[rule].check(refused); // the defaults obey it
        for (const QString &setting : settings)
            setSetting(refused, setting.section('=', 0, 0).toStdString(), setting.section('=', 1).toStdString());
        const auto fieldOf = [&](const auto &check) {
            try {
                check(refused);
            } catch (const Error &error) {
                return error.field();
            }
            return std::string();
        };
        for (std::size_t before = 0; before < rule; ++before) // later rules presuppose the earlier ones
            QCOMPARE(fieldOf(settingRules()[before].check), std::string());
        QCOMPARE(fieldOf(settingRules()[rule].check), settingRules()[rule].field);
        QCOMPARE(fieldOf(&checkSettings), settingRules()[rule].field);
    }

    void stages()
    {
        const AnalysisSettings a;
        AnalysisSettings b = a;
        QVERIFY(firstStale(a, b) == Stage::Nothing);
        b.decide.falseAlarmsPerHour = 2.0;
        QVERIFY(firstStale(a, b) == Stage::Detector);
        b.pings.guardCells = 9;
        QVERIFY(firstStale(a, b) == Stage::Noise);
        b = a;
        b.noise.halfWidthCells = 9;
        QVERIFY(firstStale(a, b) == Stage::Noise);
        b.selection.channel = 1;
        QVERIFY(firstStale(a, b) == Stage::Spectrogram);
    }

    void presetsAreSound()
    {
        for (const Preset &p : presets())
            checkSettings(p.settings);
        QVERIFY(contains(errorOf([] { preset("none"); }), "choose one of lines"));
    }

    void slowRecordingsHaveOneFalseAlarmInTheirLength()
    {
        RecordingInfo recording;
        recording.sampleRateHz = 1.0 / 60.0;
        recording.sampleCount = 86400; // 1440 h
        QCOMPARE(firstSettings(recording).decide.falseAlarmsPerHour, 1.0 / 1440.0);
        recording.sampleCount = 30; // half an hour: one an hour is less than one
        QVERIFY(firstSettings(recording) == AnalysisSettings());
        recording.sampleRateHz = 100.0;
        recording.sampleCount = 100 * 3600 * 1440;
        QVERIFY(firstSettings(recording) == AnalysisSettings());
        recording.sampleRateHz = 0.5;
        recording.sampleCount = 36000; // 20 h
        AnalysisSettings chosen = preset("narrowband").settings;
        chosen.decide.falseAlarmsPerHour = 3.0;
        QVERIFY(withFittedOrder(chosen, recording) == chosen); // asked for by the user
        chosen.decide.falseAlarmsPerHour = 1.0;
        QCOMPARE(withFittedOrder(chosen, recording).decide.falseAlarmsPerHour, 1.0 / 20.0);
        chosen.decide.by = DecideSettings::By::PfaPerCell;
        QVERIFY(withFittedOrder(chosen, recording) == chosen);
    }
};

FAINTLINE_TEST(tst_AnalysisSettings)
#include "tst_AnalysisSettings.moc"

#include "evaluate/experiments/Experiment.h"

#include "base/Error.h"
#include "base/files/fileName.h"
#include "base/wholeNumber.h"
#include "signal/openRecording.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    using Table = std::vector<Field<Experiment>>;

    Field<Experiment> seedField()
    {
        return field(&Experiment::seed, "seed", "", 0.0, 2147483647.0, "Seed of all random numbers.");
    }

    Field<Experiment> iqField()
    {
        return field(&Experiment::iq, "iq", "Treat two channels as I and Q.").labelled("I and Q");
    }

    Field<Experiment> snrsField()
    {
        return field(&Experiment::snrDb, "snrDb", "dB", -60.0, 60.0,
                     "Signal-to-noise ratios in a frame with a rectangular window.")
            .labelled("SNR");
    }

    Table fieldsOfLines()
    {
        using S = Experiment;
        return {
            seedField(),
            field(&S::trials, "runs", "", 1.0, 1e7, "Number of fields to simulate; each contains one line per block."),
            field(&S::frames, "frames", "frames", 2.0, 1e5, "Length of a field."),
            field(&S::blockFrames, "blockFrames", "frames", 2.0, 1e5, "Length of a block."),
            field(&S::blockBins, "blockBins", "bins", 2.0, 1e5, "Width of a block."),
            field(&S::stepsPerWindow, "stepsPerWindow", "", 1.0, 16.0, "Frames per window, k_t."),
            field(&S::binsPerCell, "binsPerCell", "", 1.0, 16.0, "Bins per resolution cell, k_f."),
            field(&S::window, "window", windowShapeNames, "Shape of the window."),
            snrsField(),
            field(&S::durationSeconds, "durationWindows", "windows", 0.5, 1e5, "Duration of a line.")
                .labelled("Duration"),
            field(&S::driftHzPerSecond, "driftCellsPerWindow", "cells/window", -100.0, 100.0, "Steady drift of a line.")
                .labelled("Drift"),
            field(&S::wanderHz, "wanderCells", "cells", 0.0, 1000.0, "Standard deviation of a line's wander.")
                .labelled("Wander"),
            field(&S::wanderSeconds, "wanderWindows", "windows", 0.01, 1e5, "Correlation time of the wander.")
                .labelled("Time of the wander"),
            field(&S::fading, "fading", fadingNames, "Whether the amplitude fades."),
            field(&S::fadingSeconds, "fadingWindows", "windows", 0.01, 1e5, "Correlation time of the fading.")
                .labelled("Time of the fading"),
            field(&S::fluctuation, "fluctuation", fluctuationNames,
                  "Fluctuation of a line's power about its mean: one power for the whole line (Swerling 1 and 3), or "
                  "one for each window (2 and 4)."),
        };
    }

    Table fieldsOfInjection()
    {
        using S = Experiment;
        Table table{iqField(), seedField(),
                    field(&S::trials, "trials", "", 1.0, 1e7, "Number of lines to add, one at a time."), snrsField()};
        table.insert(table.end(), lineProperties().begin() + 1, lineProperties().end());
        table.push_back(field(&S::falseAlarmsPerHour, "falseAlarmsPerHour", "1/h", 1e-9, 1e9,
                              "False alarms per hour of the whole selection.")
                            .labelled("False alarms"));
        table.push_back(field(&S::marginSeconds, "marginSeconds", "s", 0.0, 1e6,
                              "Recording before and after a line that `detect` as a whole is given.")
                            .labelled("Noise around"));
        return table;
    }

    Table fieldsOfSweep()
    {
        using S = Experiment;
        Table table{iqField(), seedField(),
                    field(&S::trials, "trials", "", 1.0, 1e6, "Number of lines on which every value is tried.")};
        table.insert(table.end(), lineProperties().begin(), lineProperties().end());
        table.push_back(field(&S::marginSeconds, "marginSeconds", "s", 0.0, 1e6,
                              "Noise before and after a line, in which false alarms are counted.")
                            .labelled("Noise around"));
        table.push_back(field(&S::sampleRateHz, "sampleRateHz", "Hz", 1e-3, 1e9, "Sample rate of simulated noise."));
        return table;
    }

    const Field<Experiment> *lineProperty(const std::string &name)
    {
        const auto found = std::ranges::find(lineProperties(), name, &FieldInfo::name);
        return found == lineProperties().end() ? nullptr : &*found;
    }

    FieldValue valueOf(const FieldInfo &field, double value)
    {
        if (field.kind != FieldKind::Integer)
            return value;
        if (value != std::round(value))
            throw Error(field.name + " = " + formatNumber(value), "must be a whole number");
        return int(value);
    }

    FieldInfo anyNumber(const std::string &name, FieldKind kind)
    {
        FieldInfo info;
        info.name = name;
        info.minimum = -1e300;
        info.maximum = 1e300;
        info.kind = kind;
        return info;
    }

    /// The values of "values": a list, or a range.
    std::vector<double> valuesFromJson(const Json &json, const std::string &parameter, const std::string &where)
    {
        const auto found = json.find("values");
        const std::string name = jsonName(where, "values");
        if (found == json.end())
            throw Error(name, "must be a list of values, or {\"from\": …, \"to\": …, \"steps\": …}");
        const FieldInfo list = anyNumber(name, FieldKind::Numbers);
        if (found->is_array())
            return std::get<std::vector<double>>(fieldValueFromJson(*found, list));
        checkKeys(*found, name, {"from", "to", "steps", "scale"});
        const auto number = [&](const char *key) {
            if (!found->contains(key))
                throw Error(jsonName(name, key), "is missing");
            return std::get<double>(
                fieldValueFromJson((*found)[key], anyNumber(jsonName(name, key), FieldKind::Number)));
        };
        const Json scale = found->value("scale", Json("linear"));
        if (scale != "linear" && scale != "log")
            throw Error(jsonName(name, "scale") + " = " + scale.dump(), "must be \"linear\" or \"log\"");
        const double steps = number("steps");
        if (steps != std::round(steps) || steps < 2.0 || steps > 1000.0)
            throw Error(jsonName(name, "steps") + " = " + formatNumber(steps), "must be a whole number in 2 … 1000");
        return sweepValues(parameter, number("from"), number("to"), int(steps), scale == "log");
    }

    /// Refuses what only a sweep can do, because it runs all of `detect`.
    void checkIsPlain(const AnalysisSettings &settings)
    {
        checkHasNoFamily(settings, "is not possible in this experiment");
        checkSubtractsNothing(settings, "is not possible in this experiment");
    }

    void checkLines(const Experiment &lines)
    {
        if (Experiment::windowSamples % lines.stepsPerWindow != 0)
            throw fieldError("stepsPerWindow", std::to_string(lines.stepsPerWindow),
                             "must divide 250, the samples of a window");
        if (lines.blocksInTime() < 1 || lines.blocksInFrequency() < 1)
            throw Error("blockFrames, blockBins", "a block must fit into the field of " + std::to_string(lines.frames)
                                                      + " × " + std::to_string(lines.bins()) + " cells");
        if (lines.signalFrames() < 1 || lines.signalFrames() > lines.blockFrames)
            throw fieldError("durationWindows", formatNumber(lines.durationSeconds),
                             "a line must last 1 … blockFrames = " + std::to_string(lines.blockFrames) + " frames");
        if (lines.fluctuation != Fluctuation::None && lines.fading != Fading::None)
            throw fieldError("fluctuation", std::string(fluctuationNames[std::size_t(lines.fluctuation)]),
                             "is not possible with fading; use one of the two");
        const double room = double(lines.blockBins) / lines.binsPerCell - 4.0;
        if (std::abs(lines.driftHzPerSecond) * lines.durationSeconds + 4.0 * lines.wanderHz > room)
            throw Error("driftCellsPerWindow, wanderCells", "a line must stay within its block of blockBins = "
                                                                + std::to_string(lines.blockBins) + " bins");
        for (const DetectorUnderTest &detector : lines.detectors) {
            checkSettings(detector.settings);
            checkHasOneChannel(detector.settings, "is not possible in this experiment");
        }
    }

    void checkSweep(const Experiment &sweep)
    {
        if (sweep.values.empty())
            throw Error("values", "must hold at least one value");
        constexpr std::size_t mostRuns = 10'000'000;
        if (sweep.values.size() > mostRuns / std::size_t(sweep.trials))
            throw fieldError("trials", std::to_string(sweep.trials),
                             "times " + std::to_string(sweep.values.size())
                                 + " values gives more than 10 million trials");
        for (std::size_t i = 0; i < sweep.values.size(); ++i) {
            const Experiment one = experimentAt(sweep, i);
            if (!sweep.recording.empty())
                continue;
            LineScene scene;
            scene.sampleRateHz = one.sampleRateHz;
            scene.durationSeconds = one.trialSeconds();
            checkScene(scene);
        }
    }

    std::vector<DetectorUnderTest> detectorsFromJson(const Json &json, const std::string &where)
    {
        const auto list = json.find("detectors");
        if (list == json.end() || !list->is_array() || list->empty())
            throw Error(jsonName(where, "detectors"), "must be a list of {\"name\": …, \"settings\": {…}}");
        std::vector<DetectorUnderTest> detectors;
        for (std::size_t i = 0; i < list->size(); ++i) {
            const std::string name = jsonName(where, "detectors[" + std::to_string(i) + "]");
            const Json &entry = (*list)[i];
            checkKeys(entry, name, {"name", "settings", "whole"});
            if (!entry.contains("name") || !entry["name"].is_string())
                throw Error(jsonName(name, "name"), "must be a string");
            DetectorUnderTest detector{entry["name"].get<std::string>(), {}};
            if (entry.contains("settings"))
                detector.settings = settingsFromJson(entry["settings"].dump(), jsonName(name, "settings"));
            if (const auto whole = entry.find("whole"); whole != entry.end()) {
                if (!whole->is_boolean())
                    throw Error(jsonName(name, "whole"), "must be true or false");
                detector.isWhole = whole->get<bool>();
            }
            detectors.push_back(std::move(detector));
        }
        return detectors;
    }

    Json detectorsJson(const std::vector<DetectorUnderTest> &detectors)
    {
        Json list = Json::array();
        for (const DetectorUnderTest &detector : detectors) {
            list.push_back({{"name", detector.name}, {"settings", Json::parse(settingsToJson(detector.settings))}});
            if (detector.isWhole) // files of experiments without it stay as they were
                list.back()["whole"] = true;
        }
        return list;
    }

    Experiment::Kind kindOf(const Json &json, const std::string &where)
    {
        const Json kind = json.value("kind", Json(Experiment::kindNames.front()));
        const auto found = std::ranges::find(Experiment::kindNames, kind.is_string() ? kind.get<std::string>() : "");
        if (found == Experiment::kindNames.end())
            throw Error(jsonName(where, "kind") + (kind.is_string() ? " = " + kind.get<std::string>() : ""),
                        "must be lines, injection or sweep");
        return Experiment::Kind(found - Experiment::kindNames.begin());
    }

    /// Keys of the members that are no fields, for each kind.
    constexpr std::initializer_list<const char *> otherKeys[]{
        {"kind", "detectors"},
        {"kind", "recording", "settings", "detectors"},
        {"kind", "recording", "settings", "parameter", "values"},
    };

} // namespace

Experiment Experiment::of(Kind kind)
{
    Experiment experiment;
    experiment.kind = kind;
    if (kind == Kind::Lines)
        return experiment;
    experiment.wanderSeconds = 10.0;
    if (kind == Kind::Injection) {
        experiment.trials = 200;
        experiment.snrDb = {-3.0, 0.0, 3.0};
        experiment.durationSeconds = experiment.marginSeconds = 60.0;
    } else {
        experiment.trials = 40;
        experiment.snrDb = {0.0};
        experiment.durationSeconds = experiment.marginSeconds = 20.0;
    }
    return experiment;
}

const std::vector<Field<Experiment>> &Experiment::fields(Kind kind)
{
    static const std::vector<Field<Experiment>> tables[]{fieldsOfLines(), fieldsOfInjection(), fieldsOfSweep()};
    return tables[std::size_t(kind)];
}

const std::vector<Field<Experiment>> &lineProperties()
{
    using S = Experiment;
    static const std::vector<Field<S>> table = [] {
        Field<S> snr =
            field(&S::snrDb, "snrDb", "dB", -60.0, 60.0, "Signal-to-noise ratio in a frame with a rectangular window.")
                .labelled("SNR");
        snr.kind = FieldKind::Number; // of a sweep's only one
        snr.get = [](const S &s) { return s.snrDb.front(); };
        snr.set = [](S &s, const FieldValue &value) { s.snrDb = {std::get<double>(value)}; };
        return std::vector<Field<S>>{
            snr,
            field(&S::durationSeconds, "durationSeconds", "s", 1e-6, 1e7, "Duration of a line.").labelled("Duration"),
            field(&S::driftHzPerSecond, "driftHzPerSecond", "Hz/s", -1e9, 1e9, "Steady drift of a line.")
                .labelled("Drift"),
            field(&S::wanderHz, "wanderHz", "Hz", 0.0, 1e9, "Standard deviation of a line's wander.")
                .labelled("Wander"),
            field(&S::wanderSeconds, "wanderSeconds", "s", 1e-6, 1e7, "Correlation time of the wander.")
                .labelled("Time of the wander"),
        };
    }();
    return table;
}

int Experiment::signalFrames() const
{
    return int(std::lround(durationSeconds * stepsPerWindow));
}

const FieldInfo &parameterInfo(const std::string &parameter)
{
    if (const Field<Experiment> *property = lineProperty(parameter))
        return *property;
    const bool isSetting = parameter.find('.') != std::string::npos;
    const Field<AnalysisSettings> *field = isSetting ? &settingField(parameter) : nullptr;
    if (!field || !isSweepable(*field))
        throw fieldError("parameter", parameter,
                         "must be a setting that is one number, such as model.snr, or a number of the line: snrDb, "
                         "durationSeconds, driftHzPerSecond, wanderHz, wanderSeconds");
    return *field;
}

bool isSweepable(const FieldInfo &field)
{
    return (field.kind == FieldKind::Integer || field.kind == FieldKind::Number)
           && !field.name.starts_with("selection.") && !field.name.starts_with("pings.")
           && !field.name.starts_with("conventional.");
}

std::vector<double> sweepValues(const std::string &parameter, double from, double to, int steps, bool isLogarithmic)
{
    const FieldInfo &field = parameterInfo(parameter);
    if (isLogarithmic && !(from > 0.0 && to > 0.0))
        throw Error("values.from, values.to", "must be above 0 on a logarithmic scale");
    std::vector<double> values;
    for (int i = 0; i < steps; ++i) {
        const double share = steps > 1 ? double(i) / (steps - 1) : 0.0;
        double value = isLogarithmic ? from * std::pow(to / from, share) : from + (to - from) * share;
        // Rounds away the digits that a division leaves behind.
        const double scale = std::pow(10.0, 5.0 - std::ceil(std::log10(std::max(std::abs(value), 1e-300))));
        value = field.kind == FieldKind::Integer ? std::round(value)
                : value == 0.0                   ? 0.0
                                                 : std::round(value * scale) / scale;
        if (values.empty() || value != values.back())
            values.push_back(value);
    }
    return values;
}

Experiment experimentAt(const Experiment &sweep, std::size_t value)
{
    Experiment result = sweep;
    const FieldInfo &info = parameterInfo(sweep.parameter);
    const FieldValue held = valueOf(info, sweep.values[value]);
    checkFieldValue(info, held);
    if (const Field<Experiment> *property = lineProperty(sweep.parameter)) {
        property->set(result, held);
    } else {
        const Field<AnalysisSettings> &field = settingField(sweep.parameter);
        field.set(result.settings, held);
        if (!field.get(result.settings))
            throw fieldError("parameter", sweep.parameter, "belongs to a different detector than the one selected");
    }
    checkSettings(result.settings);
    checkHasOneChannel(result.settings, "is not possible in this experiment");
    return result;
}

AnalysisSettings settingsOf(const Experiment &injection, std::size_t detector)
{
    AnalysisSettings settings = injection.settings;
    settings.model = injection.detectors[detector].settings.model;
    settings.detector = injection.detectors[detector].settings.detector;
    return settings;
}

LineSettings lineOf(const Experiment &experiment, double snrDb, double referenceSeconds)
{
    return {.snrDb = snrDb,
            .referenceSeconds = referenceSeconds,
            .durationSeconds = experiment.durationSeconds,
            .frequencyHz = 0.0,
            .driftHzPerSecond = experiment.driftHzPerSecond,
            .wanderHz = experiment.wanderHz,
            .wanderSeconds = experiment.wanderSeconds,
            .fading = experiment.fading,
            .fadingSeconds = experiment.fadingSeconds,
            .fluctuation = experiment.fluctuation};
}

void checkExperiment(const Experiment &experiment, const std::string &where)
{
    checkFields(experiment, Experiment::fields(experiment.kind));
    if (experiment.isSweep())
        return checkSweep(experiment);
    if (experiment.detectors.empty())
        throw Error(jsonName(where, "detectors"), "must name at least one detector");
    if (experiment.snrDb.empty())
        throw Error(jsonName(where, "snrDb"), "must hold at least one value");
    if (experiment.isLines())
        checkLines(experiment);
    checkIsPlain(experiment.settings);
    checkHasOneChannel(experiment.settings, "is not possible in this experiment");
    for (const DetectorUnderTest &detector : experiment.detectors)
        checkIsPlain(detector.settings);
}

Experiment experimentFromJson(const Json &json, const std::string &where)
{
    if (!json.is_object())
        throw Error(where, "must be a JSON object");
    Experiment experiment = Experiment::of(kindOf(json, where));
    readFields(json, Experiment::fields(experiment.kind), experiment, where, otherKeys[std::size_t(experiment.kind)]);
    if (const auto recording = json.find("recording"); recording != json.end() && recording->is_string())
        experiment.recording = recording->get<std::string>();
    if (experiment.recording.empty() && (json.contains("recording") || experiment.kind == Experiment::Kind::Injection))
        throw Error(jsonName(where, "recording"), "must be the path of a recording");
    if (const auto settings = json.find("settings"); settings != json.end())
        experiment.settings = settingsFromJson(settings->dump(), jsonName(where, "settings"));
    if (!experiment.isSweep()) {
        experiment.detectors = detectorsFromJson(json, where);
    } else {
        if (!json.contains("parameter") || !json["parameter"].is_string())
            throw Error(jsonName(where, "parameter"), "must name the setting, or the number of the line, to vary");
        experiment.parameter = json["parameter"].get<std::string>();
        experiment.values = valuesFromJson(json, experiment.parameter, where);
    }
    checkExperiment(experiment, where);
    return experiment;
}

Json toJson(const Experiment &experiment)
{
    Json whole{{"kind", Experiment::kindNames[std::size_t(experiment.kind)]}};
    if (!experiment.recording.empty())
        whole["recording"] = experiment.recording;
    whole.update(writeFields(experiment, Experiment::fields(experiment.kind)));
    if (!experiment.isLines())
        whole["settings"] = Json::parse(settingsToJson(experiment.settings));
    if (!experiment.isSweep()) {
        whole["detectors"] = detectorsJson(experiment.detectors);
    } else {
        whole["parameter"] = experiment.parameter;
        whole["values"] = experiment.values;
    }
    return whole;
}

int runFromJson(const Json &json, const Experiment &experiment, const std::string &where)
{
    const int run = wholeNumber<int>(json, where);
    if (run < 0 || run >= experiment.runs())
        throw Error(where + " = " + std::to_string(run), "must lie in 0 … " + std::to_string(experiment.runs() - 1));
    return run;
}

std::string recordingOf(const Experiment &experiment)
{
    return fileNameFromText(experiment.recording);
}

RecordingPointer openRecordingOf(const Experiment &experiment)
{
    OpenOptions options;
    options.iq = experiment.iq;
    const std::string recording = recordingOf(experiment);
    return recording.empty() ? RecordingPointer() : openRecording(recording, options);
}

} // namespace faintline

#include "evaluate/experiments/SweepExperiment.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    const Field<SweepExperiment> *lineProperty(const std::string &name)
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
        const std::string scale = found->value("scale", std::string("linear"));
        if (scale != "linear" && scale != "log")
            throw Error(jsonName(name, "scale") + " = " + scale, "must be linear or log");
        const double steps = number("steps");
        if (steps != std::round(steps) || steps < 2.0 || steps > 1000.0)
            throw Error(jsonName(name, "steps") + " = " + formatNumber(steps), "must be a whole number in 2 … 1000");
        return sweepValues(parameter, number("from"), number("to"), int(steps), scale == "log");
    }

} // namespace

const std::vector<Field<SweepExperiment>> &SweepExperiment::fields()
{
    using S = SweepExperiment;
    static const std::vector<Field<S>> table = [] {
        std::vector<Field<S>> all{
            field(&S::iq, "iq", "Treat two channels as I and Q.").labelled("I and Q"),
            field(&S::seed, "seed", "", 0.0, 2147483647.0, "Seed of all random numbers."),
            field(&S::trials, "trials", "", 1.0, 1e6, "Number of lines on which every value is tried."),
        };
        all.insert(all.end(), lineProperties().begin(), lineProperties().end());
        all.push_back(field(&S::marginSeconds, "marginSeconds", "s", 0.0, 1e6,
                            "Noise before and after a line, in which false alarms are counted.")
                          .labelled("Noise around"));
        all.push_back(field(&S::sampleRateHz, "sampleRateHz", "Hz", 1e-3, 1e9, "Sample rate of simulated noise."));
        return all;
    }();
    return table;
}

const std::vector<Field<SweepExperiment>> &lineProperties()
{
    using S = SweepExperiment;
    static const std::vector<Field<S>> table{
        field(&S::snrDb, "snrDb", "dB", -60.0, 60.0, "Signal-to-noise ratio in a frame with a rectangular window.")
            .labelled("SNR"),
        field(&S::durationSeconds, "durationSeconds", "s", 1e-6, 1e6, "Duration of a line.").labelled("Duration"),
        field(&S::driftHzPerSecond, "driftHzPerSecond", "Hz/s", -1e9, 1e9, "Steady drift of a line.").labelled("Drift"),
        field(&S::wanderHz, "wanderHz", "Hz", 0.0, 1e9, "Standard deviation of a line's wander.").labelled("Wander"),
        field(&S::wanderSeconds, "wanderSeconds", "s", 1e-6, 1e7, "Correlation time of the wander.")
            .labelled("Time of the wander"),
    };
    return table;
}

const FieldInfo &parameterInfo(const std::string &parameter)
{
    if (const Field<SweepExperiment> *property = lineProperty(parameter))
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

SweepExperiment experimentAt(const SweepExperiment &experiment, std::size_t value)
{
    SweepExperiment result = experiment;
    const FieldInfo &info = parameterInfo(experiment.parameter);
    const FieldValue held = valueOf(info, experiment.values[value]);
    checkFieldValue(info, held);
    if (const Field<SweepExperiment> *property = lineProperty(experiment.parameter)) {
        property->set(result, held);
    } else {
        const Field<AnalysisSettings> &field = settingField(experiment.parameter);
        field.set(result.settings, held);
        if (!field.get(result.settings))
            throw fieldError("parameter", experiment.parameter,
                             "belongs to a different detector than the one selected");
    }
    checkSettings(result.settings);
    checkHasOneChannel(result.settings, "is not possible in this experiment");
    return result;
}

void checkExperiment(const SweepExperiment &experiment)
{
    checkFields(experiment, SweepExperiment::fields());
    if (experiment.values.empty())
        throw Error("values", "must hold at least one value");
    constexpr std::size_t mostRuns = 10'000'000;
    if (experiment.values.size() > mostRuns / std::size_t(experiment.trials))
        throw fieldError("trials", std::to_string(experiment.trials),
                         "times " + std::to_string(experiment.values.size())
                             + " values gives more than 10 million trials");
    for (std::size_t i = 0; i < experiment.values.size(); ++i) {
        const SweepExperiment one = experimentAt(experiment, i);
        if (!experiment.recording.empty())
            continue;
        LineScene scene;
        scene.sampleRateHz = one.sampleRateHz;
        scene.durationSeconds = one.trialSeconds();
        checkScene(scene);
    }
}

SweepExperiment sweepExperimentFromJson(const Json &json, const std::string &where)
{
    SweepExperiment experiment;
    readFields(json, SweepExperiment::fields(), experiment, where,
               {"kind", "recording", "settings", "parameter", "values"});
    if (json.contains("recording")) {
        if (!json["recording"].is_string())
            throw Error(jsonName(where, "recording"), "must be the path of a recording");
        experiment.recording = json["recording"].get<std::string>();
    }
    if (!json.contains("parameter") || !json["parameter"].is_string())
        throw Error(jsonName(where, "parameter"), "must name the setting, or the number of the line, to vary");
    experiment.parameter = json["parameter"].get<std::string>();
    const Json base = json.contains("settings") ? json["settings"] : Json::object();
    experiment.settings = settingsFromJson(base.dump(), jsonName(where, "settings"));
    experiment.values = valuesFromJson(json, experiment.parameter, where);
    checkExperiment(experiment);
    return experiment;
}

Json toJson(const SweepExperiment &experiment)
{
    Json whole{{"kind", "sweep"}};
    if (!experiment.recording.empty())
        whole["recording"] = experiment.recording;
    whole.update(writeFields(experiment, SweepExperiment::fields()));
    whole["settings"] = Json::parse(settingsToJson(experiment.settings));
    whole["parameter"] = experiment.parameter;
    whole["values"] = experiment.values;
    return whole;
}

} // namespace faintline

#include "evaluate/experiments/InjectionExperiment.h"

#include "base/Error.h"

namespace faintline {

const std::vector<Field<InjectionExperiment>> &InjectionExperiment::fields()
{
    using S = InjectionExperiment;
    static const std::vector<Field<S>> table{
        field(&S::iq, "iq", "Treat two channels as I and Q.").labelled("I and Q"),
        field(&S::seed, "seed", "", 0.0, 2147483647.0, "Seed of all random numbers."),
        field(&S::trials, "trials", "", 1.0, 1e7, "Number of lines to add, one at a time."),
        field(&S::snrDb, "snrDb", "dB", -60.0, 60.0, "Signal-to-noise ratios in a frame with a rectangular window.")
            .labelled("SNR"),
        field(&S::durationSeconds, "durationSeconds", "s", 1e-6, 1e7, "Duration of a line.").labelled("Duration"),
        field(&S::driftHzPerSecond, "driftHzPerSecond", "Hz/s", -1e9, 1e9, "Steady drift of a line.").labelled("Drift"),
        field(&S::wanderHz, "wanderHz", "Hz", 0.0, 1e9, "Standard deviation of a line's wander.").labelled("Wander"),
        field(&S::wanderSeconds, "wanderSeconds", "s", 1e-6, 1e7, "Correlation time of the wander.")
            .labelled("Time of the wander"),
        field(&S::falseAlarmsPerHour, "falseAlarmsPerHour", "1/h", 1e-9, 1e9,
              "False alarms per hour of the whole selection.")
            .labelled("False alarms"),
        field(&S::marginSeconds, "marginSeconds", "s", 0.0, 1e6,
              "Recording before and after a line that `detect` as a whole is given.")
            .labelled("Noise around"),
    };
    return table;
}

InjectionExperiment injectionExperimentFromJson(const Json &json, const std::string &where)
{
    InjectionExperiment experiment;
    readFields(json, InjectionExperiment::fields(), experiment, where, {"kind", "recording", "settings", "detectors"});
    if (!json.contains("recording") || !json["recording"].is_string())
        throw Error(jsonName(where, "recording"), "must be the path of a recording");
    experiment.recording = json["recording"].get<std::string>();
    const Json base = json.contains("settings") ? json["settings"] : Json::object();
    experiment.settings = settingsFromJson(base.dump(), jsonName(where, "settings"));
    experiment.detectors = detectorsFromJson(json, where);
    if (experiment.snrDb.empty())
        throw Error(jsonName(where, "snrDb"), "must hold at least one value");
    return experiment;
}

Json toJson(const InjectionExperiment &experiment)
{
    Json whole{{"kind", "injection"}, {"recording", experiment.recording}};
    whole.update(writeFields(experiment, InjectionExperiment::fields()));
    whole["settings"] = Json::parse(settingsToJson(experiment.settings));
    whole["detectors"] = toJson(experiment.detectors);
    return whole;
}

AnalysisSettings settingsOf(const InjectionExperiment &experiment, std::size_t detector)
{
    AnalysisSettings settings = experiment.settings;
    settings.model = experiment.detectors[detector].settings.model;
    settings.detector = experiment.detectors[detector].settings.detector;
    return settings;
}

} // namespace faintline

#include "calibrate/CalibrationRequest.h"

#include "base/json.h"

#include <numeric>

namespace faintline {

namespace {

    SelectionSettings onlyCounted(const SelectionSettings &selection)
    {
        SelectionSettings counted;
        if (const std::vector<double> &channels = selection.channels; channels.size() > 1) {
            counted.channels.resize(channels.size());
            std::iota(counted.channels.begin(), counted.channels.end(), 0.0);
        } else if (channels == std::vector{-1.0}) {
            counted.channels = channels;
        }
        return counted;
    }

    /// What acts on the causal chain, at any threshold.
    AnalysisSettings ofTheChain(AnalysisSettings settings)
    {
        const DecideSettings decide;
        settings.decide.falseAlarmsPerHour = decide.falseAlarmsPerHour;
        settings.decide.pfaPerCell = decide.pfaPerCell;
        settings.decide.thresholdNats = decide.thresholdNats;
        settings.decide.by = decide.by;
        settings.track.bothWays = TrackSettings{}.bothWays;
        settings.noise.blankDc = NormaliserSettings{}.blankDc;
        settings.subtract = {};
        settings.conventional = {};
        settings.pings = {};
        using Reset = SmdSettings::Reset;
        if (auto *smd = std::get_if<SmdSettings>(&settings.detector);
            smd && (smd->reset == Reset::Calibrated || smd->reset == Reset::Half))
            smd->lnK = SmdSettings{}.lnK; // is found
        return settings;
    }

    Json jsonOfAxis(const KinematicAxis &axis)
    {
        return {{"cells", axis.cells},
                {"cyclic", axis.cyclic},
                {"firstRate", axis.firstRate},
                {"rateCount", axis.rateCount},
                {"rateChange", axis.rateChange},
                {"step", axis.step},
                {"rounding", int(axis.rounding)},
                {"renormalised", axis.renormalised},
                {"ratesPerCell", axis.ratesPerCell},
                {"transition", axis.transition}};
    }

    KinematicAxis axisOfJson(const Json &json)
    {
        KinematicAxis axis;
        json.at("cells").get_to(axis.cells);
        json.at("cyclic").get_to(axis.cyclic);
        json.at("firstRate").get_to(axis.firstRate);
        json.at("rateCount").get_to(axis.rateCount);
        json.at("rateChange").get_to(axis.rateChange);
        json.at("step").get_to(axis.step);
        axis.rounding = Rounding(json.at("rounding").get<int>());
        json.at("renormalised").get_to(axis.renormalised);
        json.at("ratesPerCell").get_to(axis.ratesPerCell);
        json.at("transition").get_to(axis.transition);
        return axis;
    }

    Json jsonOfModel(const MarkovModel &model)
    {
        Json axes = Json::array();
        for (const KinematicAxis &axis : model.space.axes())
            axes.push_back(jsonOfAxis(axis));
        return {{"axes", axes},
                {"likelihood", int(model.likelihood.kind())},
                {"snr", model.likelihood.snr()},
                {"transitionScale", model.transitionScale}};
    }

    MarkovModel modelOfJson(const Json &json)
    {
        std::vector<KinematicAxis> axes;
        for (const Json &axis : json.at("axes"))
            axes.push_back(axisOfJson(axis));
        return {StateSpace(std::move(axes)),
                Likelihood(LikelihoodKind(json.at("likelihood").get<int>()), json.at("snr").get<double>()),
                json.at("transitionScale").get<double>()};
    }

} // namespace

std::string CalibrationRequest::key() const
{
    Json json = Json::object();
    if (depth == CalibrationDepth::FirstEstimate)
        json["first"] = true;
    if (bins > 0)
        json["bins"] = bins;
    if (model) {
        json["model"] = jsonOfModel(*model);
        json["cellFrames"] = cellFrames;
    }
    json["settings"] = Json::parse(settingsToJson(settings));
    return json.dump();
}

CalibrationRequest requestOf(const std::string &key)
{
    const std::string where = "a calibration's key";
    const Json json = parseJson(key, where);
    return readingJson(where, [&] {
        CalibrationRequest request;
        request.settings = settingsFromJson(json.at("settings").dump(), where);
        if (json.value("first", false))
            request.depth = CalibrationDepth::FirstEstimate;
        request.bins = json.value("bins", Index(0));
        if (json.contains("model"))
            request.model = modelOfJson(json["model"]);
        request.cellFrames = json.value("cellFrames", 0.0);
        return request;
    });
}

AnalysisSettings dimensionless(AnalysisSettings settings)
{
    settings = ofTheChain(std::move(settings));
    settings.selection = onlyCounted(settings.selection);
    if (settings.spectrogram.windowSeconds > 0.0)
        settings.family = scaledFamily(settings.family, settings.spectrogram.windowSeconds / calibrationWindowSamples);
    settings.spectrogram.windowSeconds = calibrationWindowSamples;
    return settings;
}

AnalysisSettings ofIndependentCells(AnalysisSettings settings)
{
    AnalysisSettings chain = ofTheChain(std::move(settings));
    chain.selection = {};
    chain.spectrogram = {};
    chain.noise = {};
    chain.family = {};
    chain.model = {};
    return chain;
}

} // namespace faintline

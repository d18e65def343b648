#include "evaluate/experiments/LineExperiment.h"

#include "base/Error.h"

#include <cmath>

namespace faintline {

const std::vector<Field<LineExperiment>> &LineExperiment::fields()
{
    using S = LineExperiment;
    static const std::vector<Field<S>> table{
        field(&S::seed, "seed", "", 0.0, 2147483647.0, "Seed of all random numbers."),
        field(&S::runs, "runs", "", 1.0, 1e7, "Number of fields to simulate; each contains one line per block."),
        field(&S::frames, "frames", "frames", 2.0, 1e5, "Length of a field."),
        field(&S::blockFrames, "blockFrames", "frames", 2.0, 1e5, "Length of a block."),
        field(&S::blockBins, "blockBins", "bins", 2.0, 1e5, "Width of a block."),
        field(&S::stepsPerWindow, "stepsPerWindow", "", 1.0, 16.0, "Frames per window, k_t."),
        field(&S::binsPerCell, "binsPerCell", "", 1.0, 16.0, "Bins per resolution cell, k_f."),
        field(&S::window, "window", windowShapeNames, "Shape of the window."),
        field(&S::snrDb, "snrDb", "dB", -60.0, 60.0, "Signal-to-noise ratios in a frame with a rectangular window.")
            .labelled("SNR"),
        field(&S::durationWindows, "durationWindows", "windows", 0.5, 1e5, "Duration of a line.").labelled("Duration"),
        field(&S::driftCellsPerWindow, "driftCellsPerWindow", "cells/window", -100.0, 100.0, "Steady drift of a line.")
            .labelled("Drift"),
        field(&S::wanderCells, "wanderCells", "cells", 0.0, 1000.0, "Standard deviation of a line's wander.")
            .labelled("Wander"),
        field(&S::wanderWindows, "wanderWindows", "windows", 0.01, 1e5, "Correlation time of the wander.")
            .labelled("Time of the wander"),
        field(&S::fading, "fading", fadingNames, "Whether the amplitude fades."),
        field(&S::fadingWindows, "fadingWindows", "windows", 0.01, 1e5, "Correlation time of the fading.")
            .labelled("Time of the fading"),
        field(&S::fluctuation, "fluctuation", fluctuationNames,
              "Fluctuation of a line's power about its mean: one power for the whole line (Swerling 1 and 3), or one "
              "for each window (2 and 4)."),
    };
    return table;
}

int LineExperiment::signalFrames() const
{
    return int(std::lround(durationWindows * stepsPerWindow));
}

void checkExperiment(const LineExperiment &experiment)
{
    checkFields(experiment, LineExperiment::fields());
    if (experiment.detectors.empty())
        throw Error("detectors", "must name at least one detector");
    if (experiment.snrDb.empty())
        throw Error("snrDb", "must hold at least one value");
    if (LineExperiment::windowSamples % experiment.stepsPerWindow != 0)
        throw fieldError("stepsPerWindow", std::to_string(experiment.stepsPerWindow),
                         "must divide 250, the samples of a window");
    if (experiment.blocksInTime() < 1 || experiment.blocksInFrequency() < 1)
        throw Error("blockFrames, blockBins", "a block must fit into the field of " + std::to_string(experiment.frames)
                                                  + " × " + std::to_string(experiment.bins()) + " cells");
    if (experiment.signalFrames() < 1 || experiment.signalFrames() > experiment.blockFrames)
        throw fieldError("durationWindows", formatNumber(experiment.durationWindows),
                         "a line must last 1 … blockFrames = " + std::to_string(experiment.blockFrames) + " frames");
    if (experiment.fluctuation != Fluctuation::None && experiment.fading != Fading::None)
        throw fieldError("fluctuation", std::string(fluctuationNames[std::size_t(experiment.fluctuation)]),
                         "is not possible with fading; use one of the two");
    const double room = double(experiment.blockBins) / experiment.binsPerCell - 4.0;
    if (std::abs(experiment.driftCellsPerWindow) * experiment.durationWindows + 4.0 * experiment.wanderCells > room)
        throw Error("driftCellsPerWindow, wanderCells", "a line must stay within its block of blockBins = "
                                                            + std::to_string(experiment.blockBins) + " bins");
    for (const DetectorUnderTest &detectorUnderTest : experiment.detectors) {
        checkSettings(detectorUnderTest.settings);
        checkHasNoFamily(detectorUnderTest.settings, "is not possible in this experiment");
        checkHasOneChannel(detectorUnderTest.settings, "is not possible in this experiment");
        checkSubtractsNothing(detectorUnderTest.settings, "is not possible in this experiment");
    }
}

std::vector<DetectorUnderTest> detectorsFromJson(const Json &json, const std::string &where)
{
    const auto list = json.find("detectors");
    if (list == json.end() || !list->is_array() || list->empty())
        throw Error(jsonName(where, "detectors"), "must be a list of {\"name\": …, \"settings\": {…}}");
    std::vector<DetectorUnderTest> detectorsUnderTest;
    for (std::size_t i = 0; i < list->size(); ++i) {
        const std::string name = jsonName(where, "detectors[" + std::to_string(i) + "]");
        const Json &entry = (*list)[i];
        checkKeys(entry, name, {"name", "settings", "whole"});
        if (!entry.contains("name") || !entry["name"].is_string())
            throw Error(jsonName(name, "name"), "must be a string");
        DetectorUnderTest detectorUnderTest{entry["name"].get<std::string>(), {}};
        if (entry.contains("settings"))
            detectorUnderTest.settings = settingsFromJson(entry["settings"].dump(), jsonName(name, "settings"));
        if (const auto whole = entry.find("whole"); whole != entry.end()) {
            if (!whole->is_boolean())
                throw Error(jsonName(name, "whole"), "must be true or false");
            detectorUnderTest.isWhole = whole->get<bool>();
        }
        detectorsUnderTest.push_back(std::move(detectorUnderTest));
    }
    return detectorsUnderTest;
}

Json toJson(const std::vector<DetectorUnderTest> &detectorsUnderTest)
{
    Json list = Json::array();
    for (const DetectorUnderTest &detectorUnderTest : detectorsUnderTest) {
        list.push_back(
            {{"name", detectorUnderTest.name}, {"settings", Json::parse(settingsToJson(detectorUnderTest.settings))}});
        if (detectorUnderTest.isWhole) // files of experiments without it stay as they were
            list.back()["whole"] = true;
    }
    return list;
}

LineExperiment lineExperimentFromJson(const Json &json, const std::string &where)
{
    LineExperiment experiment;
    readFields(json, LineExperiment::fields(), experiment, where, {"kind", "detectors"});
    experiment.detectors = detectorsFromJson(json, where);
    checkExperiment(experiment);
    return experiment;
}

Json toJson(const LineExperiment &experiment)
{
    Json whole{{"kind", "lines"}};
    whole.update(writeFields(experiment, LineExperiment::fields()));
    whole["detectors"] = toJson(experiment.detectors);
    return whole;
}

} // namespace faintline

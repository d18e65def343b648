#include "bindings/bind.h"

#include "bindings/Source.h"
#include "bindings/jsonFromPython.h"
#include "scene/ScanScene.h"
#include "scene/SimulatedPings.h"
#include "scene/SimulatedRecording.h"

namespace faintline::python {

namespace py = pybind11;

namespace {

    HeldFrames simulatedScans(const ScanScene &scene)
    {
        const Grid grid = scanGrid(scene);
        const std::vector<ScanCell> trajectory = scanTrajectory(scene);
        std::vector<float> values(std::size_t(grid.size() * scene.stages));
        const auto cells = std::size_t(grid.size());
        for (int stage = 0; stage < scene.stages; ++stage)
            readScan(scene, trajectory, 0, stage, std::span(values).subspan(std::size_t(stage) * cells, cells));
        const Axis time{"time", "s", 0.0, scene.secondsPerStage, scene.stages, false};
        return {std::make_shared<FrameArray>(time, grid, std::move(values)), scanTruth(scene, trajectory)};
    }

    template <class Scene>
    Scene withSeed(Scene scene, int seed)
    {
        if (seed >= 0)
            scene.seed = seed;
        return scene;
    }

    py::object simulated(const Json &scene, int seed)
    {
        if (scene.is_object() && scene.value("kind", Json()) == "scans")
            return py::cast(simulatedScans(withSeed(scanSceneFromJson(scene), seed)));
        if (isPingScene(scene)) {
            const auto pings = std::make_shared<SimulatedPings>(withSeed(pingSceneFromJson(scene), seed));
            return py::cast(HeldFrames{pings, toJson(pings->truth()), true});
        }
        const auto recording = std::make_shared<SimulatedRecording>(withSeed(lineSceneFromJson(scene), seed));
        return py::cast(HeldRecording{recording, toJson(recording->truth()), {}});
    }

} // namespace

py::object simulatedSource(const Json &scene, const std::string &where, int seed)
{
    try {
        return simulated(scene, seed);
    } catch (const Error &error) {
        throw Error(where.empty() ? error.where() : where + ": " + error.where(), error.why(), error.kind());
    }
}

void bindSimulate(py::module_ &module)
{
    module.def(
        "simulate",
        [](const py::object &scene, int seed) {
            std::string where = "scene";
            const Json json = jsonOrFile(scene, where);
            return simulatedSource(json, where, seed);
        },
        py::arg("scene"), py::kw_only(), py::arg("seed") = -1,
        R"(Simulates a recording of known lines in noise, pings with known targets, or a radar's scans, with the truth.

scene: a dict, or the path of a JSON file, such as {"kind": "lines", "sampleRateHz": 400, "durationSeconds": 60,
"lines": [{"snrDb": 3, "frequencyHz": 100, "driftHzPerSecond": 0.1}]}. Omitted keys have their defaults.
seed: replaces the scene's; 0 or more.

Returns a Recording (lines) or Frames (pings, scans), computed when they are read; .truth describes the signals. Raises
Error with the name of the key.)");
}

} // namespace faintline::python

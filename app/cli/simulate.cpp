#include "app/cli/commands.h"
#include "app/cli/inRange.h"
#include "app/cli/provenance.h"

#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "scene/ScanScene.h"
#include "scene/SimulatedPings.h"
#include "scene/SimulatedRecording.h"
#include "signal/formats/NumPy.h"
#include "signal/formats/gridFile.h"
#include "signal/formats/writeRecording.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace faintline::cli {

namespace {

    void simulateScans(ScanScene scene, int seed, const std::string &out, const std::string &truth,
                       const RunContext &context)
    {
        if (!out.ends_with(".npy"))
            throw Error(out, "must end in .npy: scans are frames, not samples");
        if (seed >= 0)
            scene.seed = seed;
        std::vector<Index> shape{scene.stages};
        for (const Axis &axis : scanGrid(scene).axes)
            shape.push_back(axis.count);
        const std::vector<ScanCell> trajectory = scanTrajectory(scene);
        std::vector<float> y(std::size_t(scanGrid(scene).size()));
        NumPyWriter writer(out, shape);
        for (Index stage = 0; stage < scene.stages; ++stage) {
            context.checkpoint(double(stage) / scene.stages, "simulating");
            readScan(scene, trajectory, 0, stage, y);
            writer.write(y);
        }
        context.checkpoint(1.0, "done");
        writer.finish();
        if (!truth.empty())
            writeTextFile(truth, scanTruth(scene, trajectory).dump(2) + "\n");
    }

    /// Frames of shape (pings, ranges, beams …), and the grid they lie on beside them: NAME.npy, NAME.grid.json.
    void simulatePings(PingScene scene, int seed, const std::string &out, const std::string &truth,
                       const RunContext &context)
    {
        if (!out.ends_with(".npy"))
            throw Error(out, "must end in .npy: pings are written as frames");
        if (seed >= 0)
            scene.seed = seed;
        const SimulatedPings pings(scene);
        std::vector<Index> shape{pings.time().count};
        for (const Axis &axis : pings.grid().axes)
            shape.push_back(axis.count);
        NumPyWriter writer(out, shape);
        std::vector<float> y(std::size_t(pings.grid().size()));
        for (Index ping = 0; ping < pings.time().count; ++ping) {
            context.checkpoint(double(ping) / double(pings.time().count), "simulating pings");
            pings.read(ping, 1, y);
            writer.write(y);
        }
        writeTextFile(out.substr(0, out.size() - 4) + ".grid.json", gridFileText({pings.grid(), pings.time()}));
        if (!truth.empty())
            writeTextFile(truth, toJson(pings.truth()).dump(2) + "\n");
        writer.finish();
    }

    struct SimulateOptions {
        std::string scene;
        std::string out;
        std::string truth;
        int seed = -1;
        std::string type = "float32";
    };

    void simulate(const SimulateOptions &options, const Common &common)
    {
        const Json json = readJsonFile(options.scene);
        if (json.is_object() && json.value("kind", Json()) == "scans") {
            simulateScans(inFile(options.scene, [&] { return scanSceneFromJson(json); }), options.seed, options.out,
                          options.truth, common.context());
            return;
        }
        if (isPingScene(json)) {
            simulatePings(inFile(options.scene, [&] { return pingSceneFromJson(json); }), options.seed, options.out,
                          options.truth, common.context());
            return;
        }
        LineScene scene = inFile(options.scene, [&] { return lineSceneFromJson(json); });
        if (options.seed >= 0)
            scene.seed = options.seed;
        const SimulatedRecording recording(scene);
        writeRecording(recording, options.out, options.type == "int16" ? WrittenType::Int16 : WrittenType::Float32,
                       common.context());
        if (!options.truth.empty())
            writeTextFile(options.truth, toJson(recording.truth()).dump(2) + "\n");
    }

} // namespace

void addSimulate(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<SimulateOptions>();
    CLI::App *command =
        app.add_subcommand("simulate", "Simulate a recording of known lines in noise, or pings with known targets, and "
                                       "write its truth");
    addInput(*command, common, "SCENARIO", options->scene, "Scene, JSON")->required();
    addOutput(*command, common, "--out", options->out,
              "Recording to write: .wav, .flac, .w64 …, .sigmf-meta; .npy for "
              "sonar pings or radar scans")
        ->required();
    addOutput(*command, common, "--truth", options->truth, "Write the truth, .json");
    command->add_option("--seed", options->seed, "Seed in place of the scene's")->check(inRange(0, 2147483647));
    command->add_option("--type", options->type, "Sample type")
        ->check(CLI::IsMember({"float32", "int16"}))
        ->capture_default_str();
    command->callback([options, &common] {
        checkOutputs({options->out, options->truth});
        CommitTogether files;
        writeProvenance(common, {options->scene}, {options->out, options->truth});
        simulate(*options, common);
        files.commit();
    });
}

} // namespace faintline::cli

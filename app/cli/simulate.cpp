#include "app/cli/commands.h"

#include "base/AtomicFile.h"
#include "base/json.h"
#include "exchange/ModelFile.h"
#include "exchange/NumPy.h"
#include "recording/SimulatedRecording.h"
#include "recording/writeRecording.h"
#include "spectrum/SimulatedPings.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace faintline::cli {

namespace {

    /// Frames of shape (pings, ranges, beams), and the grid they lie on beside them: NAME.npy, NAME.grid.json.
    void simulatePings(const std::string &sceneFile, const std::string &out, const std::string &truth, int seed, const RunContext &context)
    {
        if (!out.ends_with(".npy"))
            throw Error(out, "pings are written as frames: give a name that ends in .npy");
        PingScene scene = pingSceneFromJson(readJsonFile(sceneFile));
        if (seed >= 0)
            scene.seed = seed;
        const SimulatedPings pings(scene);
        NumPyWriter writer(out, {pings.time().count, pings.grid().axes[0].count, pings.grid().axes[1].count});
        std::vector<float> y(static_cast<std::size_t>(pings.grid().size()));
        for (Index ping = 0; ping < pings.time().count; ++ping) {
            context.checkpoint(static_cast<double>(ping) / static_cast<double>(pings.time().count), "simulating pings");
            pings.read(ping, 1, y);
            writer.write(y);
        }
        writeTextFile(out.substr(0, out.size() - 4) + ".grid.json", gridFileText({pings.grid(), pings.time()}));
        if (!truth.empty())
            writeTextFile(truth, toJson(pings.truth()).dump(2) + "\n");
        writer.finish();
    }

} // namespace

void addSimulate(CLI::App &app, Common &common)
{
    struct Options {
        std::string scene;
        std::string out;
        std::string truth;
        int seed = -1;
        std::string type = "float32";
    };
    const auto options = std::make_shared<Options>();
    CLI::App *command =
        app.add_subcommand("simulate", "Make a recording of known lines in noise, or pings with known targets, and its truth");
    command->add_option("SCENARIO", options->scene, "The scene, JSON")->required();
    command->add_option("--out", options->out, "Recording to write: .wav, .flac, .w64 …, .sigmf-meta; frames of pings: .npy")->required();
    command->add_option("--truth", options->truth, "Write the truth, .json");
    command->add_option("--seed", options->seed, "Seed in place of the scene's own")->check(CLI::Range(0, 2147483647));
    command->add_option("--type", options->type, "Sample type")->check(CLI::IsMember({"float32", "int16"}))->capture_default_str();
    command->callback([options, &common] {
        if (isPingScene(readJsonFile(options->scene))) {
            simulatePings(options->scene, options->out, options->truth, options->seed, common.context());
            return;
        }
        LineScene scene = lineSceneFromJson(readJsonFile(options->scene));
        if (options->seed >= 0)
            scene.seed = options->seed;
        const SimulatedRecording recording(scene);
        writeRecording(recording, options->out, options->type == "int16" ? WrittenType::Int16 : WrittenType::Float32, common.context());
        if (!options->truth.empty())
            writeTextFile(options->truth, toJson(recording.truth()).dump(2) + "\n");
    });
}

} // namespace faintline::cli

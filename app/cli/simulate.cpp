#include "app/cli/commands.h"

#include "base/AtomicFile.h"
#include "base/json.h"
#include "recording/SimulatedRecording.h"
#include "recording/writeRecording.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace faintline::cli {

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
    CLI::App *command = app.add_subcommand("simulate", "Make a recording of known lines in noise, and its truth");
    command->add_option("SCENARIO", options->scene, "The scene, JSON")->required();
    command->add_option("--out", options->out, "Recording to write: .wav, .flac, .w64 …, .sigmf-meta")->required();
    command->add_option("--truth", options->truth, "Write the truth, .json");
    command->add_option("--seed", options->seed, "Seed in place of the scene's own")->check(CLI::Range(0, 2147483647));
    command->add_option("--type", options->type, "Sample type")->check(CLI::IsMember({"float32", "int16"}))->capture_default_str();
    command->callback([options, &common] {
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

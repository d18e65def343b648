#include "app/cli/commands.h"
#include "app/cli/inRange.h"
#include "app/cli/provenance.h"

#include "base/files/AtomicFile.h"
#include "evaluate/experiments/scaledInjection.h"
#include "signal/formats/writeRecording.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <vector>

namespace faintline::cli {

namespace {

    struct InjectOptions {
        AnalysisOptions analysis;
        LineSettings line;
        std::string fading = "none";
        std::string fluctuation = "none";
        std::string out;
        std::string truth;
        std::string type = "float32";
        int seed = 1;
    };

    Fluctuation fluctuationNamed(const std::string &name)
    {
        return static_cast<Fluctuation>(std::ranges::find(fluctuationNames, name) - fluctuationNames.begin());
    }

    void inject(const InjectOptions &options, const Common &common)
    {
        LineSettings line = options.line;
        if (!(line.referenceSeconds >= 0.0))
            throw Error("--reference " + formatNumber(line.referenceSeconds), "must be above 0 s");
        checkOutputs({options.out, options.truth});
        const RecordingPointer recording = options.analysis.recording();
        const AnalysisSettings settings = options.analysis.settings();
        line.fading = options.fading == "rayleigh" ? Fading::Rayleigh : Fading::None;
        line.fluctuation = fluctuationNamed(options.fluctuation);
        const InjectedLine injected = scaledInjection(line, recording, settings, common.context().part(0.0, 0.3));
        const InjectedRecording made(recording, {injected}, settings.selection.channel, std::uint64_t(options.seed));
        CommitTogether files;
        writeProvenance(common, options.analysis.inputs(), {options.out, options.truth});
        writeRecording(made, options.out, options.type == "int16" ? WrittenType::Int16 : WrittenType::Float32,
                       common.context().part(0.3, 1.0));
        if (!options.truth.empty())
            writeTextFile(options.truth, toJson(made.truth()).dump(2) + "\n");
        files.commit();
    }

} // namespace

void addInject(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<InjectOptions>();
    options->line.referenceSeconds = 0.0;
    LineSettings &line = options->line;
    CLI::App *command = app.add_subcommand("inject", "Add a known line to a recording");
    options->analysis.addTo(*command, common);
    command
        ->add_option("--snr", line.snrDb, "SNR over the noise around the line, dB in a window of --reference seconds")
        ->required();
    command->add_option("--reference", line.referenceSeconds,
                        "Window to which the SNR refers, s; by default the "
                        "spectrogram's");
    command->add_option("--start", line.startSeconds, "Start, s")->capture_default_str();
    command->add_option("--duration", line.durationSeconds, "Duration, s; 0: to the end of the recording")
        ->capture_default_str();
    command->add_option("--frequency", line.frequencyHz, "Frequency at the start, Hz")->required();
    command->add_option("--drift", line.driftHzPerSecond, "Drift, Hz/s")->capture_default_str();
    command->add_option("--wander", line.wanderHz, "Standard deviation of the wander, Hz")->capture_default_str();
    command->add_option("--wander-time", line.wanderSeconds, "Correlation time of the wander, s")
        ->capture_default_str();
    command->add_option("--fading", options->fading, "Fading")
        ->check(CLI::IsMember({"none", "rayleigh"}))
        ->capture_default_str();
    command->add_option("--fading-time", line.fadingSeconds, "Correlation time of the fading, s")
        ->capture_default_str();
    command->add_option("--fluctuation", options->fluctuation, "Fluctuation of the power about its mean")
        ->check(CLI::IsMember(std::vector<std::string>(fluctuationNames.begin(), fluctuationNames.end())))
        ->capture_default_str();
    command->add_option("--seed", options->seed, "Seed of phase, wander, fading and fluctuation")
        ->check(inRange(0, 2147483647))
        ->capture_default_str();
    command->add_option("--type", options->type, "Sample type")
        ->check(CLI::IsMember({"float32", "int16"}))
        ->capture_default_str();
    addOutput(*command, common, "--out", options->out, "Recording to write")->required();
    addOutput(*command, common, "--truth", options->truth, "Write the truth, .json");
    command->callback([options, &common] { inject(*options, common); });
}

} // namespace faintline::cli

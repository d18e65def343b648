#include "app/cli/commands.h"

#include "analyse/preparePlan.h"
#include "base/RunContext.h"
#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "detect/Sprt.h"
#include "detect/averagedStages.h"
#include "exchange/ModelFile.h"
#include "noise/openFrames.h"
#include "plan/lineSequentialModel.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <memory>

namespace faintline::cli {

namespace {

    struct SequentialOptions {
        AnalysisOptions analysis;
        std::string frames;
        std::string model;
        SprtSettings sprt;
        Index averagedCells = 0;
        Index every = 0; ///< frames from one that counts to the next; 0: as the windows overlap
        std::string out;
    };

    /// What the test is run on: a model, and the stages it may take.
    struct Stages {
        SequentialModel model;
        Index count = 0;
        StageSource source;
    };

    Stages readyMade(const SequentialOptions &options)
    {
        Stages stages;
        auto frames = std::make_shared<const DoubleFrames>(readDoubleFrames(options.frames));
        const FrameCells cells{options.frames, {frames->shape.begin() + 1, frames->shape.end()}};
        stages.model = readSequentialModel(options.model, &cells);
        stages.count = frames->shape.front();
        stages.source = [frames](Index stage, std::span<double> y) {
            std::copy_n(frames->values.begin() + stage * std::ssize(y), std::ssize(y), y.begin());
        };
        return stages;
    }

    /// A recording's selection: the line model of the settings, or a model of its bins.
    Stages recorded(const SequentialOptions &options, const RunContext &context)
    {
        const AnalysisSettings settings = options.analysis.settings();
        const auto spectrogram =
            std::make_shared<const Spectrogram>(options.analysis.recording(), settings.spectrogram, settings.selection);
        AnalysisPlan plan;
        plan.settings = settings;
        normalisePlan(plan, spectrogram, context);
        const NormalisedFramesPointer frames = plan.frames;
        const Index bins = frames->grid().size();
        Stages stages;
        if (options.model.empty()) {
            stages.model = lineSequentialModel(settings.model, frames->grid(), *frames);
        } else {
            const FrameCells cells{options.analysis.file, {bins}};
            stages.model = readSequentialModel(options.model, &cells);
            checkLikelihoodRatio(stages.model.markov.likelihood, options.model + ": likelihood.kind");
        }
        stages.model.observedEvery = framesApart(*frames);
        stages.count = frames->time().count;
        stages.source = stagesOf(frames, 0, 0, bins);
        return stages;
    }

    Json toJson(const SprtResult &result, const SprtSettings &settings, Index observedEvery)
    {
        const SprtBoundaries boundaries = sprtBoundaries(settings);
        Json json;
        json["decision"] = sprtDecisionNames[std::size_t(result.decision)];
        json["stop"] = result.stages;
        json["forced"] = result.isForced;
        json["observedEvery"] = observedEvery;
        json["lnGamma0"] = boundaries.lnLower;
        json["lnGamma1"] = boundaries.lnUpper;
        json["lnLambda"] = result.lnLambda;
        json["map"] = result.trajectory;
        json["lnMapScore"] = result.decision == SprtDecision::H1 ? Json(result.lnMapScore) : Json();
        return json;
    }

    void sequential(const SequentialOptions &options, const Common &common)
    {
        checkSprt(options.sprt, "sequential");
        checkOutputs({options.out});
        if (options.frames.empty() == options.analysis.file.empty())
            throw Error("sequential", "accepts either a recording or --frames with ready-made frames");
        if (!options.frames.empty() && options.model.empty())
            throw Error("sequential", "needs --model for ready-made frames");
        const RunContext context = common.context();
        Stages stages = options.frames.empty() ? recorded(options, context.part(0.0, 0.3)) : readyMade(options);
        if (options.averagedCells != 0)
            stages.source = averagedStages(std::move(stages.source), stages.model, options.averagedCells, "--average");
        if (options.every < 0)
            throw Error("--every " + std::to_string(options.every), "must be at least 1");
        if (options.every > 0)
            stages.model.observedEvery = options.every;
        const SprtResult result =
            runSprt(stages.model, options.sprt, stages.count, stages.source, context.part(0.3, 1.0));
        context.checkpoint(1.0, "done");
        writeTextFile(options.out, toJson(result, options.sprt, stages.model.observedEvery).dump(2) + "\n");
    }

} // namespace

void addSequential(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<SequentialOptions>();
    CLI::App *command =
        app.add_subcommand("sequential", "Test stage by stage for a signal present since the first stage, and locate "
                                         "it; \"no signal\" is final and does not cover signals that start later");
    options->analysis.addTo(*command, common);
    command->get_option("FILE")->required(false);
    addInput(*command, common, "--frames", options->frames,
             "Ready-made normalised frames, .npy of shape (stages, cells…), noise mean 1");
    addInput(*command, common, "--model", options->model,
             "JSON of the model; by default the line model of the settings");
    command->add_option("--alpha", options->sprt.falseAlarm, "Specified probability of accepting a signal on noise")
        ->capture_default_str();
    command->add_option("--beta", options->sprt.miss, "Specified probability of accepting noise with a signal")
        ->capture_default_str();
    command->add_option("--cutoff", options->sprt.cutOffStage, "Stage at which a decision is forced; 0: never")
        ->capture_default_str();
    command
        ->add_option("--average", options->averagedCells,
                     "Number of cells around each cell, along the model's last axis, whose mean estimates the noise "
                     "power; 0: noise has mean 1")
        ->capture_default_str();
    command
        ->add_option("--every", options->every,
                     "Use every n-th frame, because stages must be independent and overlapping windows share "
                     "samples; 0: the number of steps per window for a recording, 1 for ready-made frames")
        ->capture_default_str();
    addOutput(*command, common, "--out", options->out, "Write decision, ln Λ of every stage and trajectory, .json")
        ->required();
    command->callback([options, &common] { sequential(*options, common); });
}

} // namespace faintline::cli

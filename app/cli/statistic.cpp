#include "app/cli/commands.h"

#include "base/files/AtomicFile.h"
#include "exchange/ModelFile.h"
#include "noise/openFrames.h"
#include "signal/formats/NumPy.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace faintline::cli {

namespace {

    struct StatisticOptions {
        std::string frames;
        std::string model;
        std::string out;
        std::string projected;
        std::string log;
        std::vector<std::string> assignments; ///< --set pings.name=value
    };

    /// How recorded pings are normalised; the model says everything else.
    PingNoiseSettings pingsOf(const std::vector<std::string> &assignments)
    {
        AnalysisSettings settings;
        for (const std::string &assignment : assignments) {
            const std::size_t equals = assignment.find('=');
            if (equals == std::string::npos || !assignment.starts_with("pings."))
                throw Error("--set " + assignment, "must be a setting of pings, such as pings.values=magnitude");
            setSetting(settings, assignment.substr(0, equals), assignment.substr(equals + 1));
        }
        checkSettings(settings);
        return settings.pings;
    }

    /// The frames, with the axes of the grid beside the file only if it says what their numbers are.
    NormalisedFramesPointer framesOf(const StatisticOptions &options, const Common &common)
    {
        const PingNoiseSettings pings = pingsOf(options.assignments);
        auto frames =
            openPings(options.frames, gridBeside(options.frames), pings, UnstatedPings::Normalised, common.context());
        if (!frames)
            return readFrames(options.frames, "");
        tellGuess(*frames, options.frames, common);
        return frames;
    }

    void statistic(const StatisticOptions &options, const Common &common)
    {
        checkOutputs({options.out, options.projected, options.log});
        const NormalisedFramesPointer frames = framesOf(options, common);
        const ModelFile file = readModelFile(options.model);
        const StateSpace &space = file.model.space;
        const std::vector<Axis> &axes = frames->grid().axes;
        const auto isAlike = [](const KinematicAxis &own, const Axis &axis) { return own.cells == axis.count; };
        if (!std::equal(space.axes().begin(), space.axes().end(), axes.begin(), axes.end(), isAlike))
            throw Error(options.model, "the cells of its axes do not match the frames of " + options.frames);
        std::vector<Index> shape{frames->time().count};
        std::vector<Index> projectedShape = shape;
        for (const KinematicAxis &axis : space.axes())
            shape.push_back(axis.rateCount);
        for (const KinematicAxis &axis : space.axes()) {
            shape.push_back(axis.cells);
            projectedShape.push_back(axis.cells);
        }
        const std::unique_ptr<PathDetector> detector = makePathDetector(file);
        NumPyWriter out(options.out, shape);
        std::optional<NumPyWriter> projected;
        if (!options.projected.empty())
            projected.emplace(options.projected, projectedShape);
        std::string log = "frame,lnK,reset_fraction,max_statistic\n";
        const RunContext context = common.context();
        std::vector<float> y(std::size_t(space.cellCount()));
        std::vector<float> D(y.size());
        std::vector<float> scores;
        for (Index frame = 0; frame < frames->time().count; ++frame) {
            context.checkpoint(double(frame) / double(frames->time().count), "recursion");
            frames->read(frame, 1, y);
            detector->update(y, D);
            scores.assign(detector->scores().begin(), detector->scores().end());
            if (const auto offset = float(detector->offset()); offset != 0.0f)
                for (float &score : scores)
                    score += offset;
            out.write(scores);
            if (projected)
                projected->write(D);
            const PathDetector::Regulation regulation = detector->regulation();
            log += std::to_string(frame) + "," + formatNumber(regulation.lnK) + ","
                   + formatNumber(1.0 - regulation.continuedFraction) + ","
                   + formatNumber(double(*std::max_element(D.begin(), D.end()))) + "\n";
        }
        if (!options.log.empty())
            writeTextFile(options.log, log);
        out.finish();
        if (projected)
            projected->finish();
    }

} // namespace

void addStatistic(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<StatisticOptions>();
    CLI::App *command = app.add_subcommand("statistic", "Compute ln Λ of the recursion for every frame and state, "
                                                        "without decisions");
    addInput(*command, common, "--frames", options->frames,
             "Normalised frames, .npy of shape (frames, cells…), or recorded pings, which are normalised")
        ->required();
    command->add_option("--set", options->assignments, "A setting of recorded pings, pings.name=value; may be repeated")
        ->take_all()
        ->allow_extra_args(false);
    addInput(*command, common, "--model", options->model, "JSON of the model")->required();
    addOutput(*command, common, "--out", options->out, "Write the statistic of all states, .npy")->required();
    addOutput(*command, common, "--projected", options->projected, "Write its maximum over the rates, .npy");
    addOutput(*command, common, "--log", options->log, "Write K and reset fraction per frame, .csv");
    command->callback([options, &common] { statistic(*options, common); });
}

} // namespace faintline::cli

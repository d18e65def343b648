#include "app/cli/commands.h"
#include "app/cli/printSummary.h"

#include "analyse/analyse.h"
#include "base/json.h"
#include "base/logmath.h"
#include "base/oneLine.h"
#include "inspect/advice.h"
#include "inspect/explain.h"
#include "inspect/familyTeeth.h"
#include "noise/openFrames.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

namespace faintline::cli {

namespace {

    constexpr const char *resetNames[]{"beginning", "background", "forgotten"};

    /// What is held against the threshold: the path's score, or the statistic of a detector that has no paths, in its
    /// own unit.
    double decidedBy(const Explanation &explanation, const Analysis &analysis)
    {
        return isScoreOfPaths(analysis.settings.detector) ? explanation.statistic : explanation.displayed;
    }

    Json toJson(const PathStep &step, const Explanation &explanation, const Analysis &analysis)
    {
        const std::size_t model = explanation.modelAt(step.frame);
        const StateSpace &space = analysis.modelAt(model).space;
        const std::vector<Index> c = analysis.grid().coordinates(space.cellOf(step.state));
        std::vector<double> at;
        for (std::size_t axis = 0; axis < c.size(); ++axis)
            at.push_back(analysis.grid().axes[axis].value(double(c[axis])));
        Json json = {{"t", analysis.time().value(double(step.frame))},
                     {"position", at},
                     {"rates", space.ratesOfPlane(space.planeOf(step.state))},
                     {"llr", step.logLikelihoodRatio},
                     {"ln_transition", step.lnTransition},
                     {"lnK", step.lnK},
                     {"sum", step.score}};
        if (std::isfinite(step.runnerUp))
            json["runner_up_margin"] = step.runnerUp;
        if (!explanation.modelChanges.empty())
            json["model"] = nameOfBankModel(model);
        return json;
    }

    Json toJson(const Explanation &explanation, const Analysis &analysis)
    {
        const std::size_t model = explanation.modelAt(explanation.steps.back().frame);
        const StateSpace &space = analysis.modelAt(model).space;
        Json json;
        json["time"] = explanation.seconds;
        json["position"] = explanation.position;
        json["statistic"] = explanation.statistic;
        json["displayed"] = explanation.displayed;
        json["threshold"] = explanation.threshold;
        json["unit"] = std::string(statisticUnit(analysis.settings.detector));
        json["margin"] = decidedBy(explanation, analysis) - explanation.threshold;
        json["tracked"] = explanation.isTracked;
        json["explained_by_noise"] = explanation.isExplainedByNoise;
        json["offset"] = explanation.offset;
        if (explanation.otherWindowTrack)
            json["found_by_window"] = {{"track", *explanation.otherWindowTrack},
                                       {"window_s", explanation.otherWindowSeconds}};
        json["reset"]["cause"] = resetNames[std::size_t(explanation.reset.kind)];
        json["reset"]["lost"] = explanation.reset.lost;
        if (explanation.reset.track > 0)
            json["reset"]["track"] = explanation.reset.track;
        if (explanation.otherState && std::isfinite(explanation.otherMargin))
            json["runner_up"] = {{"rates", space.ratesOfPlane(space.planeOf(*explanation.otherState))},
                                 {"margin", explanation.otherMargin}};
        if (analysis.isBank())
            json["model"] = nameOfBankModel(model);
        json["steps"] = Json::array();
        for (const PathStep &step : explanation.steps)
            json["steps"].push_back(toJson(step, explanation, analysis));
        return json;
    }

    void printHeading(const Grid &grid)
    {
        if (grid.isSpectrum()) {
            std::printf("%12s %14s %8s %10s %10s %10s %12s\n", "t (s)", "f", "rate", "llr", "ln P", "ln K", "sum");
            return;
        }
        std::printf("%12s", "t (s)");
        for (const Axis &axis : grid.axes)
            std::printf(" %14s %8s",
                        oneLine(axis.unit.empty() ? axis.name : axis.name + " (" + axis.unit + ")").c_str(), "rate");
        std::printf(" %10s %10s %10s %12s\n", "llr", "ln P", "ln K", "sum");
    }

    void printSteps(const Json &steps, const Analysis &analysis)
    {
        for (const Json &step : steps) {
            std::printf("%12s", secondsOf(step["t"].get<double>(), analysis.time()).c_str());
            for (std::size_t axis = 0; axis < step["position"].size(); ++axis)
                std::printf(" %14s %8d",
                            positionText(step["position"][axis].get<double>(), analysis.grid().axes[axis]).c_str(),
                            step["rates"][axis].get<int>());
            std::printf(" %10.4f %10.4f %10.4f %12.4f\n", step["llr"].get<double>(),
                        step["ln_transition"].get<double>(), step["lnK"].get<double>(), step["sum"].get<double>());
        }
    }

    void print(const Explanation &explanation, const Analysis &analysis)
    {
        const double decided = decidedBy(explanation, analysis);
        const std::string unit(statisticUnit(analysis.settings.detector));
        std::printf("statistic %.4f %s, threshold %.4f %s: %s by %.4f %s%s\n", decided, unit.c_str(),
                    explanation.threshold, unit.c_str(), decided > explanation.threshold ? "above" : "below",
                    std::abs(decided - explanation.threshold), unit.c_str(),
                    explanation.isTracked ? ", followed by a tracker" : "");
        if (!isScoreOfPaths(analysis.settings.detector))
            std::printf(
                "a sequential Markov detector guides its tracks; the path of that detector has %.4f nat here:\n",
                explanation.statistic);
        if (explanation.otherWindowTrack)
            std::printf("track %d passes here; a window of %s s found it\n", *explanation.otherWindowTrack,
                        formatNumber(explanation.otherWindowSeconds).c_str());
        if (explanation.isSubtracted)
            std::printf("a line was subtracted here; the path is that of the remainder\n");
        if (explanation.isExplainedByNoise)
            std::printf("its path is not reported: cells this strong, or runs of them, are common in this "
                        "recording's noise\n");
        std::printf("the best path began %zu frame(s) ago, when it was reset\n", explanation.steps.size() - 1);
        for (const ModelChange &change : explanation.modelChanges)
            std::printf("from %s s on, the track belongs to the %s model\n",
                        secondsOf(analysis.time().value(double(change.frame)), analysis.time()).c_str(),
                        nameOfBankModel(change.model).c_str());
        printHeading(analysis.grid());
        printSteps(toJson(explanation, analysis)["steps"], analysis);
        if (explanation.offset != 0.0)
            std::printf("and %.4f nat common to all states: K of the frame and the offset of the model\n",
                        explanation.offset);
    }

    /// evidence is null where a member was never observed, power_db where its power is 0.
    Json toJson(const std::vector<FamilyTooth> &teeth)
    {
        Json members = Json::array();
        for (const FamilyTooth &tooth : teeth) {
            members.push_back({{"member", tooth.member},
                               {"frequency", tooth.hz},
                               {"frames", tooth.frames},
                               {"power_db", tooth.meanPower > 0.0 ? Json(dbFromRatio(tooth.meanPower)) : Json()},
                               {"evidence", tooth.frames > 0 ? Json(tooth.evidence) : Json()}});
            if (tooth.channel >= 0)
                members.back()["channel"] = tooth.channel;
        }
        return members;
    }

    void print(const std::vector<FamilyTooth> &teeth, const Analysis &analysis)
    {
        const FamilySettings &family = analysis.settings.family;
        const bool areHarmonics = family.relation == FamilySettings::Relation::Harmonics;
        std::printf("%s along the path: mean power over noise, and the evidence that would be lost without it\n",
                    family.isNone() ? "channels" : "members");
        const bool haveChannels = teeth.front().channel >= 0;
        std::printf("%12s %14s %s%10s %10s\n", areHarmonics ? "multiple" : "offset (Hz)", "f",
                    haveChannels ? " channel " : "", "dB", "nat");
        for (const FamilyTooth &tooth : teeth) {
            std::printf("%12.6g %14s", tooth.member, positionText(tooth.hz, analysis.grid().axes.back()).c_str());
            if (haveChannels)
                std::printf(" %7d ", tooth.channel);
            if (tooth.frames == 0)
                std::printf(" %10s %10s  outside the band\n", "-", "-");
            else
                std::printf(" %10.2f %10.4f%s\n", dbFromRatio(tooth.meanPower), tooth.evidence,
                            tooth.isSeen() ? "" : "  not seen: there is more evidence without it");
        }
    }

    struct ExplainOptions {
        AnalysisOptions analysis;
        double seconds = 0.0;
        std::optional<double> hz;
        std::optional<double> range;
        std::optional<double> bearing;
        std::string grid;
        bool json = false;

        std::vector<double> position(const NormalisedFrames *frames) const;
    };

    /// Along the axes of the frames, or of a recording where there are none.
    std::vector<double> ExplainOptions::position(const NormalisedFrames *frames) const
    {
        if (frames && !frames->grid().isSpectrum()) {
            if (!range || !bearing)
                throw Error("explain", "a cell of pings requires --range and --bearing");
            return {*range, *bearing};
        }
        if (!hz)
            throw Error("explain", "needs --frequency; for pings, give --range and --bearing");
        return {*hz};
    }

    void explainCell(const ExplainOptions &options, const Common &common)
    {
        const RunContext context = common.context();
        const AnalysisSettings settings = options.analysis.settings();
        const OpenedSource opened = options.grid.empty()
                                        ? options.analysis.opened(settings, context)
                                        : openStack(options.analysis.file, options.grid, settings.pings, context);
        const std::vector<double> position = options.position(opened.frames.get());
        const auto analysis = analyse(opened, settings, {}, context.part(0.0, 0.5));
        const Explanation explanation = explain(*analysis, options.seconds, position, context.part(0.5, 0.9));
        const std::vector<FamilyTooth> teeth = familyTeeth(*analysis, explanation, context.part(0.9, 0.95));
        const auto advice = adviceOnCell(*analysis, explanation, context.part(0.95, 1.0));
        if (options.json) {
            Json json = toJson(explanation, *analysis);
            if (!teeth.empty())
                json["members"] = toJson(teeth);
            if (advice)
                json["advice"] = {{"name", advice->name}, {"sentence", advice->sentence}, {"remedy", advice->remedy}};
            std::printf("%s\n", json.dump(2, ' ', true).c_str());
            return;
        }
        print(explanation, *analysis);
        if (!teeth.empty())
            print(teeth, *analysis);
        if (advice)
            std::printf("%s: %s\n", advice->sentence.c_str(), advice->remedy.c_str());
    }

} // namespace

void addExplain(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<ExplainOptions>();
    CLI::App *command = app.add_subcommand("explain", "Explain the statistic of a cell by the terms of the best path "
                                                      "that ends there");
    options->analysis.addTo(*command, common);
    command->add_option("--time", options->seconds, "Time, s")->required();
    command->add_option("--frequency", options->hz, "Frequency, Hz");
    command->add_option("--range", options->range, "For pings: range, in the unit of its axis");
    command->add_option("--bearing", options->bearing, "For pings: bearing, degrees");
    addInput(*command, common, "--grid", options->grid,
             "For a stack of frames (FILE.npy): JSON that describes its axes");
    command->add_flag("--json", options->json, "Print as JSON");
    command->callback([options, &common] { explainCell(*options, common); });
}

} // namespace faintline::cli

#include "app/cli/commands.h"
#include "app/cli/inRange.h"
#include "app/cli/provenance.h"

#include "base/Error.h"
#include "base/files/AtomicFile.h"
#include "base/files/fileName.h"
#include "base/json.h"
#include "base/oneLine.h"
#include "evaluate/experiments/SweepTrials.h"
#include "evaluate/experiments/campaignCharts.h"
#include "exchange/CampaignFile.h"
#include "exchange/writeChart.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>

namespace faintline::cli {

namespace {

    Campaign mergedFiles(std::span<const std::string> paths)
    {
        std::vector<Campaign> parts;
        for (const std::string &path : paths)
            parts.push_back(readCampaign(path));
        return merge(std::move(parts));
    }

    void printSweep(const Campaign &campaign)
    {
        std::printf("%-28s %8s   %-17s %8s   %12s   %-21s %10s\n", campaign.experiment.parameter.c_str(), "Pd",
                    "95 % interval", "trials", "false alarms/h", "95 % interval", "latency (s)");
        for (const SweepPoint &point : sweepCurve(campaign))
            std::printf("%-28s %8.4f   %.4f … %.4f   %8lld   %14.4g   %9.4g … %-9.4g %11s\n",
                        formatNumber(point.value).c_str(), point.pd, point.pdInterval.low, point.pdInterval.high,
                        static_cast<long long>(point.trials), point.falseAlarmsPerHour, point.falseAlarmInterval.low,
                        point.falseAlarmInterval.high,
                        point.detections > 0 ? formatNumber(std::round(100.0 * point.latencySeconds) / 100.0).c_str()
                                             : "never");
    }

    void printCosts(const Experiment &sweep, const RunContext &context)
    {
        const SweepTrials trials(sweep, openRecordingOf(sweep), context);
        const std::vector<double> seconds = trials.costs(context);
        std::printf("processor time per hour of recording\n");
        for (std::size_t i = 0; i < seconds.size(); ++i)
            std::printf("%-28s %8.3g s\n", formatNumber(sweep.values[i]).c_str(), seconds[i]);
    }

    void print(const Campaign &campaign)
    {
        if (campaign.experiment.isSweep())
            return printSweep(campaign);
        std::printf("%-28s %8s %8s   %-17s %8s\n", "detector", "SNR (dB)", "Pd", "95 % interval", "trials");
        for (const CurvePoint &point : pdCurve(campaign))
            std::printf("%-28s %8s %8.4f   %.4f … %.4f   %8lld\n", oneLine(point.detector).c_str(),
                        formatNumber(point.snrDb).c_str(), point.pd, point.interval.low, point.interval.high,
                        static_cast<long long>(point.trials));
    }

    struct EvaluateOptions {
        std::vector<std::string> files;
        std::string out;
        std::string chart;
        std::string roc;
        std::optional<double> rocSnrDb;
        std::string shard;
        int seed = -1;
        bool cost = false;
    };

    /// The experiment's SNR at which the ROC is drawn: the given one, else the middle one.
    std::size_t rocSnr(const Experiment &experiment, const EvaluateOptions &options)
    {
        if (experiment.isSweep() && options.roc.ends_with(".csv"))
            throw Error(options.roc, "must end in .svg for a sweep, whose false alarms are columns of --out");
        const std::vector<double> &snrs = experiment.snrDb;
        if (!options.rocSnrDb)
            return snrs.size() / 2;
        const auto found = std::ranges::find(snrs, *options.rocSnrDb);
        if (found == snrs.end())
            throw Error("--roc-snr", formatNumber(*options.rocSnrDb)
                                         + " dB is not one of the experiment's SNRs: " + listed(snrs, formatNumber));
        return std::size_t(found - snrs.begin());
    }

    void draw(const Campaign &campaign, const EvaluateOptions &options)
    {
        if (!options.chart.empty())
            writeTextFile(options.chart, chartSvg(pdChart(campaign)));
        if (options.roc.empty())
            return;
        const std::size_t snr = rocSnr(campaign.experiment, options);
        if (options.roc.ends_with(".csv"))
            writeRoc(campaign, snr, options.roc);
        else
            writeTextFile(options.roc, chartSvg(rocChart(campaign, snr)));
    }

    /// `inputs`: what the campaign is made from.
    void writeOutputs(const Campaign &campaign, const std::vector<std::string> &inputs, const EvaluateOptions &options,
                      const Common &common)
    {
        CommitTogether files;
        writeProvenance(common, inputs, {options.out, options.chart, options.roc});
        if (!options.out.empty())
            options.shard.empty() ? writeCurve(campaign, options.out) : writeCampaign(campaign, options.out);
        draw(campaign, options);
        files.commit();
    }

    void checkNames(const EvaluateOptions &options)
    {
        if (!options.chart.empty())
            checkEnding(options.chart, {".svg"});
        if (!options.roc.empty())
            checkEnding(options.roc, {".svg", ".csv"});
        if (options.rocSnrDb && options.roc.empty())
            throw Error("--roc-snr", "requires --roc");
        checkOutputs({options.out, options.chart, options.roc});
    }

    void evaluateExperiment(const EvaluateOptions &options, const Common &common)
    {
        Experiment experiment = experimentFromJson(readJsonFile(options.files.front()), options.files.front());
        const std::string recording = recordingOf(experiment);
        if (common.read && !recording.empty())
            common.read(recording);
        std::vector<std::string> inputs = filesReadFor(recording);
        const InputFiles guarded(inputs);
        inputs.push_back(options.files.front());
        checkNames(options);
        if (options.seed >= 0)
            experiment.seed = options.seed;
        if (options.cost && !experiment.isSweep())
            throw Error("--cost", "requires an experiment of kind \"sweep\"");
        rocSnr(experiment, options); // fail before the runs, not after
        const Shard shard = options.shard.empty() ? Shard{} : shardFrom(options.shard);
        const std::vector<int> runs = runsOfShard(experiment, shard.index, shard.count);
        if (!options.out.empty()) { // resumes an interrupted run
            writeOutputs(carryOutResumably(experiment, runs, options.out, common.context()), inputs, options, common);
            removeParts(options.out);
        } else {
            if (!options.shard.empty())
                throw Error("--shard", "requires --out for the shard's runs");
            Campaign campaign{experiment, {}, {}};
            carryOut(campaign, runs, common.context());
            print(campaign);
            writeOutputs(campaign, inputs, options, common);
        }
        if (options.cost)
            printCosts(experiment, common.context());
    }

    void evaluate(const EvaluateOptions &options, const Common &common)
    {
        if (options.files.front() == "merge") {
            if (options.files.size() < 2 || options.out.empty())
                throw Error("evaluate merge", "requires shards and --out");
            checkNames(options);
            const std::vector<std::string> shards(options.files.begin() + 1, options.files.end());
            return writeOutputs(mergedFiles(shards), shards, options, common);
        }
        if (options.files.size() > 1)
            throw Error("evaluate " + options.files[1], "only one experiment can be given; to merge shards, use "
                                                        "evaluate merge SHARD…");
        evaluateExperiment(options, common);
    }

} // namespace

void addEvaluate(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<EvaluateOptions>();
    CLI::App *command = app.add_subcommand(
        "evaluate", "Estimate the detection probability of an experiment by simulation; an interrupted run is resumed");
    addInput(*command, common, "EXPERIMENT", options->files,
             "Experiment, JSON, of kind lines, injection or sweep (values of one setting tried on the same "
             "lines: Pd, false alarms, latency), or: merge SHARD…")
        ->required();
    addOutput(*command, common, "--out", options->out, "Curve to write, .csv; with --shard, the runs of the shard");
    addOutput(*command, common, "--chart", options->chart,
              "Chart of Pd against SNR to write, .svg, with the theory if available");
    addOutput(*command, common, "--roc", options->roc,
              "Receiver operating characteristic to write, .svg or .csv; of a sweep, Pd against false alarms, .svg");
    command->add_option("--roc-snr", options->rocSnrDb,
                        "SNR of the ROC, dB, one of the experiment's; default: the middle one");
    command->add_option("--shard", options->shard, "Compute only part I of N, for 'merge'");
    command->add_option("--seed", options->seed, "Seed in place of the experiment's")->check(inRange(0, 2147483647));
    command->add_flag("--cost", options->cost, "For a sweep: print the cost of each value, in seconds on this machine");
    command->callback([options, &common] { evaluate(*options, common); });
}

void addMerge(CLI::App &app, Common &common)
{
    struct Options {
        std::vector<std::string> shards;
        std::string out;
    };
    const auto options = std::make_shared<Options>();
    CLI::App *command = app.add_subcommand("merge", "Merge the shards of an experiment; the result is identical to a "
                                                    "run without shards");
    addInput(*command, common, "SHARD", options->shards, "Shards, in any order")->required();
    addOutput(*command, common, "--out", options->out, "Curve to write, .csv")->required();
    command->callback([options, &common] {
        checkOutputs({options->out});
        EvaluateOptions outputs;
        outputs.out = options->out;
        writeOutputs(mergedFiles(options->shards), options->shards, outputs, common);
    });
}

} // namespace faintline::cli

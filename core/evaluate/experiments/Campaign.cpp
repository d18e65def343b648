#include "evaluate/experiments/Campaign.h"

#include "base/Error.h"
#include "base/Overloaded.h"
#include "base/files/fileName.h"
#include "base/wholeNumber.h"
#include "evaluate/experiments/InjectionTrials.h"
#include "evaluate/experiments/LineTrials.h"
#include "evaluate/experiments/SweepTrials.h"
#include "signal/openRecording.h"

#include <algorithm>
#include <set>

namespace faintline {

namespace {

    bool inRunOrder(const RunOutcome &a, const RunOutcome &b)
    {
        return a.run < b.run;
    }

} // namespace

Experiment experimentFromJson(const Json &json, const std::string &where)
{
    if (!json.is_object())
        throw Error(where, "must be a JSON object");
    const Json kind = json.value("kind", Json("lines"));
    if (kind == "lines")
        return lineExperimentFromJson(json, where);
    if (kind == "injection")
        return injectionExperimentFromJson(json, where);
    if (kind == "sweep")
        return sweepExperimentFromJson(json, where);
    throw Error(jsonName(where, "kind") + (kind.is_string() ? " = " + kind.get<std::string>() : ""),
                "must be lines, injection or sweep");
}

Json toJson(const Experiment &experiment)
{
    return std::visit([](const auto &one) { return toJson(one); }, experiment);
}

int runCount(const Experiment &experiment)
{
    return std::visit(Overloaded{[](const LineExperiment &lines) { return lines.runs; },
                                 [](const InjectionExperiment &injection) { return injection.trials; },
                                 [](const SweepExperiment &sweep) { return sweep.runs(); }},
                      experiment);
}

int runFromJson(const Json &json, const Experiment &experiment, const std::string &where)
{
    const int run = wholeNumber<int>(json, where);
    if (run < 0 || run >= runCount(experiment))
        throw Error(where + " = " + std::to_string(run), "must lie in 0 … " + std::to_string(runCount(experiment) - 1));
    return run;
}

std::vector<double> snrsOf(const Experiment &experiment)
{
    return std::visit(Overloaded{[](const SweepExperiment &sweep) { return std::vector{sweep.snrDb}; },
                                 [](const auto &one) { return one.snrDb; }},
                      experiment);
}

std::vector<DetectorUnderTest> detectorsOf(const Experiment &experiment)
{
    return std::visit(Overloaded{[](const SweepExperiment &sweep) {
                                     std::vector<DetectorUnderTest> detectors;
                                     for (std::size_t i = 0; i < sweep.values.size(); ++i)
                                         detectors.push_back({sweep.parameter + " = " + formatNumber(sweep.values[i]),
                                                              experimentAt(sweep, i).settings});
                                     return detectors;
                                 },
                                 [](const auto &one) { return one.detectors; }},
                      experiment);
}

std::string recordingOf(const Experiment &experiment)
{
    return std::visit(Overloaded{[](const LineExperiment &) { return std::string(); },
                                 [](const auto &one) { return fileNameFromText(one.recording); }},
                      experiment);
}

RecordingPointer openRecordingOf(const Experiment &experiment)
{
    const std::string recording = recordingOf(experiment);
    OpenOptions options;
    options.iq = std::visit(
        Overloaded{[](const LineExperiment &) { return false; }, [](const auto &one) { return one.iq; }}, experiment);
    return recording.empty() ? RecordingPointer() : openRecording(recording, options);
}

void setSeed(Experiment &experiment, int seed)
{
    std::visit([seed](auto &one) { one.seed = seed; }, experiment);
}

std::unique_ptr<const Trials> prepareTrials(const Experiment &experiment, RecordingPointer recording,
                                            const RunContext &context)
{
    if (const auto *lines = std::get_if<LineExperiment>(&experiment))
        return std::make_unique<LineTrials>(*lines, context);
    if (const auto *injection = std::get_if<InjectionExperiment>(&experiment))
        return std::make_unique<InjectionTrials>(*injection, std::move(recording), context);
    return std::make_unique<SweepTrials>(std::get<SweepExperiment>(experiment), std::move(recording), context);
}

std::vector<int> openRuns(const Campaign &campaign, std::vector<int> runs)
{
    std::set<int> done;
    for (const RunOutcome &outcome : campaign.outcomes)
        done.insert(outcome.run);
    std::erase_if(runs, [&](int run) { return done.contains(run); });
    return runs;
}

void carryOut(Campaign &campaign, const std::vector<int> &runs, const RunContext &context, const RunSink &sink)
{
    const auto trials =
        prepareTrials(campaign.experiment, openRecordingOf(campaign.experiment), context.part(0.0, 0.1));
    carryOut(campaign, runs, *trials, context.part(0.1, 1.0), sink);
}

void carryOut(Campaign &campaign, const std::vector<int> &runs, const Trials &trials, const RunContext &context,
              const RunSink &sink)
{
    if (campaign.outcomes.empty())
        campaign.thresholds = trials.thresholds();
    const auto outcomes = trials.run(openRuns(campaign, runs), context, sink);
    campaign.outcomes.insert(campaign.outcomes.end(), outcomes.begin(), outcomes.end());
    std::sort(campaign.outcomes.begin(), campaign.outcomes.end(), inRunOrder);
}

std::vector<int> runsOfShard(const Experiment &experiment, int index, int count)
{
    std::vector<int> runs;
    for (int run = 0; run < runCount(experiment); ++run)
        if (run % count == index % count)
            runs.push_back(run);
    return runs;
}

Campaign merge(std::vector<Campaign> parts)
{
    if (parts.empty())
        throw Error("merge", "needs at least one part");
    Campaign whole = std::move(parts.front());
    for (std::size_t i = 1; i < parts.size(); ++i) {
        if (!(parts[i].experiment == whole.experiment) || parts[i].thresholds != whole.thresholds)
            throw Error("merge: part " + std::to_string(i + 1),
                        "belongs to a different experiment than the first part");
        whole.outcomes.insert(whole.outcomes.end(), parts[i].outcomes.begin(), parts[i].outcomes.end());
    }
    std::stable_sort(whole.outcomes.begin(), whole.outcomes.end(), inRunOrder);
    for (std::size_t i = 1; i < whole.outcomes.size(); ++i)
        if (whole.outcomes[i].run == whole.outcomes[i - 1].run)
            throw Error("merge", "run " + std::to_string(whole.outcomes[i].run) + " is in two parts");
    for (int run = 0; run < runCount(whole.experiment); ++run)
        if (std::size_t(run) >= whole.outcomes.size() || whole.outcomes[std::size_t(run)].run != run)
            throw Error("merge", "run " + std::to_string(run) + " of " + std::to_string(runCount(whole.experiment))
                                     + " is missing from all parts; add the missing shard");
    return whole;
}

} // namespace faintline

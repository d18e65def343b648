#include "evaluate/experiments/Campaign.h"

#include "base/Error.h"
#include "evaluate/experiments/InjectionTrials.h"
#include "evaluate/experiments/LineTrials.h"
#include "evaluate/experiments/SweepTrials.h"

#include <algorithm>
#include <set>

namespace faintline {

namespace {

    bool inRunOrder(const RunOutcome &a, const RunOutcome &b)
    {
        return a.run < b.run;
    }

} // namespace

std::unique_ptr<const Trials> prepareTrials(const Experiment &experiment, RecordingPointer recording,
                                            const RunContext &context)
{
    switch (experiment.kind) {
    case Experiment::Kind::Lines:
        return std::make_unique<LineTrials>(experiment, context);
    case Experiment::Kind::Injection:
        return std::make_unique<InjectionTrials>(experiment, std::move(recording), context);
    case Experiment::Kind::Sweep:
        return std::make_unique<SweepTrials>(experiment, std::move(recording), context);
    }
    return nullptr;
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
    for (int run = 0; run < experiment.runs(); ++run)
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
    for (int run = 0; run < whole.experiment.runs(); ++run)
        if (std::size_t(run) >= whole.outcomes.size() || whole.outcomes[std::size_t(run)].run != run)
            throw Error("merge", "run " + std::to_string(run) + " of " + std::to_string(whole.experiment.runs())
                                     + " is missing from all parts; add the missing shard");
    return whole;
}

} // namespace faintline

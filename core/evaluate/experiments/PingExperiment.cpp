#include "evaluate/experiments/PingExperiment.h"

#include "base/Error.h"
#include "base/parallel.h"
#include "detect/Smd.h"
#include "plan/chain.h"
#include "scene/SimulatedPings.h"

namespace faintline {

namespace {

    PingScene seeded(PingScene scene, std::uint64_t seed)
    {
        scene.seed = int(seed & 0x7fffffff);
        return scene;
    }

    /// Everything that defines a chain, without running it.
    AnalysisPlan planOf(const PingExperiment &experiment)
    {
        AnalysisPlan plan;
        plan.settings = experiment.settings;
        plan.frames = std::make_shared<SimulatedPings>(experiment.scene);
        plan.model = makeModel(experiment.settings.model, plan.grid());
        auto calibration = std::make_shared<Calibration>();
        calibration->lnK = std::get<SmdSettings>(experiment.settings.detector).lnK;
        plan.calibration = calibration;
        plan.threshold = experiment.settings.decide.thresholdNats;
        return plan;
    }

    /// A detector that has settled on noise; every run starts from its state.
    struct SettledDetector {
        ResetRule rule;
        std::shared_ptr<const DetectorState> state;
    };

    SettledDetector settle(const PingExperiment &experiment, const AnalysisPlan &plan, const RunContext &context)
    {
        const auto &smd = std::get<SmdSettings>(experiment.settings.detector);
        const ResetRule rule = resetRule(smd, smd.lnK);
        PingScene scene = seeded(experiment.scene, experiment.seed);
        scene.targets.clear();
        scene.pings = std::max(1, experiment.settlingPings);
        const SimulatedPings noise(scene);
        Smd detector(plan.model, rule);
        std::vector<float> y(std::size_t(noise.grid().size()));
        std::vector<float> statistic(y.size());
        for (int ping = 0; ping < experiment.settlingPings; ++ping) {
            context.checkpoint(double(ping) / experiment.settlingPings, "settling on noise");
            noise.read(ping, 1, y);
            detector.update(y, statistic);
        }
        return {rule, detector.state()};
    }

    TrackScore runOnce(const PingExperiment &experiment, const AnalysisPlan &plan, const SettledDetector &settled,
                       std::uint64_t run, const RunContext &context)
    {
        const SimulatedPings pings(seeded(experiment.scene, experiment.seed + 7919u * (run + 1)));
        auto detector = std::make_unique<Smd>(plan.model, settled.rule);
        detector->setState(*settled.state);
        const auto chain = makeChain(plan, std::move(detector));
        std::vector<float> y(std::size_t(pings.grid().size()));
        std::vector<float> statistic(y.size());
        for (Index ping = 0; ping < pings.time().count; ++ping) {
            if (context.stop.stop_requested())
                throw Cancelled();
            pings.read(ping, 1, y);
            chain->update(ping, y, statistic);
        }
        chain->finish();
        return scoreTracks(chain->tracks(), pings.truth(), pings.grid(), experiment.gateCells);
    }

} // namespace

std::vector<TrackScore> runPings(const PingExperiment &experiment, const RunContext &context)
{
    checkSettings(experiment.settings);
    if (!std::holds_alternative<SmdSettings>(experiment.settings.detector)
        || experiment.settings.model.motion == Motion::Bank)
        throw Error("experiment", "requires the sequential Markov detector with one model; choose detector.kind = smd");
    const AnalysisPlan plan = planOf(experiment);
    const SettledDetector settled = settle(experiment, plan, context.part(0.0, 0.2));
    std::vector<TrackScore> scores(std::size_t(experiment.runs));
    parallelFor(experiment.runs, context.part(0.2, 1.0), "following targets", [&]() -> std::function<void(Index)> {
        return [&](Index run) {
            scores[std::size_t(run)] = runOnce(experiment, plan, settled, std::uint64_t(run), context);
        };
    });
    return scores;
}

} // namespace faintline

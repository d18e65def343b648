// Detection probability of several detectors for lines with given properties: Pd against SNR, with intervals.
#include "evaluate/experiments/campaignCurve.h"
#include "evaluate/experiments/peers.h"

#include <cstdio>

using namespace faintline;

int main()
{
    // Lines of 50 windows that wander by half a resolution cell (a window of simulated noise lasts one second), 18 of
    // them in the noise of each run.
    Experiment experiment;
    experiment.trials = 4;
    experiment.durationSeconds = 50.0;
    experiment.wanderHz = 0.5;
    experiment.snrDb = {-3.0, 0.0, 3.0};
    experiment.detectors = {peer("SMD 5 slopes", 50.0), peer("3 of 4", 50.0), peer("integrator", 50.0)};

    Campaign campaign{experiment, {}, {}};
    RunContext context;
    context.threads = 2;
    carryOut(campaign, runsOfShard(experiment, 0, 1), context);

    std::printf("%-14s %8s %6s   %s\n", "detector", "SNR (dB)", "Pd", "95 %");
    for (const CurvePoint &point : pdCurve(campaign))
        std::printf("%-14s %8.1f %6.2f   %.2f to %.2f\n", point.detector.c_str(), point.snrDb, point.pd,
                    point.interval.low, point.interval.high);
    return pdCurve(campaign).size() == 9 ? 0 : 1;
}

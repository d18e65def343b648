// Observes range cells until a sequential test has decided whether they contain a target.
#include "base/Random.h"
#include "base/logmath.h"
#include "detect/Sprt.h"

#include <cstdio>
#include <vector>

using namespace faintline;

int main()
{
    // 50 range cells; a fluctuating target of 7 dB moves by at most one cell per scan; error probabilities 0.001.
    KinematicAxis range;
    range.name = "range";
    range.cells = 50;
    range.step = {1.0 / 3.0, 1.0 / 3.0};
    const double snr = ratioFromDb(7.0);
    const SequentialModel model = makeSequentialModel({range}, {false}, Likelihood(LikelihoodKind::Exponential, snr));
    const SprtSettings sprt{.falseAlarm = 1e-3, .miss = 1e-3};

    int wrong = 0;
    for (const bool hasTarget : {false, true}) {
        Random random(hasTarget ? 1 : 2, 0);
        LikelihoodRatio ratio(model);
        SprtDecision decision = SprtDecision::Undecided;
        for (Index scan = 1; decision == SprtDecision::Undecided; ++scan) {
            std::vector<double> lambda(50);
            for (std::size_t cell = 0; cell < lambda.size(); ++cell) {
                const double mean = hasTarget && cell == 20 ? 1.0 + snr : 1.0;
                lambda[cell] = model.markov.likelihood.at(mean * random.exponential());
            }
            decision = decide(sprt, ratio.update(lambda), scan);
        }
        std::printf("%s: %s after %td scans\n", hasTarget ? "with a target" : "noise alone",
                    decision == SprtDecision::H1 ? "target" : "no target", ratio.stages());
        wrong += (decision == SprtDecision::H1) != hasTarget;
    }
    return wrong;
}

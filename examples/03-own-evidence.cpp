// Finds a path through custom evidence: any log-likelihood ratios on any grid, here a spot that moves along a row of
// 100 cells.
#include "base/Random.h"
#include "detect/Smd.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

using namespace faintline;

int main()
{
    // Three velocities, kept with probability 0.8, changed to a neighbouring one with 0.1 each. Frames contain λ.
    KinematicAxis axis;
    axis.name = "x";
    axis.cells = 100;
    axis.firstRate = -1;
    axis.rateCount = 3;
    axis.rateChange = {0.8, 0.1};
    const MarkovModel model{StateSpace({axis}), Likelihood(LikelihoodKind::Given)};
    Smd detector(model, ResetRule{ResetLaw::Fixed, -0.5});

    Random random(1, 0);
    std::vector<float> lambda(100), statistic(100);
    Index best = 0;
    for (Index frame = 0; frame < 60; ++frame) {
        for (float &value : lambda)
            value = float(random.normal() - 0.5); // noise: mean below 0
        lambda[std::size_t(20 + frame)] += 1.5f;  // the spot
        detector.update(lambda, statistic);
        best = std::max_element(statistic.begin(), statistic.end()) - statistic.begin();
    }
    std::printf("after 60 frames: %.1f nat in cell %td, the spot is in 79\n", double(statistic[std::size_t(best)]),
                best);
    return std::abs(best - 79) <= 1 ? 0 : 1;
}

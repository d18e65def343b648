#pragma once

#include "evaluate/sequential/SequentialTrial.h"

#include <optional>
#include <utility>
#include <vector>

namespace faintline::test {

/// An axis of one rate; `step` holds the probabilities of moving by 0, ±1, … cells, none where nothing moves.
inline KinematicAxis axis(Index cells, std::vector<double> step = {}, bool isCyclic = false)
{
    return {.cells = cells, .cyclic = isCyclic, .step = std::move(step)};
}

/// A test designed for `snr` (a power ratio), in a world of `actualSnr` or of noise.
inline SequentialStudy study(const std::vector<KinematicAxis> &axes, const std::vector<bool> &isFolded, double snr,
                             std::optional<double> actualSnr = {})
{
    SequentialStudy made;
    made.model = makeSequentialModel(axes, isFolded, Likelihood(LikelihoodKind::Exponential, snr));
    made.actualSnr = actualSnr;
    return made;
}

/// The first frames of a trial and where its target was.
struct Heard {
    std::vector<std::vector<float>> frames;
    std::vector<Index> states; ///< -1: no target
    std::vector<Index> folded;
};

inline Heard hear(const SequentialStudy &made, Index number, Index stages)
{
    const TrajectorySampler sampler(made.model);
    SequentialTrial trial(made, sampler, number);
    Heard heard;
    for (Index stage = 0; stage < stages; ++stage) {
        const std::span<const float> y = trial.next();
        heard.frames.emplace_back(y.begin(), y.end());
        heard.states.push_back(trial.state());
        heard.folded.push_back(trial.folded());
    }
    return heard;
}

} // namespace faintline::test

#pragma once

#include "model/CellReduction.h"
#include "model/MarkovModel.h"

#include <string>
#include <vector>

namespace faintline {

/// What a sequential test is told of the world: a Markov model of the target, where it starts, and frame axes it has no
/// state on.
///
/// Its law is stochastic: for every state, P over the states it can move to adds up to 1, rates and ends of an axis
/// included. Otherwise E0[Λ_k] would fall from stage to stage (by 9 % with five slopes, h = ⅓), and every test would
/// drift to "no target".
struct SequentialModel {
    MarkovModel markov;          ///< on the frame axes that are not folded; one cell where all are
    CellReduction reduction;     ///< from a frame's cells to the model's
    std::vector<double> initial; ///< P(x1) of every state, StateSpace order; empty: uniform
    /// Frames from one that is looked at to the next, from the first on: those between share samples with it (windows
    /// that overlap), and the evidence of stages has to be independent. The target moves through them unseen, λ = 0.
    Index observedEvery = 1;

    /// P(x1) of every state, written out.
    std::vector<double> initialLaw() const;

    /// Throws Error naming `where` if the initial law is not a probability law, cells do not match, or the law of an
    /// axis loses probability.
    void check(const std::string &where) const;
};

/// The model on these frame axes (slowest first), those marked in `isFolded` being uniform anew at every stage, the
/// others made stochastic (KinematicAxis::stochastic): a law as it is given, an initial law whose sum is 1 but for
/// rounding. Throws Error.
SequentialModel makeSequentialModel(const std::vector<KinematicAxis> &frameAxes, const std::vector<bool> &isFolded,
                                    const Likelihood &likelihood, std::vector<double> initial = {});

} // namespace faintline

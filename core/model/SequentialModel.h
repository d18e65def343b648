#pragma once

#include "model/CellReduction.h"
#include "model/MarkovModel.h"

#include <string>
#include <vector>

namespace faintline {

/// Model of a sequential test: a Markov model of the target, its initial law, and the frame axes without a state.
///
/// Its law is stochastic: for each state, the probabilities of the possible moves add up to 1, including rates and the
/// ends of an axis. Otherwise E0[Λ_k] would fall from stage to stage (by 9 % with five slopes, h = ⅓), and every test
/// would drift to "no target".
struct SequentialModel {
    MarkovModel markov;          ///< on the frame axes that are not folded; one cell if all are
    CellReduction reduction;     ///< from frame cells to model cells
    std::vector<double> initial; ///< P(x1) of each state in StateSpace order; empty: uniform
    /// Interval of observed frames, starting with the first. Frames between them share samples with them (overlapping
    /// windows), but the evidence of stages must be independent. The target moves through them unseen, λ = 0.
    Index observedEvery = 1;

    /// P(x1) of each state, also if uniform.
    std::vector<double> initialLaw() const;

    /// Throws Error naming `where` if the initial law is not a probability law, cells do not match, or the law of an
    /// axis loses probability.
    void check(const std::string &where) const;
};

/// The model on these frame axes (slowest first). Axes marked in `isFolded` are uniform and independent at each stage;
/// the others are made stochastic (KinematicAxis::stochastic). The sum of the initial law must be 1, apart from
/// rounding. Throws Error.
SequentialModel makeSequentialModel(const std::vector<KinematicAxis> &frameAxes, const std::vector<bool> &isFolded,
                                    const Likelihood &likelihood, std::vector<double> initial = {});

} // namespace faintline

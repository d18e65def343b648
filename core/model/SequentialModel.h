#pragma once

#include "model/CellReduction.h"
#include "model/MarkovModel.h"

#include <string>
#include <vector>

namespace faintline {

/// What a sequential test is told of the world: a Markov model of the target, where it starts, and frame axes it has no state on.
struct SequentialModel {
    MarkovModel markov;          ///< on the frame axes that are not folded; one cell where all are
    CellReduction reduction;     ///< from a frame's cells to the model's
    std::vector<double> initial; ///< P(x1) of every state, StateSpace order; empty: uniform

    /// P(x1) of every state, written out.
    std::vector<double> initialLaw() const;

    /// Throws Error naming `where` if the initial law is none, or cells do not fit.
    void check(const std::string &where) const;
};

/// The model on these frame axes (slowest first), those marked in `isFolded` being uniform anew at every stage.
SequentialModel makeSequentialModel(const std::vector<KinematicAxis> &frameAxes, const std::vector<bool> &isFolded,
                                    const Likelihood &likelihood, std::vector<double> initial = {});

} // namespace faintline

#pragma once

#include "detect/Sprt.h"

#include <string>
#include <vector>

namespace faintline {

/// Posterior law of the target's place along one axis of the model, stage by stage, summed over all other axes and
/// rates.
struct PosteriorPicture {
    std::size_t frameAxis = 0; ///< index of the axis in the frames
    std::string name;
    Index cells = 0;
    Index stride = 1;               ///< row i belongs to stage i·stride (0, 1, …)
    std::vector<float> probability; ///< rows × cells

    Index rows() const { return cells > 0 ? Index(probability.size()) / cells : 0; }
};

/// A sequential test with its posterior laws.
struct InspectedTest {
    SprtResult result;
    std::vector<PosteriorPicture> posterior; ///< one per axis with a state
};

/// runSprt that keeps P(x_k | z_1 … z_k). When a picture would exceed 2²² values, every second row is dropped,
/// repeatedly if necessary. Oracle: LikelihoodRatio. Throws Error, Cancelled.
InspectedTest inspectStages(const SequentialModel &model, const SprtSettings &settings, Index stages,
                            const StageSource &source, const RunContext &context = {});

} // namespace faintline

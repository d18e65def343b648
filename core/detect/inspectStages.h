#pragma once

#include "detect/Sprt.h"

#include <string>
#include <vector>

namespace faintline {

/// Where the target was thought to be, stage after stage, along one axis of the model: the posterior law summed over
/// all other axes and rates.
struct PosteriorPicture {
    std::size_t frameAxis = 0; ///< which axis of the frames
    std::string name;
    Index cells = 0;
    Index stride = 1;               ///< row i belongs to stage i·stride (0, 1, …)
    std::vector<float> probability; ///< rows × cells

    Index rows() const { return cells > 0 ? Index(probability.size()) / cells : 0; }
};

/// A sequential test with what it thought on the way.
struct InspectedTest {
    SprtResult result;
    std::vector<PosteriorPicture> posterior; ///< one per axis with a state
};

/// runSprt with P(x_k | z_1 … z_k) kept. Where a picture would exceed 2²² values, every second row is dropped, again
/// and again. Oracle: LikelihoodRatio. Throws Error, Cancelled.
InspectedTest inspectStages(const SequentialModel &model, const SprtSettings &settings, Index stages,
                            const StageSource &source, const RunContext &context = {});

} // namespace faintline

#include "plan/lineSequentialModel.h"

#include "base/Error.h"

namespace faintline {

SequentialModel lineSequentialModel(const ModelSettings &settings, const Grid &grid, const NormalisedFrames &frames)
{
    if (!grid.isSpectrum() || settings.motion != Motion::Slopes)
        throw Error("sequential test", "requires a line recording and model.motion = slopes");
    const MarkovModel line = makeModel(settings, grid);
    checkLikelihoodRatio(line.likelihood, "model.likelihood");
    SequentialModel model = makeSequentialModel(line.space.axes(), {false}, line.likelihood);
    model.observedEvery = framesApart(frames);
    return model;
}

Index framesApart(const NormalisedFrames &frames)
{
    return Index(frames.geometry().framesPerWindow);
}

void checkLikelihoodRatio(const Likelihood &likelihood, const std::string &where)
{
    if (likelihood.kind() == LikelihoodKind::Linear)
        throw Error(where, "linear is not a likelihood ratio, so error probabilities cannot be guaranteed; choose "
                           "rice, exponential or swerling4");
}

} // namespace faintline

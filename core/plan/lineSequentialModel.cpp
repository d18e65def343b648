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

StageSource stagesOf(NormalisedFramesPointer frames, Index firstFrame, Index firstCell, Index cellCount)
{
    std::vector<float> row(std::size_t(frames->grid().size()));
    return
        [frames = std::move(frames), firstFrame, firstCell, cellCount, row](Index stage, std::span<double> y) mutable {
            frames->read(firstFrame + stage, 1, row);
            for (Index cell = 0; cell < cellCount; ++cell)
                y[std::size_t(cell)] = double(row[std::size_t(firstCell + cell)]);
        };
}

void checkLikelihoodRatio(const Likelihood &likelihood, const std::string &where)
{
    if (likelihood.kind() == LikelihoodKind::Linear)
        throw Error(where, "linear is not a likelihood ratio, so error probabilities cannot be guaranteed; choose "
                           "rice, exponential or swerling4");
}

} // namespace faintline
